// Files: triangle meshes in; cut-meshes out and in; meshes and outlines out.
#pragma once

#include <functional>
#include <iosfwd>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "mandoline/cell_complex.h"
#include "mandoline/mandoline.h"
#include "mandoline/mesh_files.h"
#include "mandoline/rank_piece.h"
#include "mandoline/slice.h"

namespace MANDOLINE_API mandoline {

/// The kinds of files that are written, by their extensions.
enum class FileFormat {
  json,  ///< every array of a cut-mesh
  mcm,   ///< the same in a tenth of the bytes, to be read back
  vtu,   ///< polyhedra for VTK and ParaView
  obj,   ///< a mesh, or the cut surface as polygons, one group per region, or outlines as lines in space
  stl,   ///< a mesh, or the cut surface; binary
  ply,   ///< a mesh, or the cut surface with the region of each triangle; binary
  off,   ///< a mesh
  svg,   ///< outlines, with the normal towards the viewer
  dxf,   ///< outlines as polylines in space, one layer per region
};
/// The extension, e.g. "json".
const char* name(FileFormat format);
/// The format for the extension of a path, in upper or lower case; nothing if there is no such format.
std::optional<FileFormat> formatOf(const std::string& path);
/// What a format can hold: a cut-mesh, a mesh, outlines.
bool isCutMeshFormat(FileFormat format);
bool isMeshFormat(FileFormat format);
bool isOutlineFormat(FileFormat format);

/// Which parts of a cut-mesh are written, and how.
struct WriteOptions : RunOptions {
  bool untouched = true;  ///< whether untouched grid cells are written, too (.vtu, polyMesh)
  /// Whether faces are left out that have the same cell at both sides, where a sheet ends in it, since VTK's filters and some of OpenFOAM's
  /// solvers fail on these (.vtu of cells, polyMesh).
  bool simpleCells = false;
  /// Per region of the cut-mesh 1 if it is written, else 0; empty for all, but see writePolyMesh(). Of cells: those of the region. Of the
  /// surface: all that bounds the region, oriented out of it, while without regions each face is written once, under the region that an
  /// outward oriented surface encloses.
  std::vector<uint8_t> regions;
  /// Groups of the input's triangles, for those files that have them; none if null. A face that several triangles contain is in the group
  /// of its faceTriangle.
  const TriangleGroups* groups = nullptr;

  bool hasRegion(uint32_t region) const { return regions.empty() || regions[region] != 0; }
};

/// Takes the bytes of a file, piece after piece. What it throws passes through.
using Sink = std::function<void(std::string_view)>;

// All writers throw CallError if cancelled, and for arguments that do not fit: `regions` of a wrong length, the mesh of another cut, a
// triangle (element) that names a vertex that does not exist, groups of other triangles.

/// The complete dump as JSON: format, version, grid, the arrays of CutMesh under their names, gridCellRegion (as
/// CutMesh::gridCellRegion()), triangleCount, snapTolerance, madeFrom and fingerprint. Arrays that are not there, as regionWinding without
/// winding numbers, have a null for each region. Doubles read back identically.
void writeJson(const Sink& sink, const CutMesh& cutMesh, const RunOptions& options = {});
/// The same with two arrays more: groupNames, and triangleGroup per triangle of the input; with neither if there are no groups.
void writeJson(const Sink& sink, const CutMesh& cutMesh, const TriangleGroups& groups, const RunOptions& options);
/// A cell complex made from the cut-mesh as JSON: format, version, cutVertices, cutFaces, cutCells, the arrays of CellComplex under their
/// names, faceTriangle of the cut-mesh's faces, madeFrom, fingerprint, and the two arrays of groups if there are any. It always has
/// all cells: CallError for options that select less.
void writeJson(const Sink& sink, const CutMesh& cutMesh, const CellComplex& cells, const WriteOptions& options);
/// The cut-mesh as bytes that readCutMesh() takes, in Mandoline's own format: compressed, with a version and a checksum of each array. The
/// same cut-mesh always gives the same bytes.
void writeMcm(const Sink& sink, const CutMesh& cutMesh, const RunOptions& options = {});
/// A piece of a cut of several processes as such a file, which also has its ids in the whole, ranks and seams.
void writeMcm(const Sink& sink, const RankPiece& piece, const RunOptions& options = {});
/// VTK XML unstructured grid of polyhedra, and of hexahedra for untouched grid cells, with cell arrays grid_cell, region, volume and, where
/// they are there, winding, part_winding, parity and insideness. Faces with holes are split alike on both sides. Takes little memory
/// besides that of the cut-mesh.
void writeVtu(const Sink& sink, const MeshView& mesh, const CutMesh& cutMesh, const WriteOptions& options = {});
/// A piece of forEachBrick() as such a file: grid_cell is that of the whole grid, and there is no region, which others of the whole cut
/// would share.
void writeVtu(const Sink& sink, const CutPiece& piece, const WriteOptions& options = {});
/// Numbers to write beside the rest: 1 or 3 for each cell, or each face, of a cell complex.
struct Field {
  std::string name;  ///< not empty, unique in the file, without control characters and < > & "; else CallError
  std::span<const double> values;
};
/// The cells of a cell complex, made from the cut-mesh, as such a grid, in which they match face by face: octree cells are hexahedra, too,
/// unless they meet smaller cells. Cell arrays are grid_cell (the lowest one), level, region, volume, the same about inside, and the
/// fields.
void writeVtu(const Sink& sink, const CutMesh& cutMesh, const CellComplex& cells, std::span<const Field> cellFields = {},
              const WriteOptions& options = {});
/// Its faces, those of the cells that the options select, as polygons with cell arrays face, tag (FaceTag), triangle, cells and the fields;
/// with groups also group (-1 for none), and their names as the field data group_names. The triangle is that of a face's first member. A
/// face with holes or slits is several triangles, with the same numbers.
void writeFacesVtu(const Sink& sink, const CutMesh& cutMesh, const CellComplex& cells, std::span<const Field> faceFields = {},
                   const WriteOptions& options = {});
/// The cut surface; with groups, the triangles of .ply also have a property group.
void writeObj(const Sink& sink, const CutMesh& cutMesh, const WriteOptions& options = {});
void writeStl(const Sink& sink, const CutMesh& cutMesh, const WriteOptions& options = {});
void writePly(const Sink& sink, const CutMesh& cutMesh, const WriteOptions& options = {});
/// A cut-mesh as json, mcm, vtu, obj, stl or ply. JSON and .mcm always have everything: CallError for options that select less. Throws
/// FileError for the other formats.
void writeCutMesh(const Sink& sink, FileFormat format, const MeshView& mesh, const CutMesh& cutMesh, const WriteOptions& options = {});
/// A mesh as obj, stl, ply or off. Throws FileError for the others. OBJ has the groups as `g` lines, with '_' for blanks in names.
void writeMesh(const Sink& sink, FileFormat format, const MeshView& mesh, const RunOptions& options = {},
               const TriangleGroups* groups = nullptr);

/// The defects that inspect() finds in a mesh, as OBJ: lines in world units, in groups named for their kinds. Throws CallError for those of
/// another mesh.
void writeDefects(const Sink& sink, const MeshView& mesh, const MeshInfo& info, const RunOptions& options = {});

/// Polylines as OBJ, such as streamlines: points and offsets are theirs, 3 coordinates per point, and the first point of each line with the
/// end of the last. Lines of fewer than two points are left out. Throws CallError for a line (element) that has points that do not exist.
void writeLines(const Sink& sink, std::span<const double> points, std::span<const uint32_t> offsets, const RunOptions& options = {});

/// Outlines in parallel planes.
struct OutlineStack {
  std::array<double, 3> normal;
  std::vector<double> offsets;   ///< as for outlines()
  std::vector<Outlines> layers;  ///< per offset
};
/// Those of the regions in svg, dxf or obj, in world units. Throws FileError for other formats, and CallError for a region (element)
/// without a place in options.regions.
void writeOutlines(const Sink& sink, FileFormat format, const OutlineStack& stack, const WriteOptions& options = {});

/// The same to streams, whose state tells of errors.
void writeJson(std::ostream& out, const CutMesh& cutMesh, const RunOptions& options = {});
void writeMcm(std::ostream& out, const CutMesh& cutMesh, const RunOptions& options = {});
void writeVtu(std::ostream& out, const MeshView& mesh, const CutMesh& cutMesh, const WriteOptions& options = {});
void writeObj(std::ostream& out, const CutMesh& cutMesh, const WriteOptions& options = {});

/// The same to files, by extension. A file appears when it is complete. Throws FileError.
void writeCutMesh(const std::string& path, const MeshView& mesh, const CutMesh& cutMesh, const WriteOptions& options = {});
void writeMesh(const std::string& path, const MeshView& mesh, const RunOptions& options = {}, const TriangleGroups* groups = nullptr);
/// Writes all cells as an OpenFOAM polyMesh: the files points, faces, owner, neighbour, boundary and, if there are cells of several
/// regions, cellZones (region0, ...) in the folder, which is made if need be; they appear when all are complete. `cells` is made from the
/// cut-mesh; which of them are written is up to the options. Patches are xMin ... zMax, `surface` (a wall), which has both sides of the
/// input's triangles, and `inner` where only one of two neighbours is written. With groups there is a wall for each of them, in the patch
/// group `surface`, under its name: characters other than letters, digits and -.:%+ become '_', and where two would be alike, or like
/// another patch, "_2" is added. Faces with holes or slits are divided into triangles, as
/// those of .vtu files are. Throws FileError.
///
/// Merged cells are for solvers, which divide by areas, heights and what flows. So faces that are only as wide as rounding makes them
/// (2^-48 of the largest coordinate) are collapsed, with their vertices put into the edges that they lie on; walls in a plane with the
/// centroid of a cell beside them, as of a flat sheet that ends in the middle of a cell, are moved off it by 2^-44; cells that have walls
/// alone around them are left out; and faces of the grid that their own centre does not see as a whole, or no vertex does, are divided.
/// Without `regions`, those that no side of the grid bounds are left out, if there are others: where a pressure is held on a side, nothing
/// holds it in these, and solvers divide by zero.
void writePolyMesh(const std::string& folder, const CutMesh& cutMesh, const CellComplex& cells, const WriteOptions& options = {});
/// Takes the bytes of the files of a folder, piece after piece and file after file, with the name of the file. What it throws passes
/// through.
using FolderSink = std::function<void(const std::string& file, std::string_view piece)>;
/// The same to wherever the sink puts it.
void writePolyMesh(const FolderSink& sink, const CutMesh& cutMesh, const CellComplex& cells, const WriteOptions& options = {});

struct WritePiecesOptions : ForEachBrickOptions {
  bool simpleCells = false;  ///< as of WriteOptions
};
/// What writePieces() has written.
struct PieceCounts {
  uint64_t pieces = 0, cutCells = 0, untouchedCells = 0;
};
/// Cuts brick by brick, with no more memory than forEachBrick(), and writes each piece that has cells as a .vtu file into a folder, which
/// is made if need be: cut_I_J_K.vtu, where the brick's lowest grid cell is (I, J, K). Then cut.pvtu, which joins them; no file if there
/// are no pieces. Files of these names that are there already go. Untouched grid cells are written if options.untouched says so. Cells
/// match face by face within a piece. Throws CallError as forEachBrick() does, and FileError; then none of the files is left.
PieceCounts writePieces(const std::string& folder, const PreparedMesh& mesh, const Grid& grid, const WritePiecesOptions& options = {});

/// Throws the FileError that writeCutMesh would meet at once, before there is anything to write: an unknown extension, no such folder.
void checkOutput(const std::string& path);

/// Reads a .mcm file: every array and the grid, to the bit; of a piece its cut-mesh. Of a folder of pieces it reads all .mcm files, and
/// gives the whole, as joinPieces() does. What it returns passes checkArrays(), so that all functions can take it; some also need its
/// input. Throws FileError for anything else, which names the byte and the array, or the layers of the grid that are missing.
CutMesh readCutMesh(const std::string& path);
/// The same from the bytes of a file. `name` stands for the path in messages.
CutMesh readCutMesh(std::span<const char> bytes, const std::string& name);
/// Reads the .mcm file of a piece alone. Throws FileError, also for a whole cut-mesh.
RankPiece readRankPiece(const std::string& path);
RankPiece readRankPiece(std::span<const char> bytes, const std::string& name);

}  // namespace mandoline

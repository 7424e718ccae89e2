// Files: triangle meshes in, cut-meshes out.
#pragma once

#include <functional>
#include <iosfwd>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "mandoline/mandoline.h"
#include "mandoline/mesh_files.h"
#include "mandoline/slice.h"

namespace mandoline {

/// The kinds of files that are written, by their extensions.
enum class FileFormat {
  json,  ///< every array of a cut-mesh
  vtu,   ///< polyhedra for VTK and ParaView
  obj,   ///< a mesh, or the cut surface as polygons, one group per region, or outlines as lines in space
  stl,   ///< a mesh, or the cut surface; binary
  ply,   ///< a mesh, or the cut surface with the region of each triangle; binary
  off,   ///< a mesh
  svg,   ///< outlines, seen against the normal
  dxf,   ///< outlines as polylines in space, one layer per region
};
/// The extension, e.g. "json".
const char* name(FileFormat format);
/// The format by the extension of a path, in any case; nothing if there is none such.
std::optional<FileFormat> formatOf(const std::string& path);
/// What can be written so: a cut-mesh, a mesh, outlines.
bool isCutMeshFormat(FileFormat format);
bool isMeshFormat(FileFormat format);
bool isOutlineFormat(FileFormat format);

/// What of a cut-mesh is written.
struct WriteOptions {
  bool untouchedCells = true;  ///< besides the cut-cells (.vtu)
  /// Per region 1 if it is written, else 0; empty for all. Of cells: those of the region. Of the surface: all that bounds the region,
  /// oriented out of it, while without regions each face is written once, under the region that an outward oriented surface encloses.
  std::vector<uint8_t> regions;
};

/// Takes the bytes of a file, piece after piece. What it throws passes through.
using Sink = std::function<void(std::string_view)>;

/// The complete dump as JSON; doubles read back identically.
void writeJson(const Sink& sink, const CutMesh& cutMesh);
/// VTK XML unstructured grid of polyhedra with cell arrays grid_cell, region, winding, volume. Faces with holes are split alike on both
/// sides. Takes little memory beside that of the cut-mesh.
void writeVtu(const Sink& sink, const MeshView& mesh, const CutMesh& cutMesh, const WriteOptions& options = {});
/// The cut surface.
void writeObj(const Sink& sink, const CutMesh& cutMesh, const WriteOptions& options = {});
void writeStl(const Sink& sink, const CutMesh& cutMesh, const WriteOptions& options = {});
void writePly(const Sink& sink, const CutMesh& cutMesh, const WriteOptions& options = {});
/// A cut-mesh as json, vtu, obj, stl or ply. JSON always has everything. Throws FileError for the others.
void writeCutMesh(const Sink& sink, FileFormat format, const MeshView& mesh, const CutMesh& cutMesh, const WriteOptions& options = {});
/// A mesh as obj, stl, ply or off. Throws FileError for the others.
void writeMesh(const Sink& sink, FileFormat format, const MeshView& mesh);

/// Outlines in parallel planes.
struct OutlineStack {
  std::array<double, 3> normal;
  std::vector<double> offsets;   ///< as for outlines()
  std::vector<Outlines> layers;  ///< per offset
};
/// Those of the regions in svg, dxf or obj, in world units. Throws FileError for other formats.
void writeOutlines(const Sink& sink, FileFormat format, const OutlineStack& stack, const WriteOptions& options = {});

/// The same to streams, whose state tells of errors.
void writeJson(std::ostream& out, const CutMesh& cutMesh);
void writeVtu(std::ostream& out, const MeshView& mesh, const CutMesh& cutMesh, const WriteOptions& options = {});
void writeObj(std::ostream& out, const CutMesh& cutMesh, const WriteOptions& options = {});

/// The same to files, by extension. A file appears when it is complete. Throws FileError.
void writeCutMesh(const std::string& path, const MeshView& mesh, const CutMesh& cutMesh, const WriteOptions& options = {});
void writeMesh(const std::string& path, const MeshView& mesh);
/// Throws the FileError that writeCutMesh would meet at once, before there is anything to write: an unknown extension, no such folder.
void checkOutput(const std::string& path);

}  // namespace mandoline

// Files: triangle meshes in, cut-meshes out.
#pragma once

#include <functional>
#include <iosfwd>
#include <stdexcept>
#include <string_view>

#include "mandoline/mandoline.h"
#include "mandoline/validate.h"

namespace mandoline {

/// A file that can't be used; what() names the file and the line or element.
struct FileError : std::runtime_error {
  using std::runtime_error::runtime_error;
};

/// Reads OBJ, STL, PLY or OFF (STL and PLY in text or binary), by content and extension, each also gzipped. Polygons are fanned from
/// their first vertex; triangles are numbered in file order. Doubles are kept. Throws FileError.
Mesh readMesh(const std::string& path);
/// The same from the bytes of a file, gzipped or not. `name` stands for the path in messages, and its extension decides where the content
/// does not.
Mesh readMesh(std::span<const char> bytes, const std::string& name);

/// Takes the bytes of a file, piece after piece.
using Sink = std::function<void(std::string_view)>;

/// What of a cut-mesh is written.
struct WriteOptions {
  bool untouchedCells = true;    ///< besides the cut-cells (.vtu)
  std::vector<uint8_t> regions;  ///< per region 1 if its cells or its surface are written, else 0; empty for all
};

/// The complete dump as JSON; doubles read back identically.
void writeJson(const Sink& sink, const CutMesh& cutMesh);
/// VTK XML unstructured grid of polyhedra with cell arrays grid_cell, region, winding, volume. Faces with holes are split alike on both
/// sides. Takes little memory beside that of the cut-mesh.
void writeVtu(const Sink& sink, const MeshView& mesh, const CutMesh& cutMesh, const WriteOptions& options = {});
/// The cut surface as polygons, one group per region.
void writeObj(const Sink& sink, const CutMesh& cutMesh);
/// The same to streams, whose state tells of errors.
void writeJson(std::ostream& out, const CutMesh& cutMesh);
void writeVtu(std::ostream& out, const MeshView& mesh, const CutMesh& cutMesh, const WriteOptions& options = {});
void writeObj(std::ostream& out, const CutMesh& cutMesh);
/// Writes by extension: .json, .vtu or .obj. The file appears when it is complete. Throws FileError.
void writeCutMesh(const std::string& path, const MeshView& mesh, const CutMesh& cutMesh);
/// Throws the FileError that writeCutMesh would meet at once, before there is anything to write: an unknown extension, no such folder.
void checkOutput(const std::string& path);

}  // namespace mandoline

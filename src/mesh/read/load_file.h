// Files by their path.
#pragma once

#include <optional>
#include <string>

#include "base/shared.h"
#include "mandoline/cut_share.h"
#include "mandoline/mesh_files.h"
#include "mesh/mesh_source.h"

namespace mandoline::detail {

/// All bytes of a file or a pipe. Throws FileError.
std::string loadFile(const std::string& path);

/// Whether a file begins as one of binary PLY or STL does, not packed: such ones are read so quickly that several processes can each read
/// them. False also for what can't be opened.
MANDOLINE_SHARED bool isBinaryMesh(const std::string& path);

/// Vertices and triangles of a mesh, by the ids of the whole.
struct FileSlice {
  Mesh mesh;
  std::shared_ptr<const MeshSource> whole;  ///< which throws FileError where something is wrong elsewhere
  uint64_t sample = 0;                      ///< of the whole file: files that differ in size or in most of their bytes have other ones
};
/// One of the slices of a mesh, which several processes read each. Nothing, at least in one of them, where the file is not of binary PLY or
/// STL with a known place for each, or something is wrong with it: then it is to be read as a whole, which also tells what is wrong.
MANDOLINE_SHARED std::optional<FileSlice> readMeshSlice(const std::string& path, const ShareOf& shareOf);

}  // namespace mandoline::detail

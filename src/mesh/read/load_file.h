// Files by their path.
#pragma once

#include <string>

#include "base/shared.h"
#include "mandoline/mesh_files.h"

namespace mandoline::detail {

/// All bytes of a file or a pipe. Throws FileError.
std::string loadFile(const std::string& path);

/// Whether a file begins as one of binary PLY or STL does, not packed: such ones are read so quickly that several processes can each read
/// them. False also for what can't be opened.
MANDOLINE_SHARED bool isBinaryMesh(const std::string& path);

}  // namespace mandoline::detail

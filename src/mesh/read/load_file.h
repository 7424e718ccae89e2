// Files by their path.
#pragma once

#include <string>

#include "mandoline/mesh_files.h"

namespace mandoline::detail {

/// All bytes of a file or a pipe. Throws FileError.
std::string loadFile(const std::string& path);

}  // namespace mandoline::detail

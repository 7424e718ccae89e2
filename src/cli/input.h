// The mesh that a command works on.
#pragma once

#include <array>
#include <optional>

#include "cli/arguments.h"
#include "mandoline/mesh_files.h"

namespace mandoline::cli {

/// What --orient has done.
struct Orientation {
  size_t turnedTriangles = 0;
  std::array<size_t, 4> patches{};  ///< that face so, by Facing
};

/// As it was read, or turned by --orient.
struct Input : GroupedMesh {
  std::string name;  ///< path, or "standard input"
  std::optional<Orientation> orientation;
};

/// "standard input" for "-".
std::string nameOf(const std::string& meshPath);

/// Throws FileError, after it has been reported where --report says. With progress.
Input readInput(const Arguments& arguments);

}  // namespace mandoline::cli

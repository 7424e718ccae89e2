// Groups of triangles in files that have names of their own kind for them.
#pragma once

#include "base/shared.h"
#include "mandoline/io.h"

namespace mandoline::detail {

/// The same, or null if there are none. Throws CallError unless each of so many triangles has one.
MANDOLINE_SHARED const TriangleGroups* checkedGroups(const TriangleGroups* groups, size_t triangles);

// Names as words that a format takes: other characters become '_', and where two names would be one word, "_2" is added, or "_3" and so on.
// Names that are such words stay what they are.

/// For OpenFOAM's patches: letters, digits and -.:%+, beginning with a letter or '_', and none of the reserved ones.
std::vector<std::string> patchNames(std::span<const std::string> names, std::span<const char* const> reserved);
/// For OBJ's `g` lines, where blanks end a name.
std::vector<std::string> objNames(std::span<const std::string> names);

}  // namespace mandoline::detail

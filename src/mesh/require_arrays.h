// What every function asks of a mesh whose arrays it follows.
#pragma once

#include "base/shared.h"
#include "mandoline/mesh.h"

namespace mandoline::detail {

/// Throws CallError: badArrays for lengths that are not multiples of 3, badIndex for a triangle (element) that names a vertex that does not
/// exist.
MANDOLINE_SHARED void requireArrays(const MeshView& mesh);

}  // namespace mandoline::detail

// .pvtu files, which join .vtu files of pieces of a cut.
#pragma once

#include <string>
#include <vector>

#include "base/shared.h"
#include "mandoline/cut_mesh.h"

namespace mandoline::detail {

/// The arrays of the pieces, which are those of this one.
MANDOLINE_SHARED std::string pvtuArrays(const CutMesh& piece, bool hasRegion);
/// The file. `pieces`: relative to its folder.
MANDOLINE_SHARED std::string pvtuText(const std::string& arrays, const std::vector<std::string>& pieces);

}  // namespace mandoline::detail

// What a piece of a cut has beside its cut-mesh.
#pragma once

#include "base/shared.h"
#include "mandoline/rank_piece.h"

namespace mandoline::operators {

/// What of it does not fit its cut-mesh, which has passed checkArrays(), or null.
MANDOLINE_SHARED const char* whatIsWrong(const RankPiece& piece);

}  // namespace mandoline::operators

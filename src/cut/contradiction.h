// Which two triangles to name where a cut met a contradiction.
#pragma once

#include "cut/scaled_input.h"

namespace mandoline::detail {

/// The error to report where the cut met a contradiction that it blames on two triangles (or -1). If they do meet, they are named; else the
/// first pair that does: a blamed triangle with the lowest other one, or the lowest pair of all triangles that reach the grid. The lower
/// id comes first. If none meet, or all that do were resolved, the contradiction is the cutter's own. The search reports to run.monitor,
/// which may cancel it.
Error explainContradiction(const Input& input, int64_t blamed, int64_t alsoBlamed, Run& run);

}  // namespace mandoline::detail

// Output: the cut-mesh of its parts.
//
// In: the CutPart of each share, and all stages before. Out: the public CutMesh.
#pragma once

#include "cut/stages/output_part.h"

namespace mandoline::detail {

/// `parts`: in the order of shares. Moves the arrays out of them and of `state`.
CutMesh makeOutput(std::vector<CutPart> parts, CutState& state, Run& run);

/// What all shares know alike: the cut-mesh without vertices, faces and cut-cells. `hasFace`: per triangle whether some share has a face of
/// it.
CutMesh makeCommon(const std::vector<uint8_t>& hasFace, const CutState& state, Run& run);

}  // namespace mandoline::detail

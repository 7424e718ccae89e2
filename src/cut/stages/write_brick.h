// What a brick gives to the result: tri-cut-faces, pieces of grid-faces, which come after them, and cut-cells. Part of output_part.h.
#pragma once

#include "cut/stages/output_part.h"

namespace mandoline::detail {

// Each writes what belongs to a brick into the arrays of a result, which are long enough, where state.numbers say.
void writeFaces(const CutState& state, BrickId brick, CutMesh& out);
void writeCells(const CutState& state, BrickId brick, CutMesh& out);  ///< without regions
void writeRegions(const CutState& state, BrickId brick, CutMesh& out);

}  // namespace mandoline::detail

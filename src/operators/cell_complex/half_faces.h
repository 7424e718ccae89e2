// Which half-faces the cells of a complex have.
#pragma once

#include "base/shared.h"
#include "mandoline/cell_complex.h"

namespace mandoline::operators {

/// Fills in cellHalfFaces and their offsets, from faceCells.
MANDOLINE_SHARED void gatherHalfFaces(CellComplex& cells, unsigned threads = 1);

}  // namespace mandoline::operators

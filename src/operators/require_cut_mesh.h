// What every operator asks of its cut-mesh, and of cells made from it.
#pragma once

#include "base/shared.h"
#include "mandoline/cell_complex.h"
#include "mandoline/status.h"

namespace mandoline::operators {

/// Throws CallError{badArgument}.
MANDOLINE_SHARED [[noreturn]] void refuse(const std::string& message, int64_t element = -1);

/// Throws CallError for an empty CutMesh, one that did not come from cut(). The arrays of others are trusted.
MANDOLINE_SHARED void requireCutMesh(const CutMesh& cutMesh);

/// Throws CallError for cells of another cut-mesh, or if some are missing.
MANDOLINE_SHARED [[noreturn]] void refuseCells();

/// Throws CallError unless the cell complex begins with the vertices, and with as many faces and cells, of the cut-mesh.
MANDOLINE_SHARED void requireCellsOf(const CutMesh& cutMesh, const CellComplex& cells);

}  // namespace mandoline::operators

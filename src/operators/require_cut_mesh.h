// What every operator asks of its cut-mesh, and of cells made from it.
#pragma once

#include "base/shared.h"
#include "mandoline/cell_complex.h"
#include "mandoline/status.h"

namespace mandoline::operators {

/// Throws CallError{badArgument}.
MANDOLINE_SHARED [[noreturn]] void refuse(const std::string& message, int64_t element = -1);

/// Throws CallError for an empty CutMesh, or one that did not come from cut(), but from refineCells(). The arrays of others are trusted.
MANDOLINE_SHARED void requireCutMesh(const CutMesh& cutMesh);

/// Throws CallError for an empty one alone: for functions that take the cut-mesh of refined cells, too.
MANDOLINE_SHARED void requireNotEmpty(const CutMesh& cutMesh);

inline bool isRefined(const CutMesh& cutMesh) { return cutMesh.rowRunOffsets.empty() && !cutMesh.loopOffsets.empty(); }

/// Throws CallError for that of refined cells alone.
MANDOLINE_SHARED void refuseRefined(const CutMesh& cutMesh);

/// Throws CallError with the message where it is known that one thing was not made from the other.
MANDOLINE_SHARED void requireMadeFrom(Fingerprint madeFrom, Fingerprint other, const char* message);

/// Throws CallError for cells of another cut-mesh, or if some are missing.
MANDOLINE_SHARED [[noreturn]] void refuseCells();

/// Throws CallError unless the cell complex was made from the cut-mesh and begins with as many vertices, faces and cells; or with as many
/// or fewer, if cells or faces have members.
MANDOLINE_SHARED void requireCellsOf(const CutMesh& cutMesh, const CellComplex& cells);

/// Throws CallError unless products of four lengths, such as a volume times a distance, fit into doubles.
MANDOLINE_SHARED void requireLengths(const CellComplex& cells);
/// The same of all cells' length along an axis.
MANDOLINE_SHARED void requireLength(double size);

}  // namespace mandoline::operators

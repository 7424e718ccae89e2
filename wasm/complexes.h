// Cell complexes that stay here, and what calls on them take and give.
#pragma once

#include "cut_meshes.h"
#include "mandoline/flow.h"

namespace mandoline::wasm {

using KeptComplex = Kept<CellComplex>;

/// Throws CallError{badArgument} for half-faces that the cells don't have; does not check that they are those of the boundary.
Boundary readBoundary(const val& object, const CellComplex& cells);
/// If it has no boundary, nothing flows through the boundary.
PoissonProblem readProblem(const val& object, const CellComplex& cells);

/// By rows.
template <>
val toObject(const SparseMatrix& matrix);

}  // namespace mandoline::wasm

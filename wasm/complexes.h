// Cell complexes that stay here, and what calls on them take and give.
#pragma once

#include "cut_meshes.h"
#include "mandoline/flow.h"

namespace mandoline::wasm {

using KeptComplex = Kept<CellComplex>;

/// If it has no boundary, nothing flows through the boundary.
PoissonProblem readProblem(const val& object, const CellComplex& cells);

/// How to solve such a problem.
SolveOptions readSolveOptions(const val& options);

template <>
val toObject(const CsrMatrix& matrix);
/// By rows.
template <>
val toObject(const SparseMatrix& matrix);

}  // namespace mandoline::wasm

// Cell complexes and what belongs to them on both sides: as plain data, and as those that stay here.
#pragma once

#include <memory>

#include "mandoline/flow.h"
#include "values.h"

namespace mandoline::wasm {

/// A cell complex that stays until JavaScript deletes its handle, and for as long as a call works on it.
class KeptComplex {
 public:
  explicit KeptComplex(CellComplex cells) : cells_(std::make_shared<const CellComplex>(std::move(cells))) {}
  std::shared_ptr<const CellComplex> get() const { return cells_; }
  /// Size of its arrays.
  double bytes() const;

 private:
  std::shared_ptr<const CellComplex> cells_;
};

/// The arrays that a cell complex has in JavaScript: [{ name, type }].
val describeComplexArrays();

/// Whether its arrays fit together is not asked.
CellComplex readComplex(const val& object);
/// The same; cellComplex() asks.
OctreeCells readOctree(const val& object);
/// Throws CallError{badArgument} for half-faces that the cells don't have; whether they are those of their boundary is not asked.
Boundary readBoundary(const val& object, const CellComplex& cells);
/// Where it says nothing, nothing passes the boundary.
PoissonProblem readProblem(const val& object, const CellComplex& cells);
/// As much of it as a FlowField needs: its wind, velocities and their gradients.
Flow readFlow(const val& object);

val toObject(const OctreeCells& octree);
val toObject(const CellComplex& cells);
val toObject(const SubComplex& sub);
val toObject(const Boundary& boundary);
val toObject(const CellComponents& components);
/// By rows.
val toObject(const SparseMatrix& matrix);
val toObject(const Solution& solution);
val toObject(const Flow& flow);
val toObject(const Streamlines& lines);

}  // namespace mandoline::wasm

#include "complexes.h"

namespace mandoline::wasm {

PoissonProblem readProblem(const val& object, const CellComplex& cells) {
  PoissonProblem result;
  result.boundary = object["boundary"].isUndefined() ? boundaryOf(cells) : fromObject<Boundary>(object["boundary"]);
  if (!object["source"].isUndefined()) readArray(object["source"], result.source);
  if (!object["faceCoefficient"].isUndefined()) readArray(object["faceCoefficient"], result.faceCoefficient);
  if (!object["mass"].isUndefined()) readArray(object["mass"], result.mass);
  result.dualPoints = DualPoints(object["dualPoints"].as<int>());
  return result;
}

SolveOptions readSolveOptions(const val& options) {
  SolveOptions result;
  result.progress = progressOf(options);
  result.tolerance = options["tolerance"].as<double>();
  result.maxIterations = options["maxIterations"].as<int>();
  result.corrections = options["corrections"].as<int>();
  result.freeConstant = FreeConstant(options["freeConstant"].as<int>());
  result.balance = options["balance"].as<bool>();
  return result;
}

template <>
val toObject(const SparseMatrix& matrix) {
  const Eigen::SparseMatrix<double, Eigen::RowMajor> byRows = matrix;
  const size_t rows = size_t(byRows.rows()), entries = size_t(byRows.nonZeros());
  const std::vector<uint32_t> offsets(byRows.outerIndexPtr(), byRows.outerIndexPtr() + rows + 1);
  const std::vector<uint32_t> columns(byRows.innerIndexPtr(), byRows.innerIndexPtr() + entries);
  const std::vector<double> values(byRows.valuePtr(), byRows.valuePtr() + entries);
  return object({{"rows", val(double(rows))},
                 {"columns", val(double(matrix.cols()))},
                 {"rowOffsets", toArray(offsets)},
                 {"entryColumns", toArray(columns)},
                 {"entryValues", toArray(values)}});
}

}  // namespace mandoline::wasm

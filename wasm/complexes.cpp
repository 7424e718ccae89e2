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

namespace {

/// The arrays of a matrix by rows, in integers of any width.
val toMatrix(size_t columns, const auto& rowOffsets, const auto& entryColumns, const auto& entryValues) {
  return object({{"rows", val(double(rowOffsets.size() - 1))},
                 {"columns", val(double(columns))},
                 {"rowOffsets", toArray(std::vector<uint32_t>(rowOffsets.begin(), rowOffsets.end()))},
                 {"entryColumns", toArray(std::vector<uint32_t>(entryColumns.begin(), entryColumns.end()))},
                 {"entryValues", toArray(std::vector<double>(entryValues.begin(), entryValues.end()))}});
}

}  // namespace

template <>
val toObject(const CsrMatrix& matrix) {
  return toMatrix(matrix.columns, matrix.rowOffsets, matrix.entryColumns, matrix.entryValues);
}

template <>
val toObject(const SparseMatrix& matrix) {
  const Eigen::SparseMatrix<double, Eigen::RowMajor> byRows = matrix;
  const auto entries = size_t(byRows.nonZeros());
  return toMatrix(size_t(matrix.cols()), std::span(byRows.outerIndexPtr(), size_t(byRows.rows()) + 1),
                  std::span(byRows.innerIndexPtr(), entries), std::span(byRows.valuePtr(), entries));
}

}  // namespace mandoline::wasm

#include "complexes.h"

namespace mandoline::wasm {

double KeptComplex::bytes() const {
  double sum = 0;
  forEachArray(*cells_, [&](const char*, const auto& array) { sum += double(array.size() * sizeof array[0]); });
  return sum;
}

val describeComplexArrays() {
  val result = val::array();
  const CellComplex none;
  forEachArray(none, [&]<class Number>(const char* name, const std::vector<Number>&) {
    result.call<void>("push", object({{"name", val(std::string(name))}, {"type", val(std::string(arrayType<Number>()))}}));
  });
  return result;
}

CellComplex readComplex(const val& object) {
  CellComplex result;
  result.cutVertices = object["cutVertices"].as<uint32_t>();
  result.cutFaces = object["cutFaces"].as<uint32_t>();
  result.cutCells = object["cutCells"].as<uint32_t>();
  forEachArray(result, [&](const char* name, auto& array) { readArray(object[name], array); });
  return result;
}

OctreeCells readOctree(const val& object) {
  OctreeCells result;
  result.gridCells = readTriple<int32_t>(object["gridCells"]);
  readArray(object["cellCorner"], result.cellCorner);
  readArray(object["cellLevel"], result.cellLevel);
  readArray(object["cellRegion"], result.cellRegion);
  return result;
}

Boundary readBoundary(const val& object, const CellComplex& cells) {
  Boundary result;
  readArray(object["halfFaces"], result.halfFaces);
  readArray(object["condition"], result.condition);
  readArray(object["value"], result.value);
  for (size_t b = 0; b < result.halfFaces.size(); ++b) {
    if (result.halfFaces[b] >= 2 * cells.faceCount())
      throw CallError({Status::badArgument, int64_t(b), -1, "There is no half-face " + std::to_string(result.halfFaces[b]) + "."});
  }
  return result;
}

PoissonProblem readProblem(const val& object, const CellComplex& cells) {
  PoissonProblem result;
  result.boundary = object["boundary"].isUndefined() ? boundaryOf(cells) : readBoundary(object["boundary"], cells);
  if (!object["source"].isUndefined()) readArray(object["source"], result.source);
  result.dualPoints = DualPoints(object["dualPoints"].as<int>());
  return result;
}

Flow readFlow(const val& object) {
  Flow result;
  result.wind = readTriple<double>(object["wind"]);
  readArray(object["cellVelocity"], result.cellVelocity);
  readArray(object["cellGradient"], result.cellGradient);
  return result;
}

val toObject(const OctreeCells& octree) {
  return object({{"gridCells", toTriple(octree.gridCells)},
                 {"cellCorner", toArray(octree.cellCorner)},
                 {"cellLevel", toArray(octree.cellLevel)},
                 {"cellRegion", toArray(octree.cellRegion)}});
}

val toObject(const CellComplex& cells) {
  val result = object({{"cutVertices", val(cells.cutVertices)}, {"cutFaces", val(cells.cutFaces)}, {"cutCells", val(cells.cutCells)}});
  forEachArray(cells, [&](const char* name, const auto& array) { result.set(name, toArray(array)); });
  return result;
}

val toObject(const SubComplex& sub) {
  return object({{"cells", toObject(sub.cells)},
                 {"wholeVertex", toArray(sub.wholeVertex)},
                 {"wholeFace", toArray(sub.wholeFace)},
                 {"wholeCell", toArray(sub.wholeCell)}});
}

val toObject(const Boundary& boundary) {
  return object(
      {{"halfFaces", toArray(boundary.halfFaces)}, {"condition", toArray(boundary.condition)}, {"value", toArray(boundary.value)}});
}

val toObject(const CellComponents& components) {
  return object({{"cellComponent", toArray(components.cellComponent)}, {"count", val(components.count)}});
}

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

val toObject(const Solution& solution) {
  return object({{"status", val(std::string(name(solution.status)))},
                 {"phi", toArray(solution.phi)},
                 {"residuals", toArray(solution.residuals)},
                 {"component", val(double(solution.component))},
                 {"excess", val(solution.excess)}});
}

val toObject(const Flow& flow) {
  return object({{"status", val(std::string(name(flow.status)))},
                 {"residuals", toArray(flow.residuals)},
                 {"wind", toTriple(flow.wind)},
                 {"phi", toArray(flow.phi)},
                 {"faceVelocity", toArray(flow.faceVelocity)},
                 {"cellVelocity", toArray(flow.cellVelocity)},
                 {"cellGradient", toArray(flow.cellGradient)},
                 {"cellPressure", toArray(flow.cellPressure)},
                 {"throttled", toArray(flow.throttled)}});
}

val toObject(const Streamlines& lines) {
  return object({{"points", toArray(lines.points)},
                 {"speeds", toArray(lines.speeds)},
                 {"offsets", toArray(lines.offsets)},
                 {"ends", toArray(lines.ends)}});
}

}  // namespace mandoline::wasm

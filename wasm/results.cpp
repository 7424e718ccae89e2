#include "results.h"

namespace mandoline::wasm {

std::function<bool(const Progress&)> progressOf(const val& options) {
  const val callback = options["progress"];
  if (callback.isUndefined()) return {};
  return [callback](const Progress& progress) { return callback(toObject(progress)).as<bool>(); };
}

RunOptions runOptions(const val& options) {
  RunOptions result;
  result.progress = progressOf(options);
  return result;
}

val toObject(const Mesh& mesh) { return object({{"positions", toArray(mesh.positions)}, {"triangles", toArray(mesh.triangles)}}); }

val toObject(const PairCounts& counts) {
  return object({{"crossing", val(double(counts.crossing))},
                 {"touching", val(double(counts.touching))},
                 {"overlapping", val(double(counts.overlapping))},
                 {"folded", val(double(counts.folded))},
                 {"identical", val(double(counts.identical))}});
}

val toObject(const MeshIntersections& intersections) {
  return object({{"counts", toObject(intersections.counts)},
                 {"pairTriangles", toArray(intersections.pairTriangles)},
                 {"pairKinds", toArray(intersections.pairKinds)},
                 {"pairPointOffsets", toArray(intersections.pairPointOffsets)},
                 {"positions", toArray(intersections.positions)}});
}

val toObject(const Progress& progress) {
  return object({{"stage", val(std::string(progress.stage))},
                 {"stageIndex", val(progress.stageIndex)},
                 {"stageCount", val(progress.stageCount)},
                 {"done", val(double(progress.done))},
                 {"total", val(double(progress.total))}});
}

val toObject(const Measures& measures, const std::vector<double>& regionVolume) {
  return object({{"faceArea", toArray(measures.faceArea)},
                 {"faceNormal", toArray(measures.faceNormal)},
                 {"faceCentroid", toArray(measures.faceCentroid)},
                 {"cellVolume", toArray(measures.cellVolume)},
                 {"cellCentroid", toArray(measures.cellCentroid)},
                 {"regionVolume", toArray(regionVolume)}});
}

val toObject(const CutEdges& edges) {
  return object({{"edgeVertices", toArray(edges.edgeVertices)}, {"edgeLength", toArray(edges.edgeLength)}});
}

val toObject(const Adjacency& adjacency) {
  return object({{"faceCells", toArray(adjacency.faceCells)},
                 {"faceGridCells", toArray(std::vector<double>(adjacency.faceGridCells.begin(), adjacency.faceGridCells.end()))},
                 {"cellCellOffsets", toArray(adjacency.cellCellOffsets)},
                 {"cellCells", toArray(adjacency.cellCells)}});
}

val toObject(const FaceTriangles& faces) {
  return object({{"faceTriangleOffsets", toArray(faces.faceTriangleOffsets)}, {"triangles", toArray(faces.triangles)}});
}

static val toObject(const Check& check) {
  return object({{"name", val(check.name)},
                 {"pass", val(check.pass)},
                 {"skipped", val(check.skipped)},
                 {"worst", val(check.worst)},
                 {"tolerance", val(check.tolerance)},
                 {"elementKind", val(check.elementKind)},
                 {"element", val(double(check.element))},
                 {"message", val(check.message)}});
}

val toObject(const Validation& validation) {
  val result = val::object(), checks = val::array();
  for (size_t i = 0; i < validation.checks.size(); ++i) checks.set(i, toObject(validation.checks[i]));
  result.set("pass", validation.pass);
  result.set("checks", checks);
  return result;
}

val toObject(const Locations& locations) {
  return object({{"cell", toArray(locations.cell)}, {"gridCell", toArray(locations.gridCell)}, {"region", toArray(locations.region)}});
}

val toObject(const Slice& slice) {
  return object({{"positions", toArray(slice.positions)},
                 {"loopOffsets", toArray(slice.loopOffsets)},
                 {"loopPoints", toArray(slice.loopPoints)},
                 {"polygonLoopOffsets", toArray(slice.polygonLoopOffsets)},
                 {"polygonCell", toArray(slice.polygonCell)},
                 {"polygonGridCell", toArray(slice.polygonGridCell)},
                 {"polygonRegion", toArray(slice.polygonRegion)},
                 {"polygonTriangleOffsets", toArray(slice.polygonTriangleOffsets)},
                 {"triangles", toArray(slice.triangles)}});
}

val toObject(const Outlines& outlines) {
  return object({{"positions", toArray(outlines.positions)},
                 {"loopOffsets", toArray(outlines.loopOffsets)},
                 {"loopPoints", toArray(outlines.loopPoints)},
                 {"polygonLoopOffsets", toArray(outlines.polygonLoopOffsets)},
                 {"polygonRegion", toArray(outlines.polygonRegion)},
                 {"slitOffsets", toArray(outlines.slitOffsets)},
                 {"slitPoints", toArray(outlines.slitPoints)},
                 {"slitRegion", toArray(outlines.slitRegion)}});
}

}  // namespace mandoline::wasm

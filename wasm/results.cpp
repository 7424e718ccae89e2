#include "results.h"

namespace mandoline::wasm {

val toObject(const Mesh& mesh) {
  val result = val::object();
  result.set("positions", toArray(mesh.positions));
  result.set("triangles", toArray(mesh.triangles));
  return result;
}

val toObject(const Progress& progress) {
  val result = val::object();
  result.set("stage", std::string(progress.stage));
  result.set("stageIndex", progress.stageIndex);
  result.set("stageCount", progress.stageCount);
  result.set("done", double(progress.done));
  result.set("total", double(progress.total));
  return result;
}

val toObject(const Measures& measures, const std::vector<double>& regionVolume) {
  val result = val::object();
  result.set("faceArea", toArray(measures.faceArea));
  result.set("faceNormal", toArray(measures.faceNormal));
  result.set("faceCentroid", toArray(measures.faceCentroid));
  result.set("cellVolume", toArray(measures.cellVolume));
  result.set("cellCentroid", toArray(measures.cellCentroid));
  result.set("regionVolume", toArray(regionVolume));
  return result;
}

val toObject(const CutEdges& edges) {
  val result = val::object();
  result.set("edgeVertices", toArray(edges.edgeVertices));
  result.set("edgeLength", toArray(edges.edgeLength));
  return result;
}

val toObject(const Adjacency& adjacency) {
  val result = val::object();
  result.set("faceCells", toArray(adjacency.faceCells));
  result.set("faceGridCells", toArray(std::vector<double>(adjacency.faceGridCells.begin(), adjacency.faceGridCells.end())));
  result.set("cellCellOffsets", toArray(adjacency.cellCellOffsets));
  result.set("cellCells", toArray(adjacency.cellCells));
  return result;
}

val toObject(const FaceTriangles& faces) {
  val result = val::object();
  result.set("faceTriangleOffsets", toArray(faces.faceTriangleOffsets));
  result.set("triangles", toArray(faces.triangles));
  return result;
}

static val toObject(const Check& check) {
  val result = val::object();
  result.set("name", check.name);
  result.set("pass", check.pass);
  result.set("skipped", check.skipped);
  result.set("worst", check.worst);
  result.set("tolerance", check.tolerance);
  result.set("elementKind", check.elementKind);
  result.set("element", double(check.element));
  result.set("message", check.message);
  return result;
}

val toObject(const Validation& validation) {
  val result = val::object(), checks = val::array();
  for (size_t i = 0; i < validation.checks.size(); ++i) checks.set(i, toObject(validation.checks[i]));
  result.set("pass", validation.pass);
  result.set("checks", checks);
  return result;
}

val toObject(const Locations& locations) {
  val result = val::object();
  result.set("cell", toArray(locations.cell));
  result.set("gridCell", toArray(locations.gridCell));
  result.set("region", toArray(locations.region));
  return result;
}

val toObject(const Slice& slice) {
  val result = val::object();
  result.set("positions", toArray(slice.positions));
  result.set("loopOffsets", toArray(slice.loopOffsets));
  result.set("loopPoints", toArray(slice.loopPoints));
  result.set("polygonLoopOffsets", toArray(slice.polygonLoopOffsets));
  result.set("polygonCell", toArray(slice.polygonCell));
  result.set("polygonGridCell", toArray(slice.polygonGridCell));
  result.set("polygonRegion", toArray(slice.polygonRegion));
  result.set("polygonTriangleOffsets", toArray(slice.polygonTriangleOffsets));
  result.set("triangles", toArray(slice.triangles));
  return result;
}

val toObject(const Outlines& outlines) {
  val result = val::object();
  result.set("positions", toArray(outlines.positions));
  result.set("loopOffsets", toArray(outlines.loopOffsets));
  result.set("loopPoints", toArray(outlines.loopPoints));
  result.set("polygonLoopOffsets", toArray(outlines.polygonLoopOffsets));
  result.set("polygonRegion", toArray(outlines.polygonRegion));
  result.set("slitOffsets", toArray(outlines.slitOffsets));
  result.set("slitPoints", toArray(outlines.slitPoints));
  result.set("slitRegion", toArray(outlines.slitRegion));
  return result;
}

}  // namespace mandoline::wasm

#include "cut_meshes.h"

#include "results.h"

namespace mandoline::wasm {
namespace {

Grid readPlanes(const val& grid) {
  std::array<std::vector<double>, 3> planes;
  for (int d = 0; d < 3; ++d) readArray(grid["planes"][d], planes[d]);
  Grid result = Grid::rectilinear(std::move(planes));
  if (!grid["spacing"].isNull()) {
    result.uniform = true;
    result.origin = readTriple<double>(grid["origin"]);
    result.spacing = readTriple<double>(grid["spacing"]);
  }
  return result;
}

val toObject(const Grid& grid) {
  val result = val::object(), planes = val::array();
  for (int d = 0; d < 3; ++d) planes.set(d, toArray(grid.planes[d]));
  result.set("origin", toTriple(grid.origin));
  result.set("spacing", grid.uniform ? toTriple(grid.spacing) : val::null());
  result.set("cells", toTriple(std::array<int64_t, 3>{grid.cells(0), grid.cells(1), grid.cells(2)}));
  result.set("planes", planes);
  return result;
}

val toObject(const CutStats& stats) {
  val result = val::object(), stages = val::array();
  for (size_t i = 0; i < stats.stages.size(); ++i) {
    val stage = val::object();
    stage.set("stage", std::string(stats.stages[i].stage));
    stage.set("ms", stats.stages[i].ms);
    stages.set(i, stage);
  }
  result.set("stages", stages);
  result.set("totalMs", stats.totalMs);
  result.set("exactFallbacks", double(stats.exactFallbacks));
  result.set("weldedVertices", stats.weldedVertices);
  result.set("zeroAreaTriangles", stats.zeroAreaTriangles);
  result.set("duplicateTriangles", stats.duplicateTriangles);
  result.set("outsideTriangles", stats.outsideTriangles);
  result.set("intersections", wasm::toObject(stats.intersections));
  result.set("intersectionCurves", stats.intersectionCurves);
  result.set("madeVertices", stats.madeVertices);
  result.set("snappedVertices", stats.snappedVertices);
  result.set("largestSnap", stats.largestSnap);
  result.set("flushedCoordinates", stats.flushedCoordinates);
  return result;
}

}  // namespace

double KeptCutMesh::bytes() const {
  double sum = 0;
  forEachArray(*cutMesh_, [&](const ArrayInfo&, const auto& array) { sum += double(array.size() * sizeof array[0]); });
  return sum;
}

double KeptMesh::bytes() const {
  const MeshView mesh = mesh_.mesh();
  return 3 * double(mesh.positions.size_bytes()) + 8 * double(mesh.triangles.size_bytes());
}

val describeArrays() {
  val result = val::array();
  const CutMesh none;
  forEachArray(none, [&]<class Number>(const ArrayInfo& info, const std::vector<Number>&) {
    val array = val::object();
    array.set("name", std::string(info.name));
    array.set("type", std::string(arrayType<Number>()));
    array.set("optional", info.optional);
    result.call<void>("push", array);
  });
  return result;
}

Mesh readMeshArrays(const val& mesh) {
  Mesh result;
  readArray(mesh["positions"], result.positions);
  readArray(mesh["triangles"], result.triangles);
  return result;
}

ResolvedMesh readResolvedMesh(const val& object) {
  ResolvedMesh result;
  result.mesh = readMeshArrays(object);
  result.hasWinding = !object["frontWinding"].isNull();
  if (!result.hasWinding) return result;
  readArray(object["frontWinding"], result.frontWinding);
  readArray(object["backWinding"], result.backWinding);
  return result;
}

Grid readGrid(const val& grid, const MeshView& mesh) {
  const std::string kind = grid["kind"].as<std::string>();
  if (kind == "planes") return readPlanes(grid);
  if (kind == "around") return Grid::around(mesh, int64_t(grid["cells"].as<double>()), grid["margin"].as<double>());
  const auto cells = readTriple<int64_t>(grid["cells"]);
  if (kind == "box") return Grid::box(readTriple<double>(grid["min"]), readTriple<double>(grid["max"]), cells);
  return Grid::regular(readTriple<double>(grid["origin"]), readTriple<double>(grid["spacing"]), cells);
}

CutMesh readCutMesh(const val& object) {
  CutMesh result;
  result.grid = readPlanes(object["grid"]);
  forEachArray(result, [&](const ArrayInfo& info, auto& array) {
    if (!object[info.name].isNull()) readArray(object[info.name], array);
  });
  result.regionCount = object["regionCount"].as<uint32_t>();
  result.hasWinding = !object["regionWinding"].isNull();
  result.triangleCount = object["triangleCount"].as<uint32_t>();
  return result;
}

val toObject(const CutMesh& mesh, const CutStats& stats, bool dense) {
  val result = val::object();
  result.set("grid", toObject(mesh.grid));
  forEachArray(mesh, [&](const ArrayInfo& info, const auto& array) {
    const bool absent = info.optional && !mesh.hasWinding;
    result.set(info.name, absent ? val::null() : toArray(array));
  });
  if (dense) result.set("gridCellRegion", toArray(mesh.gridCellRegion()));
  result.set("regionCount", mesh.regionCount);
  result.set("triangleCount", mesh.triangleCount);
  result.set("stats", toObject(stats));
  return result;
}

val toObject(const ResolveResult& result) {
  const ResolvedMesh& resolved = result.mesh;
  const auto winding = [&](const std::vector<int32_t>& array) { return resolved.hasWinding ? toArray(array) : val::null(); };
  return object({{"positions", toArray(resolved.mesh.positions)},
                 {"triangles", toArray(resolved.mesh.triangles)},
                 {"vertexTriVertex", toArray(resolved.vertexTriVertex)},
                 {"parentOffsets", toArray(resolved.parentOffsets)},
                 {"parents", toArray(resolved.parents)},
                 {"parentSigns", toArray(resolved.parentSigns)},
                 {"frontWinding", winding(resolved.frontWinding)},
                 {"backWinding", winding(resolved.backWinding)},
                 {"remaining", wasm::toObject(result.remaining)},
                 {"stats", toObject(result.stats)}});
}

}  // namespace mandoline::wasm

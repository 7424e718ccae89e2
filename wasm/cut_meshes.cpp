#include "cut_meshes.h"

namespace mandoline::wasm {

double KeptMesh::bytes() const {
  const MeshView mesh = mesh_.mesh();
  return 3 * double(mesh.positions.size_bytes()) + 8 * double(mesh.triangles.size_bytes());
}

val keepCutMesh(const val& cutMesh, bool isChecked) {
  return guarded([&] {
    if (isChecked) return keepChecked<CutMesh>(cutMesh, "cutMesh");
    return success(val(KeptCutMesh(fromObject<CutMesh>(cutMesh))));
  });
}

val arraysOf(const MeshView& mesh) {
  return object({{"positions", toArray("Float64Array", mesh.positions.data(), mesh.positions.size())},
                 {"triangles", toArray("Uint32Array", mesh.triangles.data(), mesh.triangles.size())}});
}

val lastStage(const CutStats& stats) { return val(std::string(stats.stages.empty() ? "input" : stats.stages.back().stage)); }

val outcomeOf(CutResult& result, const val& options, std::vector<int32_t> gridCellRegion) {
  if (!result) return failure(result.error, lastStage(result.stats));
  val value = val::object(), plain = toObject(result.mesh, options["copy"]);
  if (options["gridCellRegion"].as<bool>()) {
    if (gridCellRegion.empty()) gridCellRegion = result.mesh.gridCellRegion();
    plain.set("gridCellRegion", toArray(gridCellRegion, options["copy"]));
  }
  plain.set("stats", toObject(result.stats));
  value.set("value", plain);
  if (options["keep"].as<bool>()) value.set("twin", KeptCutMesh(std::move(result.mesh)));
  return success(value);
}

val dataOf(const KeptCutMesh& kept) {
  return guarded([&, cutMesh = kept.get()] { return success(toObject(*cutMesh)); });
}

CoarsenOptions readCoarsening(const val& options) {
  CoarsenOptions result;
  result.maxLevel = options["maxLevel"].as<int>();
  result.fineLayers = options["fineLayers"].as<int>();
  result.layersPerLevel = options["layersPerLevel"].as<int>();
  result.balanceEdges = options["balanceEdges"].as<bool>();
  return result;
}

Grid readGrid(const val& grid, const MeshView& mesh) {
  const std::string kind = grid["kind"].as<std::string>();
  if (kind == "planes") return fromObject<Grid>(grid);
  if (kind == "around") return Grid::around(mesh, int64_t(grid["cells"].as<double>()), grid["margin"].as<double>());
  const auto cells = readTriple<int64_t>(grid["cells"]);
  if (kind == "box") return Grid::box(readTriple<double>(grid["min"]), readTriple<double>(grid["max"]), cells);
  return Grid::regular(readTriple<double>(grid["origin"]), readTriple<double>(grid["spacing"]), cells);
}

}  // namespace mandoline::wasm

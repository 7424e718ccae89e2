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

val dataOf(const KeptCutMesh& kept) {
  return guarded([&, cutMesh = kept.get()] { return success(toObject(*cutMesh)); });
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

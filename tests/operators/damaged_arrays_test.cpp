// Cut-meshes may come from elsewhere: those that pass checkArrays() must not lead any function astray. Wrong answers are fine, wrong memory
// accesses are what the sanitizers look for here.
#include <cstdint>
#include <random>

#include "catch.h"
#include "mandoline/cell_complex.h"
#include "mandoline/io.h"
#include "mandoline/locate.h"
#include "mandoline/measure.h"
#include "mandoline/slice.h"
#include "mandoline/triangulate.h"
#include "mandoline/validate.h"
#include "mcm_file.h"
#include "same_bits.h"
#include "shapes.h"

using namespace mandoline;

namespace {

class Damage {
 public:
  explicit Damage(uint32_t seed) : random_(seed) {}

  CutMesh operator()(CutMesh mesh) {
    int count = 0;
    forEachArray(mesh, [&](const ArrayInfo&, const auto&) { ++count; });
    int chosen = int(random_() % uint32_t(count));
    forEachArray(mesh, [&](const ArrayInfo&, auto& array) {
      if (chosen-- == 0 && !array.empty()) damage(array);
    });
    return mesh;
  }

 private:
  /// Entries that are wrong, but often in range.
  template <class Array>
  void damage(Array& array) {
    using Number = typename Array::value_type;
    for (int i = 0; i < 3; ++i) {
      Number& entry = array[random_() % array.size()];
      const Number other = array[random_() % array.size()];
      const Number values[] = {Number(0), Number(-1), Number(entry + 1), Number(entry - 1), other, other};
      entry = values[random_() % 6];
    }
    if (random_() % 16 == 0) array.pop_back();
  }

  std::mt19937 random_;
};

template <class F>
void mayRefuse(const F& call) {
  try {
    call();
  } catch (const CallError& error) {
    CHECK(error.error.status == Status::badArgument);
  }
}

void useAll(const Mesh& mesh, const CutMesh& cutMesh) {
  const Sink nowhere = [](std::string_view) {};
  // Where a damaged vertex is no longer the mesh's, that is reported.
  mayRefuse([&] {
    regionVolumes(cutMesh, measure(mesh, cutMesh));
    cutEdges(mesh, cutMesh);
    writeVtu(nowhere, mesh, cutMesh);
    cellComplex(mesh, cutMesh, coarsen(cutMesh));
  });
  adjacency(cutMesh);
  triangulateFaces(cutMesh);
  for (size_t c = 0; c < cutMesh.cellCount(); ++c) triangulateCell(cutMesh, c);
  for (uint32_t r = 0; r < cutMesh.regionCount; ++r) triangulateRegion(cutMesh, r);
  cellsAt(cutMesh, mesh.positions);
  slice(cutMesh, {{1, 2, 3}, 0.3});
  slice(cutMesh, {{0, 0, 1}, cutMesh.grid.planes[2][1]});
  writeJson(nowhere, cutMesh);
  writeObj(nowhere, cutMesh);
  CHECK(differences(cutMesh, readMcm(mcmOf(cutMesh))).empty());
}

}  // namespace

TEST_CASE("damaged cut-meshes lead no function astray", "[validate]") {
  // The second one crosses the first, so that there are made vertices.
  const Mesh mesh = shapes::merged({shapes::torus({0, 0, 0}, 1, 0.4, 12, 8), shapes::torus({0.9, 0.1, 0.2}, 0.4, 0.2, 6, 4)});
  const CutResult result = cut(mesh, Grid::around(mesh, 5));
  REQUIRE(result);
  const MeshView view = mesh;
  Damage damage(1);
  int harmless = 0;
  for (int round = 0; round < 600; ++round) {
    const CutMesh damaged = damage(result.mesh);
    validate(mesh, damaged);
    if (!checkArrays(damaged, &view).pass) continue;
    ++harmless;
    useAll(mesh, damaged);
  }
  CHECK(harmless > 120);
  CHECK(harmless < 560);
}

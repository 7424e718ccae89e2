// Cut-meshes may come from elsewhere: those that pass checkArrays() must not lead any function astray. Wrong answers are fine, wrong memory
// accesses are what the sanitizers look for here.
#include <cstdint>
#include <random>

#include "catch.h"
#include "mandoline/io.h"
#include "mandoline/locate.h"
#include "mandoline/measure.h"
#include "mandoline/slice.h"
#include "mandoline/triangulate.h"
#include "mandoline/validate.h"
#include "shapes.h"

using namespace mandoline;

namespace {

template <class F>
void forEachArray(CutMesh& mesh, const F& f) {
  f(mesh.positions), f(mesh.vertexCell), f(mesh.vertexMask), f(mesh.vertexTriVertex), f(mesh.vertexParents), f(mesh.loopOffsets),
      f(mesh.loopVertices), f(mesh.faceLoopOffsets), f(mesh.faceTriangle), f(mesh.faceAxis), f(mesh.facePlane), f(mesh.cellHalfFaceOffsets),
      f(mesh.cellHalfFaces), f(mesh.cellGridCell), f(mesh.cellRegion), f(mesh.rowRunOffsets), f(mesh.runBegin), f(mesh.runEnd),
      f(mesh.runRegion), f(mesh.regionWinding), f(mesh.droppedTriangles);
}

class Damage {
 public:
  explicit Damage(uint32_t seed) : random_(seed) {}

  CutMesh operator()(CutMesh mesh) {
    int chosen = int(random_() % 21);
    forEachArray(mesh, [&](auto& array) {
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
  });
  adjacency(cutMesh);
  triangulateFaces(cutMesh);
  for (size_t c = 0; c < cutMesh.cellCount(); ++c) triangulateCell(cutMesh, c);
  for (uint32_t r = 0; r < cutMesh.regionCount; ++r) triangulateRegion(cutMesh, r);
  locate(cutMesh, mesh.positions);
  slice(cutMesh, {{1, 2, 3}, 0.3});
  slice(cutMesh, {{0, 0, 1}, cutMesh.grid.planes[2][1]});
  writeJson(nowhere, cutMesh);
  writeObj(nowhere, cutMesh);
}

}  // namespace

TEST_CASE("damaged cut-meshes lead no function astray") {
  const Mesh mesh = shapes::torus({0, 0, 0}, 1, 0.4, 12, 8);
  const CutResult result = cut(mesh, Grid::around(mesh, 5));
  REQUIRE(result);
  const MeshView view = mesh;
  Damage damage(1);
  int harmless = 0;
  for (int round = 0; round < 1500; ++round) {
    const CutMesh damaged = damage(result.mesh);
    validate(mesh, damaged);
    if (!checkArrays(damaged, &view).pass) continue;
    ++harmless;
    useAll(mesh, damaged);
  }
  CHECK(harmless > 300);
  CHECK(harmless < 1400);
}

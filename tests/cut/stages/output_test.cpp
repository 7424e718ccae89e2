#include <map>
#include <set>

#include "catch.h"
#include "staged_cut.h"

using namespace stages;

TEST_CASE("Vertices come by kind, with their parents", "[stages][output]") {
  const CutMesh cutMesh = cutMeshOf(shapes::triangle({0.5, 0.5, 0.5}, {1.75, 0.5, 0.5}, {0.5, 1.75, 0.5}));
  int kind = 0;
  for (size_t v = 0; v < cutMesh.vertexCount(); ++v) {
    const int32_t a = cutMesh.vertexParents[2 * v], b = cutMesh.vertexParents[2 * v + 1];
    const int here = cutMesh.vertexTriVertex[v] >= 0 ? 0 : b >= 0 ? 1 : 2;  // 2: on a grid line
    CHECK(here >= kind);
    kind = here;
    if (here == 0) CHECK((a == b && a == cutMesh.vertexTriVertex[v]));
    if (here == 1) CHECK(a < b);
    if (here == 2) CHECK((a == 0 || a == -1));
  }
  CHECK(kind == 2);
}

TEST_CASE("Pieces of triangles come first, by grid cell and then by triangle", "[stages][output]") {
  const Mesh mesh = shapes::icosphere({1.5, 1.5, 1.5}, 1.2, 2);
  for (const int shift : {0, 1, 2}) {
    Way way;
    way.brickShift = shift;
    const CutMesh cutMesh = cutMeshOf(mesh, unitCells(), way);
    std::vector<std::array<int32_t, 2>> places(cutMesh.faceCount(), {-1, -1});  // grid cell and triangle
    for (size_t c = 0; c < cutMesh.cellCount(); ++c) {
      const int32_t* at = &cutMesh.cellGridCell[3 * c];
      for (const uint32_t h : cutMesh.halfFaces(c)) places[h / 2] = {(at[2] * 3 + at[1]) * 3 + at[0], cutMesh.faceTriangle[h / 2]};
    }
    const auto past = std::find(cutMesh.faceTriangle.begin(), cutMesh.faceTriangle.end(), -1) - cutMesh.faceTriangle.begin();
    CHECK(past > 320);
    CHECK(std::count(cutMesh.faceTriangle.begin() + past, cutMesh.faceTriangle.end(), -1) == std::ptrdiff_t(cutMesh.faceCount()) - past);
    CHECK(std::is_sorted(places.begin(), places.begin() + past));
  }
}

TEST_CASE("The input's own coordinates are handed back, even those that scaling flushed", "[stages][output]") {
  const Mesh mesh = shapes::triangle({0.5, 1e-70, 0.5}, {1.75, 0.5, 0.5}, {0.5, 1.75, 0.5});
  const CutMesh cutMesh = cutMeshOf(mesh);
  for (size_t v = 0; v < cutMesh.vertexCount(); ++v) {
    const int32_t t = cutMesh.vertexTriVertex[v];
    for (int d = 0; d < 3 && t >= 0; ++d) {
      if (!(cutMesh.vertexMask[v] >> d & 1)) CHECK(cutMesh.positions[3 * v + d] == mesh.positions[3 * size_t(t) + d]);
    }
  }
}

TEST_CASE("No two vertices have the same position, however near they are", "[stages][output]") {
  // Two edges from one vertex that cross the plane x = 1 next to each other, far from the origin.
  const double far = 0x1p40;
  const Grid grid = Grid::regular({far, far, far}, {1, 1, 1}, {3, 3, 3});
  const double step = 0x1p-12;
  const Mesh mesh = shapes::triangle({far + 1 - step, far + 1.5, far + 1.5}, {far + 2.5, far + 1.5 + step, far + 1.5},
                                     {far + 2.5, far + 1.5, far + 1.5 + step});
  const CutMesh cutMesh = cutMeshOf(mesh, grid);
  std::set<std::array<double, 3>> places;
  for (size_t v = 0; v < cutMesh.vertexCount(); ++v) {
    places.insert({cutMesh.positions[3 * v], cutMesh.positions[3 * v + 1], cutMesh.positions[3 * v + 2]});
  }
  CHECK(places.size() == cutMesh.vertexCount());
}

TEST_CASE("Triangles without a face are listed as dropped", "[stages][output]") {
  const Mesh inside = shapes::triangle({0.5, 0.5, 0.5}, {1.5, 0.5, 0.5}, {0.5, 1.5, 0.5});
  const Mesh outside = shapes::triangle({5, 5, 5}, {6, 5, 5}, {5, 6, 5});
  const Mesh flat = shapes::triangle({2, 2, 2}, {2.5, 2.5, 2.5}, {2.25, 2.25, 2.25});
  const CutMesh cutMesh = cutMeshOf(shapes::merged({outside, inside, flat, inside}));
  CHECK(cutMesh.triangleCount == 4);
  CHECK(cutMesh.droppedTriangles == std::vector<uint32_t>{0, 2});
}

TEST_CASE("The description covers every array with its length", "[stages][output]") {
  const CutMesh cutMesh = cutMeshOf(shapes::merged({shapes::cube(0.5, 2.5), shapes::cube(0.75, 2.75)}));
  std::map<Element, size_t> counts = {{Element::vertex, cutMesh.vertexCount()},
                                      {Element::loop, cutMesh.loopCount()},
                                      {Element::loopVertex, cutMesh.loopVertices.size()},
                                      {Element::face, cutMesh.faceCount()},
                                      {Element::faceParent, cutMesh.faceParents.size()},
                                      {Element::madeVertex, cutMesh.madeVertices.size()},
                                      {Element::cell, cutMesh.cellCount()},
                                      {Element::cellHalfFace, cutMesh.cellHalfFaces.size()},
                                      {Element::row, 9},
                                      {Element::run, cutMesh.runRegion.size()},
                                      {Element::region, cutMesh.regionCount},
                                      {Element::parityTriangle, cutMesh.parityTriangles.size()},
                                      {Element::openTriangle, cutMesh.openTriangles.size()},
                                      {Element::droppedTriangle, cutMesh.droppedTriangles.size()}};
  std::set<std::string> names;
  forEachArray(cutMesh, [&](const ArrayInfo& info, const auto& array) {
    const bool isAbsent = info.per == Element::region && array.empty();
    if (!isAbsent) CHECK(array.size() == size_t(info.items) * counts.at(info.per) + (info.offsets ? 1 : 0));
    CHECK(names.insert(info.name).second);
  });
  CHECK(names.size() == 32);
  CHECK(cutMesh.madeVertices.size() > 5);
}

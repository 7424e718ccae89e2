// What inspect() tells of meshes: components, and where edges are open, non-manifold or inconsistent.
#include "mandoline/inspect.h"

#include "catch.h"
#include "refusal.h"
#include "shapes.h"

using namespace mandoline;

namespace {

using Ids = std::vector<uint32_t>;

std::vector<EdgeDefect> kinds(size_t count, EdgeDefect kind) { return std::vector<EdgeDefect>(count, kind); }

/// Of a temporary, too.
MeshInfo infoOf(const Mesh& mesh) { return inspect(mesh); }

}  // namespace

TEST_CASE("Edges of a closed and oriented mesh have no defects", "[inspect]") {
  const MeshInfo info = infoOf(shapes::unwelded(shapes::cube(0, 1)));
  CHECK(info.closed);
  CHECK(info.oriented);
  CHECK(info.components == 1);
  CHECK(info.triangleComponent == std::vector<int32_t>(12, 0));
  CHECK(info.componentClosed == std::vector<uint8_t>{1});
  CHECK(info.componentOriented == std::vector<uint8_t>{1});
  CHECK(info.defectCount() == 0);
  CHECK(info.defectTriangleOffsets == Ids{0});
  CHECK(info.placeCount() == 0);
}

TEST_CASE("A turned triangle has three inconsistent edges in one place, and blinds only its own component", "[inspect]") {
  Mesh mesh = shapes::merged({shapes::cube(0, 1), shapes::tetrahedron({4, 0, 0}, {5, 0, 0}, {4, 1, 0}, {4, 0, 1}), shapes::cube(8, 9)});
  std::swap(mesh.triangles[3 * 13], mesh.triangles[3 * 13 + 1]);
  const MeshInfo info = infoOf(mesh);
  CHECK(info.closed);
  CHECK_FALSE(info.oriented);
  CHECK(info.components == 3);
  CHECK(info.componentClosed == std::vector<uint8_t>{1, 1, 1});
  CHECK(info.componentOriented == std::vector<uint8_t>{1, 0, 1});
  CHECK(info.inconsistentEdges == 3);
  CHECK(info.defectKind == kinds(3, EdgeDefect::inconsistent));
  CHECK(info.defectPlace == Ids{0, 0, 0});
  CHECK(info.placeComponent == Ids{1});
  for (size_t d = 0; d < 3; ++d) {
    REQUIRE(info.defectTriangleOffsets[d] == 2 * d);
    const uint32_t a = info.defectTriangles[2 * d], b = info.defectTriangles[2 * d + 1];
    CHECK(a < b);
    CHECK((a == 13 || b == 13));
    CHECK(info.defectVertices[2 * d] < info.defectVertices[2 * d + 1]);
    for (const size_t end : {2 * d, 2 * d + 1}) {
      const auto corners = mesh.triangles.begin() + 3 * 13;
      CHECK(std::count(corners, corners + 3, info.defectVertices[end]) == 1);
    }
  }
}

TEST_CASE("The open edges around each hole are a place of their own, with its box", "[inspect]") {
  const Mesh tube = shapes::tube({0, 0, 1}, 2, 5, 8, false);
  const MeshInfo info = infoOf(tube);
  CHECK(info.openEdges == 16);
  CHECK(info.defectKind == kinds(16, EdgeDefect::open));
  CHECK(info.placeComponent == Ids{0, 0});
  const double heights[] = {info.placeBox[2], info.placeBox[5], info.placeBox[8], info.placeBox[11]};
  CHECK(heights[0] == heights[1]);
  CHECK(heights[2] == heights[3]);
  CHECK(heights[0] + heights[2] == 7);
  CHECK(std::fabs(heights[0] - heights[2]) == 5);
  CHECK(info.placeBox[0] == Approx(-2));
  CHECK(info.placeBox[3] == Approx(2));
  for (size_t d = 0; d < 16; ++d) CHECK(tube.positions[3 * info.defectVertices[2 * d] + 2] == info.placeBox[6 * info.defectPlace[d] + 2]);
}

TEST_CASE("A non-manifold edge names all its triangles, and vertices at one position by the lowest", "[inspect]") {
  const MeshInfo info = infoOf(shapes::unwelded(shapes::fan({0, 0, 0}, 2, {{1, 0}, {0, 1}, {-1, 0}})));
  CHECK(info.nonManifoldEdges == 1);
  const auto at = std::find(info.defectKind.begin(), info.defectKind.end(), EdgeDefect::nonManifold) - info.defectKind.begin();
  CHECK(info.defectTriangleOffsets[size_t(at) + 1] - info.defectTriangleOffsets[size_t(at)] == 3);
  CHECK(info.placeCount() == 1);
  CHECK(info.placeBox == std::vector<double>{-1, 0, 0, 1, 1, 2});
}

TEST_CASE("Boxes that share a vertex are two components, and triangles without three vertices are in none", "[inspect]") {
  Mesh mesh = shapes::merged({shapes::cube(0, 1), shapes::cube(1, 2)});
  mesh.triangles.insert(mesh.triangles.end(), {0, 0, 1});
  const MeshInfo info = infoOf(mesh);
  CHECK(info.components == 2);
  CHECK(info.triangleComponent[11] == 0);
  CHECK(info.triangleComponent[12] == 1);
  CHECK(info.triangleComponent[24] == -1);
  CHECK(infoOf(Mesh()).components == 0);
  CHECK_FALSE(infoOf(Mesh()).closed);
}

TEST_CASE("A mesh that can't be inspected is refused", "[inspect]") {
  using Refusal = std::pair<Status, int64_t>;
  const auto inspect = [](const Mesh& mesh) { return refusal([&] { mandoline::inspect(mesh); }); };
  CHECK(inspect({{0, 0, 0}, {0, 0, 0, 0, 1, 0}}) == Refusal{Status::badIndex, 1});
  CHECK(inspect({{0, 0}, {}}) == Refusal{Status::badArrays, -1});
  CHECK(inspect({{0, 0, 0}, {0, 0}}) == Refusal{Status::badArrays, -1});
  CHECK(inspect({{0, 0, 0}, {0, 0, 0}}) == Refusal{Status::ok, -1});
}

// findIntersections(): kinds, places and counts of the pairs of triangles that meet.
#include <algorithm>
#include <cmath>

#include "catch.h"
#include "mandoline/intersections.h"
#include "mandoline/prepare.h"
#include "shapes.h"

using namespace mandoline;

namespace {

using Corners = std::vector<shapes::Point>;

Mesh meshOf(const std::vector<Corners>& triangles) {
  std::vector<Mesh> meshes;
  for (const Corners& t : triangles) meshes.push_back(shapes::triangle(t[0], t[1], t[2]));
  return shapes::merged(meshes);
}

const Corners kGround = {{0, 0, 0}, {4, 0, 0}, {0, 4, 0}};

MeshIntersections withGround(const Corners& other) {
  const Mesh mesh = meshOf({kGround, other});
  return findIntersections(mesh);
}

void requireOne(const MeshIntersections& found, IntersectionKind kind, size_t points) {
  REQUIRE(found.counts.total() == 1);
  REQUIRE(found.pairTriangles == std::vector<uint32_t>{0, 1});
  REQUIRE(found.pairKinds == std::vector<uint8_t>{uint8_t(kind)});
  REQUIRE(found.pairPointOffsets == std::vector<uint32_t>{0, uint32_t(points)});
  REQUIRE(found.positions.size() == 3 * points);
}

}  // namespace

TEST_CASE("found pairs: triangles that cross along a segment", "[findIntersections]") {
  const MeshIntersections found = withGround({{1, 1, -1}, {1, 1, 1}, {2, 1, 1}});
  requireOne(found, IntersectionKind::crossing, 2);
  REQUIRE(std::min(found.positions[0], found.positions[3]) == 1);
  REQUIRE(std::max(found.positions[0], found.positions[3]) == 1.5);
}

TEST_CASE("found pairs: a corner on a face, and a side along it", "[findIntersections]") {
  const MeshIntersections corner = withGround({{1, 1, 0}, {1, 1, 1}, {2, 1, 1}});
  requireOne(corner, IntersectionKind::touching, 1);
  REQUIRE(corner.positions == std::vector<double>{1, 1, 0});
  requireOne(withGround({{1, 1, 0}, {2, 1, 0}, {2, 1, 1}}), IntersectionKind::touching, 2);
}

TEST_CASE("found pairs: an overlap is a polygon about the normal of the first", "[findIntersections]") {
  const MeshIntersections found = withGround({{1, 1, 0}, {1, -1, 0}, {-1, 1, 0}});
  requireOne(found, IntersectionKind::overlapping, 4);
  double twiceArea = 0;
  for (size_t i = 0; i < 4; ++i) {
    const double *p = &found.positions[3 * i], *q = &found.positions[3 * ((i + 1) % 4)];
    twiceArea += p[0] * q[1] - p[1] * q[0];
  }
  REQUIRE(twiceArea == 2);
}

TEST_CASE("found pairs: a fold over a shared edge, and the same triangle again", "[findIntersections]") {
  requireOne(withGround({{4, 0, 0}, {0, 0, 0}, {1, 1, 0}}), IntersectionKind::folded, 3);
  requireOne(withGround({{4, 0, 0}, {0, 0, 0}, {0, 4, 0}}), IntersectionKind::identical, 3);
}

TEST_CASE("found pairs: neighbours that share a vertex or an edge are not listed", "[findIntersections]") {
  const Mesh mesh = shapes::torus({0, 0, 0}, 1, 0.4, 12, 8);
  REQUIRE(findIntersections(mesh).counts.total() == 0);
}

TEST_CASE("found pairs: copies count, and are listed in order up to a cap", "[findIntersections]") {
  const Corners wall = {{1, 1, -1}, {1, 1, 1}, {2, 1, 1}};
  const Mesh mesh = meshOf({wall, kGround, wall, kGround, wall});
  const MeshIntersections all = findIntersections(mesh);
  REQUIRE(all.counts.crossing == 6);
  REQUIRE(all.counts.identical == 4);
  REQUIRE(all.pairTriangles == std::vector<uint32_t>{0, 1, 0, 2, 0, 3, 0, 4, 1, 2, 1, 3, 1, 4, 2, 3, 2, 4, 3, 4});
  for (size_t most = 0; most < 12; ++most) {
    const MeshIntersections some = findIntersections(mesh, {{}, most});
    REQUIRE(some.counts.total() == 10);
    REQUIRE(some.pairCount() == std::min<size_t>(most, 10));
    REQUIRE(std::equal(some.pairTriangles.begin(), some.pairTriangles.end(), all.pairTriangles.begin()));
    REQUIRE(std::equal(some.pairKinds.begin(), some.pairKinds.end(), all.pairKinds.begin()));
    REQUIRE(std::equal(some.positions.begin(), some.positions.end(), all.positions.begin()));
  }
}

TEST_CASE("found pairs: refuse names the first and counts all", "[findIntersections]") {
  const Mesh mesh = meshOf({kGround, {{1, 1, -1}, {1, 1, 1}, {2, 1, 1}}, kGround});
  const PrepareResult result = prepare(mesh, {{}, Intersections::refuse});
  REQUIRE(result.error.status == Status::selfIntersection);
  REQUIRE(result.error.element == 0);
  REQUIRE(result.error.element2 == 1);
  REQUIRE(result.error.message == "Triangles 0 and 1 meet other than in a shared vertex or edge, the first of 3 pairs that do.");
  const Mesh cube = shapes::cube(0, 1);
  REQUIRE(prepare(cube, {{}, Intersections::refuse}));
}

TEST_CASE("found pairs: bad meshes and cancelling", "[findIntersections]") {
  Mesh mesh = shapes::cube(0, 1);
  IntersectionOptions options;
  options.progress = [](const Progress&) { return false; };
  const auto statusOf = [](const Mesh& of, const IntersectionOptions& with) {
    try {
      findIntersections(of, with);
    } catch (const CallError& error) {
      return error.error.status;
    }
    return Status::ok;
  };
  REQUIRE(statusOf(mesh, options) == Status::cancelled);
  REQUIRE(statusOf({}, {}) == Status::emptyMesh);
  mesh.positions[4] = NAN;
  REQUIRE(statusOf(mesh, {}) == Status::nonFiniteCoordinate);
  mesh.triangles[2] = 8;
  REQUIRE(statusOf(mesh, {}) == Status::badIndex);
}

TEST_CASE("prepare: of several bad triangles or vertices the first is named, whichever thread finds one", "[prepare]") {
  constexpr size_t kMany = 100'000;
  Mesh mesh;
  for (size_t i = 0; i < kMany; ++i) {
    for (const double x : {double(i), double(i % 7), 0.0}) mesh.positions.push_back(x);
    for (size_t corner = 0; corner < 3; ++corner) mesh.triangles.push_back(uint32_t((i + corner) % kMany));
  }
  for (const unsigned threads : {1u, 2u, 3u}) {
    PrepareOptions options;
    options.threads = threads;
    const auto refusal = [&](const Mesh& bad) {
      const Error error = prepare(bad, options).error;
      return std::pair(error.status, error.element);
    };
    Mesh bad = mesh;
    for (const size_t v : {99'990, 60'000, 40'001}) bad.positions[3 * v + 1] = INFINITY;
    CHECK(refusal(bad) == std::pair<Status, int64_t>(Status::nonFiniteCoordinate, 40'001));
    for (const size_t t : {99'998, 70'000, 30'003}) bad.triangles[3 * t + 2] = kMany;
    CHECK(refusal(bad) == std::pair<Status, int64_t>(Status::badIndex, 30'003));
  }
}

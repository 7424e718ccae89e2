// What several processes read of a mesh, each for its band.
#include <map>
#include <set>

#include "catch.h"
#include "mesh/mesh_band.h"
#include "shapes.h"

using namespace mandoline;
using namespace mandoline::detail;

namespace {

using Place = std::array<double, 3>;

Place placeOf(const Mesh& mesh, uint32_t v) {
  return {mesh.positions[3 * size_t(v)], mesh.positions[3 * size_t(v) + 1], mesh.positions[3 * size_t(v) + 2]};
}

/// The same, found with all of the mesh at hand.
BandTriangles bandOf(const Mesh& mesh, const Band& band) {
  BandTriangles out;
  std::set<Place> within;
  std::map<Place, uint32_t> lowest;
  std::vector<uint8_t> reaches;
  const auto cornersOf = [&](size_t t) { return std::span(mesh.triangles).subspan(3 * t, 3); };
  for (size_t t = 0; t < mesh.triangleCount(); ++t) {
    double least = INFINITY, greatest = -INFINITY;
    for (const uint32_t v : cornersOf(t)) least = std::min(least, placeOf(mesh, v)[2]), greatest = std::max(greatest, placeOf(mesh, v)[2]);
    reaches.push_back(band.reaches(least, greatest));
    for (const uint32_t v : cornersOf(t)) {
      if (reaches[t]) within.insert(placeOf(mesh, v));
      const auto [at, isNew] = lowest.insert({placeOf(mesh, v), v});
      at->second = std::min(at->second, v);
    }
  }
  std::map<uint32_t, uint32_t> vertices;  // and their numbers in the part
  for (size_t t = 0; t < mesh.triangleCount(); ++t) {
    const auto corners = cornersOf(t);
    if (std::none_of(corners.begin(), corners.end(), [&](uint32_t v) { return within.count(placeOf(mesh, v)) > 0; })) continue;
    out.part.triangles.push_back(uint32_t(t));
    out.part.corners.insert(out.part.corners.end(), corners.begin(), corners.end());
    out.isWithin.push_back(reaches[t]);
    for (const uint32_t v : corners) vertices[v] = 0;
  }
  for (auto& [v, number] : vertices) {
    const Place place = placeOf(mesh, v);
    number = uint32_t(out.part.vertices.size());
    out.part.vertices.push_back(v);
    out.part.positions.insert(out.part.positions.end(), place.begin(), place.end());
    out.isComplete.push_back(within.count(place) > 0);
    out.lowest.push_back(lowest[place]);
  }
  for (uint32_t& corner : out.part.corners) corner = vertices[corner];
  return out;
}

/// A ball of separate triangles, whose vertices share positions, after vertices that no triangle has at the positions of others.
Mesh looseBall() {
  const Mesh ball = shapes::icosphere({0, 0, 0}, 1, 2);
  Mesh loose;
  loose.positions.assign(ball.positions.begin(), ball.positions.begin() + 60);
  for (const uint32_t v : ball.triangles) {
    loose.triangles.push_back(uint32_t(loose.vertexCount()));
    const Place place = placeOf(ball, v);
    loose.positions.insert(loose.positions.end(), place.begin(), place.end());
  }
  return loose;
}

}  // namespace

TEST_CASE("A band reads of a mesh what lies within it, what is at the vertices of that, and which ids are the lowest there", "[mesh]") {
  const Mesh ball = shapes::icosphere({0, 0, 0}, 1, 2);
  const double plane = ball.positions[3 * 30 + 2];  // through a vertex
  const Band bands[] = {{-INFINITY, plane}, {plane, plane + 0.1},  {plane + 0.1, 0.9},
                        {0.9, INFINITY},    {-INFINITY, INFINITY}, {INFINITY, -INFINITY}};
  for (const Mesh& mesh : {ball, looseBall(), shapes::merged({ball, looseBall()}), shapes::icosphere({0, 0, 0}, 1, 6)}) {
    for (const Band& band : bands) {
      CAPTURE(mesh.triangleCount(), band.low, band.high);
      const BandTriangles read = readBand(ArraySource(std::make_shared<const Mesh>(mesh)), Scale(0), band), expected = bandOf(mesh, band);
      CHECK(read.part.triangles == expected.part.triangles);
      CHECK(read.part.corners == expected.part.corners);
      CHECK(read.part.vertices == expected.part.vertices);
      CHECK(read.part.positions == expected.part.positions);
      CHECK(read.isWithin == expected.isWithin);
      CHECK(read.isComplete == expected.isComplete);
      CHECK(read.lowest == expected.lowest);
    }
  }
}

TEST_CASE("Parts of a mesh know their vertices and triangles by the ids of the whole, and say which they lack", "[mesh]") {
  const Mesh ball = shapes::icosphere({0, 0, 0}, 1, 3);
  const auto count = uint32_t(ball.triangleCount());
  for (const auto& triangles : {std::vector<uint32_t>{count - 1, 3, 7, 3}, std::vector<uint32_t>{count - 1}, std::vector<uint32_t>{}}) {
    CAPTURE(triangles);
    const MeshPart part = takePart(NamedMesh(ball), triangles, {5, 5});
    const NamedMesh whole(ball), named(part);
    for (const uint32_t t : triangles) {
      for (size_t i = 0; i < 3; ++i) {
        CHECK(named.cornerId(t, i) == whole.cornerId(t, i));
        CHECK(std::equal(named.corner(t, i), named.corner(t, i) + 3, whole.corner(t, i)));
      }
    }
    CHECK(std::equal(named.vertex(5), named.vertex(5) + 3, whole.vertex(5)));
    CHECK_THROWS_AS(named.cornerId(4, 0), Failure);
    CHECK_THROWS_AS(named.corner(count, 0), Failure);
    CHECK_THROWS_AS(named.vertex(1u << 31), Failure);
  }
}

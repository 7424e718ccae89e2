// How the validator compares faces and edges where many share a vertex.
#include "operators/validate/hubs.h"

#include <cmath>
#include <optional>
#include <set>

#include "catch.h"
#include "checked_cut.h"
#include "operators/validate/grid_cell_checks.h"
#include "shapes.h"

using namespace mandoline;
using namespace mandoline::validation;

namespace {

/// A closed cone with as many sides in one grid cell, whose apex and base fan are hubs.
Mesh cone(int sides) {
  std::vector<std::array<double, 2>> base;
  Mesh mesh{{1.5, 1.5, 1.875, 1.5, 1.5, 1.125}, {}};
  for (int i = 0; i < sides; ++i) {
    const double angle = 2 * 3.14159265358979 * i / sides;
    for (const double x : {1.5 + 0.375 * std::cos(angle), 1.5 + 0.375 * std::sin(angle), 1.25 + 0.0625 * (i % 2)})
      mesh.positions.push_back(x);
    const uint32_t a = uint32_t(2 + i), b = uint32_t(2 + (i + 1) % sides);
    mesh.triangles.insert(mesh.triangles.end(), {0, a, b, 1, b, a});
  }
  return mesh;
}

/// The one grid cell that a mesh is in.
struct Looked {
  explicit Looked(const Mesh& mesh_, Intersections intersections = Intersections::resolve) : mesh(mesh_) {
    CutOptions options;
    options.intersections = intersections;
    cutMesh = cut(mesh, unitGrid(3), options).mesh;
    REQUIRE(cutMesh.cellCount() > 0);
    context.emplace(view, cutMesh);
    cell.emplace(*context);
    cell->gather(0);
    EdgeCheck check;
    edges = check.run(*cell).edges;
    hubs.find(*cell, edges);
  }

  Mesh mesh;
  MeshView view{mesh};
  CutMesh cutMesh;
  std::optional<Context> context;
  std::optional<GridCell> cell;
  std::vector<Edge> edges;
  Hubs hubs;
};

}  // namespace

TEST_CASE("hubs: vertices that many faces share, with all that is there", "[validate]") {
  const Looked looked(cone(40));
  REQUIRE(looked.hubs.all().size() == 2);
  for (const Hubs::Hub& hub : looked.hubs.all()) {
    CHECK(hub.faces.size() == 40);
    CHECK(hub.edges.size() == 40);
    CHECK(looked.hubs.at(hub.vertex) == &hub);
    for (const auto& [vertex, e] : hub.edges) CHECK((looked.edges[e][0] == hub.vertex || looked.edges[e][1] == hub.vertex));
  }
  CHECK(Looked(cone(20)).hubs.all().empty());
}

TEST_CASE("hubs: a tree finds boxes that overlap, except those that share a hub", "[validate]") {
  const Looked looked(cone(40));
  const GridCell& cell = *looked.cell;
  HubTree tree;
  size_t triFaces = 0;
  for (uint32_t f = 0; f < cell.faces.size(); ++f) {
    if (cell.context.cut.faceTriangle[cell.faces[f].id] < 0) continue;
    tree.add({boxOf(cell.faces[f].low, cell.faces[f].high), f});
    ++triFaces;
  }
  tree.build(looked.hubs, [&](uint32_t f) { return cell.vertices(f); });
  const detail::Box all{{0, 0, 0}, {1, 1, 1}};
  const auto count = [&](std::span<const uint32_t> vertices) {
    std::set<uint32_t> found;
    tree.forOverlapping(all, vertices, [&](uint32_t f) { CHECK(found.insert(f).second); });
    return found.size();
  };
  const uint32_t apex = looked.hubs.all()[0].vertex, base = looked.hubs.all()[1].vertex, both[2] = {apex, base};
  CHECK(count({}) == triFaces);
  CHECK(count({&apex, 1}) == triFaces / 2);
  CHECK(count({&base, 1}) == triFaces / 2);
  CHECK(count(both) == 0);
}

TEST_CASE("hubs: few of the faces at a hub lie in the direction of an edge, however many there are", "[validate]") {
  for (const int sides : {100, 1600}) {
    const Looked looked(cone(sides));
    const GridCell& cell = *looked.cell;
    const Vec3 margin = kTolerance * cell.noise;
    for (const Hubs::Hub& hub : looked.hubs.all()) {
      const Vec3 from = cell.local(looked.context->vertex(hub.vertex));
      detail::BoxTree tree;
      tree.build(hub.faces.size(), [&](size_t i) {
        const uint32_t f = hub.faces[i].item;
        const std::span<const Vec3> corners(cell.corners.data() + cell.faces[f].firstCorner, cell.vertices(f).size());
        return detail::BoxTree::Item{directionsOf(from, corners, margin), f};
      });
      size_t most = 0;
      for (const auto& [vertex, e] : hub.edges) {
        const uint32_t other = looked.edges[e][looked.edges[e][0] == hub.vertex];
        const Vec3 to = cell.local(looked.context->vertex(other));
        std::set<uint32_t> found;
        tree.forOverlapping(directionsOf(from, {&to, 1}, margin), [&](uint32_t f) { found.insert(f); });
        most = std::max(most, found.size());
        for (const auto& [here, f] : hub.faces) {  // those that have the edge
          const auto vertices = cell.vertices(f);
          if (std::find(vertices.begin(), vertices.end(), other) != vertices.end()) CHECK(found.count(f) == 1);
        }
      }
      CHECK(most <= 8);
    }
  }
}

TEST_CASE("hubs: the directions of points hold those of all between them", "[validate]") {
  Random random(5);
  const auto point = [&] { return Vec3{{random.between(-1, 1), random.between(-1, 1), random.between(-1, 1)}}; };
  for (int i = 0; i < 2000; ++i) {
    const Vec3 from = point(), corners[3] = {point(), point(), point()};
    const detail::Box box = directionsOf(from, corners, {});
    const double a = random.between(0, 1), b = random.between(0, 1 - a), far = random.between(0.01, 2);
    const Vec3 between = from + far * (a * (corners[0] - from) + b * (corners[1] - from) + (1 - a - b) * (corners[2] - from));
    const detail::Box inside = directionsOf(from, {&between, 1}, {{1e-15, 1e-15, 1e-15}});
    CHECK(box.overlaps(inside));
  }
  const Vec3 from, line[2] = {{{1, 0, 0}}, {{-1, 0, 0}}};  // through the point: any direction
  CHECK(directionsOf(from, line, {}).low[1] == -INFINITY);
  CHECK(directionsOf(from, {&from, 1}, {}).high[0] == INFINITY);
}

TEST_CASE("hubs: faces that cross or lie on others at a hub are found", "[validate]") {
  const auto crossings = [](const Mesh& mesh) {
    const Looked looked(mesh, Intersections::assumeNone);
    CrossingCheck check;
    CellSpots spots;
    spots.start(*looked.cell);
    check.run(*looked.cell, looked.edges, spots);
    return check.crossings().pass;
  };
  const auto withTriangle = [](const std::array<double, 3>& b, const std::array<double, 3>& c) {
    Mesh mesh = cone(40);
    const uint32_t first = uint32_t(mesh.vertexCount());
    for (const auto& p : {b, c}) mesh.positions.insert(mesh.positions.end(), p.begin(), p.end());
    mesh.triangles.insert(mesh.triangles.end(), {0, first, first + 1});
    return mesh;
  };
  CHECK(crossings(cone(40)));
  CHECK(crossings(withTriangle({1.5, 1.5, 1.5}, {1.53125, 1.5, 1.5})));
  CHECK_FALSE(crossings(withTriangle({1.5, 1.5, 1.5}, {1.9375, 1.5, 1.25})));  // through the sides
  // Two triangles at the apex: an edge of the second one stays behind the first one, or lies in it.
  const auto withTwo = [&](double z) {
    Mesh mesh = withTriangle({1.625, 1.5, 1.5}, {1.5, 1.625, 1.5});
    mesh.positions.insert(mesh.positions.end(), {1.53125, 1.53125, z, 1.5, 1.5, 1.625});
    mesh.triangles.insert(mesh.triangles.end(), {0, 44, 45});
    return mesh;
  };
  CHECK(crossings(withTwo(1.625)));
  CHECK_FALSE(crossings(withTwo(1.6875)));
}

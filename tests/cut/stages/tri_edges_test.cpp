#include <cmath>

#include "catch.h"
#include "staged_cut.h"

using namespace stages;

namespace {

/// Slabs of the crossings of the edge between two tri-vertices, from its lower end on.
std::vector<Slab> crossingsOf(const Surface& surface, VertexId low, VertexId high) {
  std::vector<Slab> slabs;
  for (const TriEdgeId e : surface.edges().ends.ids()) {
    if (surface.edges().ends[e] != std::array<VertexId, 2>{low, high}) continue;
    for (const VertexId v : surface.vertices.crossings(e)) {
      if (surface.vertices.isUsed(v)) slabs.push_back(surface.vertices.slab(v));
    }
  }
  return slabs;
}

}  // namespace

TEST_CASE("Crossings of a tri-edge come in order from its lower end", "[stages][triEdges]") {
  const StagedCut cut(shapes::triangle({2.5, 0.5, 0.5}, {0.5, 0.75, 0.5}, {0.5, 0.25, 0.75}), Stage::triEdges);
  CHECK(cut.state.surface.edges().ends.size() == 3);
  CHECK(crossingsOf(cut.state.surface, {0}, {1}) == std::vector<Slab>{{4, 1, 1}, {2, 1, 1}});
  CHECK(crossingsOf(cut.state.surface, {1}, {2}).empty());
}

TEST_CASE("A crossing of three planes at one point is one vertex", "[stages][triEdges]") {
  const StagedCut cut(shapes::triangle({0.5, 0.5, 0.5}, {1.5, 1.5, 1.5}, {0.5, 0.5, 0.75}), Stage::triEdges);
  CHECK(crossingsOf(cut.state.surface, {0}, {1}) == std::vector<Slab>{{2, 2, 2}});
}

TEST_CASE("Crossings closer than rounding keep their exact order", "[stages][triEdges]") {
  // The edge passes the grid line x = y = 1 at a distance of one unit in the last place.
  const double off = std::nextafter(0.5, 1);
  const StagedCut cut(shapes::triangle({0.5, off, 0.5}, {1.5, 1.5, 0.5}, {0.5, 0.5, 0.75}), Stage::triEdges);
  CHECK(crossingsOf(cut.state.surface, {0}, {1}) == std::vector<Slab>{{1, 2, 1}, {2, 3, 1}});
}

TEST_CASE("Triangles share an edge, and duplicates are dropped", "[stages][triEdges]") {
  const Mesh mesh{{0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0, 1}, {0, 1, 2, 1, 0, 3, 2, 0, 1, 0, 2, 1}};
  const StagedCut cut(mesh, Stage::triEdges);
  CHECK(cut.state.surface.edges().ends.size() == 5);
  CHECK(cut.prepared->duplicates.size() == 2);
  CHECK(cut.prepared->kept(size_t(0)));
  CHECK(cut.prepared->states[2] == TriangleState::duplicate);
  CHECK(cut.prepared->states[3] == TriangleState::duplicate);
}

TEST_CASE("Edges in a grid-face are cut at its sides", "[stages][triEdges]") {
  const StagedCut cut(shapes::triangle({0.5, 0.5, 1}, {1.5, 0.5, 1}, {0.75, 0.5, 1.5}), Stage::triEdges);
  const std::vector<FaceEdge>& inPlane = cut.state.surface.edgesInPlane;
  REQUIRE(inPlane.size() == 2);
  CHECK(inPlane[0].element == Slab{1, 1, 2});
  CHECK(inPlane[1].element == Slab{3, 1, 2});
  CHECK(inPlane[0].to == inPlane[1].from);
}

TEST_CASE("Duplicates are found among more triangles at a corner than a word has bits", "[stages][triEdges]") {
  // Numbers of pairs of triangles collide there. The first vertex is the lowest of all triangles.
  constexpr uint32_t kCount = 300;
  Mesh mesh{{1.5, 1.5, 2}, {}};
  for (uint32_t i = 0; i < kCount; ++i) {
    const double angle = 2 * M_PI * i / kCount;
    mesh.positions.insert(mesh.positions.end(), {1.5 + std::cos(angle), 1.5 + std::sin(angle), 1.5});
    mesh.triangles.insert(mesh.triangles.end(), {0, 1 + i, 1 + (i + 1) % kCount});
  }
  CHECK(StagedCut(mesh, Stage::triEdges).prepared->duplicates.empty());
  std::vector<Duplicate> expected;
  for (uint32_t i = 0; i < kCount; i += 7) {
    const bool sameWay = i % 2 == 0;
    const uint32_t v = 1 + i, w = 1 + (i + 1) % kCount;
    expected.push_back({i, uint32_t(mesh.triangleCount()), sameWay});
    mesh.triangles.insert(mesh.triangles.end(), {sameWay ? v : w, sameWay ? w : v, 0});
  }
  const StagedCut cut(mesh, Stage::triEdges);
  CHECK(cut.prepared->duplicates == expected);
}

TEST_CASE("Triangles are unpaired alike whether that was noted with the edges or is counted", "[stages][triEdges]") {
  Mesh open = shapes::cube(0.25, 2.75), fin = open;
  open.triangles.resize(open.triangles.size() - 3);
  fin.positions.insert(fin.positions.end(), {1.5, 2.9, 2.9});
  fin.triangles.insert(fin.triangles.end(), {fin.triangles[0], fin.triangles[1], uint32_t(fin.vertexCount() - 1)});
  const std::tuple<const char*, Mesh, size_t> cases[] = {{"closed", shapes::cube(0.25, 2.75), 0},
                                                         {"alone", shapes::triangle({0.5, 0.5, 0.5}, {2.5, 0.5, 0.5}, {0.5, 2.5, 0.75}), 1},
                                                         {"around a hole", open, 3},
                                                         {"at a fin", fin, 3},  // the fin, too
                                                         {"where triangles meet", shapes::merged({open, shapes::cube(1.25, 2.875)}), 3}};
  for (const auto& [name, mesh, count] : cases) {
    CAPTURE(name);
    const StagedCut noted(mesh, Stage::triEdges);
    StagedCut counted(mesh, Stage::input);
    MeshEdges& edges = const_cast<MeshEdges&>(counted.prepared->edges);  // prepareMesh() has made them as variables
    REQUIRE(edges.unpaired);
    edges.unpaired.reset();
    cutTriEdges(counted.state.surface, counted.run);
    IdVector<TriangleId, uint8_t> expected = noted.state.surface.unpaired;
    expected.resize(mesh.triangleCount());  // empty if none is
    CHECK(counted.state.surface.unpaired == expected);
    CHECK(size_t(std::count(expected.begin(), expected.end(), 1)) == count);
  }
}

TEST_CASE("A surface is plain if no vertex is on a plane and no edge passes a grid line, also where its crossings are known",
          "[stages][triEdges]") {
  const auto meshOf = [](const Mesh& still, Mesh other) {
    for (size_t i = 2; i < other.positions.size(); i += 3) other.positions[i] += 1;
    return shapes::merged({still, other});
  };
  const Mesh plain = shapes::triangle({0.5, 0.25, 0.5}, {1.5, 1.5, 0.625}, {0.75, 0.5, 0.75});
  const Mesh throughLine = shapes::triangle({0.5, 0.5, 0.5}, {1.5, 1.5, 0.625}, {0.75, 0.25, 0.75});
  const Mesh onPlane = shapes::triangle({0.5, 0.25, 0.5}, {1.5, 1.5, 0.625}, {0.75, 1, 0.75});
  const Moved moved({0, 0, 0, 1, 1, 1});
  for (const Mesh* still : {&plain, &throughLine, &onPlane}) {
    for (const Mesh* then : {&plain, &throughLine, &onPlane}) {
      for (const Mesh* now : {&plain, &throughLine, &onPlane}) {
        CAPTURE(still->positions, then->positions, now->positions);
        const StagedCut before(meshOf(*still, *then), Stage::triEdges);
        StagedCut after(meshOf(*still, *now), Stage::input);
        CHECK(before.state.surface.isPlain == (still == &plain && then == &plain));
        const CrossingsBefore known(before.state.surface, after.state.surface, moved);
        REQUIRE(known.pastKnown({0}, {6}).number == 3);
        cutTriEdges(after.state.surface, after.run, &known);
        CHECK(after.state.surface.isPlain == (still == &plain && now == &plain));
      }
    }
  }
}

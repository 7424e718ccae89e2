#include "catch.h"
#include "staged_cut.h"

using namespace stages;

namespace {

const Mesh kBase = shapes::triangle({1.125, 1.125, 1.5}, {1.875, 1.125, 1.5}, {1.125, 1.875, 1.5});

/// Per face of a triangle: the number of entries of each loop.
std::vector<std::vector<size_t>> loopSizes(const StagedCut& cut, TriangleId triangle) {
  const TriFaces& faces = cut.brick.triFaces;
  std::vector<std::vector<size_t>> sizes;
  for (const FaceId f : faces.ids()) {
    if (faces.triangles[f] != triangle) continue;
    sizes.emplace_back();
    for (const auto loop : faces.loopsOf(f)) sizes.back().push_back(loop.size());
  }
  return sizes;
}

using Sizes = std::vector<std::vector<size_t>>;

}  // namespace

TEST_CASE("A triangle that another crosses from side to side has two faces", "[stages][dividedFaces]") {
  const Mesh across = shapes::triangle({1.25, 1, 1.4375}, {1.25, 2, 1.4375}, {1.25, 1.5, 1.875});
  const StagedCut cut(shapes::merged({kBase, across}), Stage::triFaces);
  CHECK(loopSizes(cut, {0}) == Sizes{{4}, {3}});
}

TEST_CASE("A segment that ends inside of a triangle is a slit in its loop or a loop of its own", "[stages][dividedFaces]") {
  const Mesh fromSide = shapes::triangle({1.25, 1, 1.5}, {1.25, 1.5, 1.5}, {1.25, 1.25, 1.75});
  CHECK(loopSizes(StagedCut(shapes::merged({kBase, fromSide}), Stage::triFaces), {0}) == Sizes{{6}});
  const Mesh inside = shapes::triangle({1.25, 1.25, 1.5}, {1.25, 1.5, 1.5}, {1.25, 1.25, 1.75});
  CHECK(loopSizes(StagedCut(shapes::merged({kBase, inside}), Stage::triFaces), {0}) == Sizes{{3, 2}});
}

TEST_CASE("A triangle inside of another in its plane makes a hole and a face of both", "[stages][dividedFaces]") {
  const Mesh inner = shapes::flipped(shapes::triangle({1.25, 1.25, 1.5}, {1.5, 1.25, 1.5}, {1.25, 1.5, 1.5}));
  const StagedCut cut(shapes::merged({kBase, inner}), Stage::triFaces);
  const TriFaces& faces = cut.brick.triFaces;
  CHECK(loopSizes(cut, {0}) == Sizes{{3, 3}, {3}});
  CHECK(loopSizes(cut, {1}).empty());
  REQUIRE(faces.otherParents.size() == 1);
  CHECK(faces.otherParents[0].triangle == TriangleId{1});
  CHECK_FALSE(faces.otherParents[0].sameWay);
}

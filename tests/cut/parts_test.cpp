// Winding numbers and parity of the parts of an input that has none as a whole: one bad part blinds no other.
#include <algorithm>
#include <map>

#include "catch.h"
#include "checked_cut.h"
#include "same_bits.h"
#include "shapes.h"

using namespace mandoline;

namespace {

constexpr int kHousesAlong = 6, kHouses = 26;

/// Boxes in rows of six, two cells apart; three triangles of the one that is not the last are turned.
Mesh village(int turned) {
  std::vector<Mesh> houses;
  for (int i = 0; i < kHouses; ++i) {
    const double x = 3.0 * (i % kHousesAlong) + 0.5, y = 3.0 * (i / kHousesAlong) + 0.5;
    houses.push_back(shapes::box({x, y, 0.25}, {x + 2, y + 1.5, 1.5}));
  }
  for (const size_t t : {1, 4, 9}) std::swap(houses[size_t(turned)].triangles[3 * t], houses[size_t(turned)].triangles[3 * t + 1]);
  return shapes::merged(houses);
}

/// Volumes of the regions by regionPartWinding (0 where there is none) and regionParity.
std::map<std::pair<int, int>, double> volumesByNumbers(const CheckedCut& cut) {
  const std::vector<double> volumes = regionVolumes(cut.mesh, cut.measures);
  std::map<std::pair<int, int>, double> sums;
  for (size_t r = 0; r < volumes.size(); ++r) {
    const auto at = [&](const auto& array) { return array.empty() ? 0 : int(array[r]); };
    sums[{at(cut.mesh.regionPartWinding), at(cut.mesh.regionParity)}] += volumes[r];
  }
  return sums;
}

double insideVolume(const CheckedCut& cut, WindingRule rule) {
  const std::vector<double> volumes = regionVolumes(cut.mesh, cut.measures);
  const InsideRegions inside = insideRegions(cut.mesh, {rule});
  double sum = 0;
  for (size_t r = 0; r < volumes.size(); ++r) sum += inside.isInside[r] ? volumes[r] : 0;
  return sum;
}

template <class Call>
std::string messageOf(const Call& call) {
  try {
    call();
  } catch (const CallError& error) {
    return error.error.message;
  }
  return "";
}

Mesh without(Mesh mesh, size_t triangle) {
  mesh.triangles.erase(mesh.triangles.begin() + 3 * std::ptrdiff_t(triangle), mesh.triangles.begin() + 3 * std::ptrdiff_t(triangle) + 3);
  return mesh;
}

/// The unit square of a cube's side at x = 2, divided at a vertex that the triangles beside it don't have.
Mesh cubeWithTJunction() {
  Mesh mesh = shapes::cube(1, 2);
  // Replaces the triangles in the plane x = 2 by three that meet at (2, 1.5, 1), on the edge from (2, 1, 1) to (2, 2, 1).
  std::vector<uint32_t> kept;
  for (size_t t = 0; t < mesh.triangleCount(); ++t) {
    bool isInPlane = true;
    for (int i = 0; i < 3; ++i) isInPlane &= mesh.positions[3 * mesh.triangles[3 * t + size_t(i)]] == 2;
    if (!isInPlane)
      kept.insert(kept.end(), mesh.triangles.begin() + 3 * std::ptrdiff_t(t), mesh.triangles.begin() + 3 * std::ptrdiff_t(t) + 3);
  }
  mesh.triangles = kept;
  return shapes::merged({mesh, shapes::triangle({2, 1, 1}, {2, 1.5, 1}, {2, 1, 2}), shapes::triangle({2, 1.5, 1}, {2, 2, 2}, {2, 1, 2}),
                         shapes::triangle({2, 1.5, 1}, {2, 2, 1}, {2, 2, 2})});
}

}  // namespace

TEST_CASE("26 houses, three triangles of one turned: 25 have winding numbers, one has parity", "[parts]") {
  const Mesh mesh = village(7);
  const ResolveResult resolved = resolve(mesh);
  const CheckedCut cut = checkedCut(mesh, unitGrid(18, 15, 3));
  CHECK_FALSE(cut.mesh.hasWinding);
  const PartCounts& counts = cut.stats.parts;
  CHECK(std::array{counts.winding, counts.parity, counts.open} == std::array{25u, 1u, 0u});
  CHECK(counts.openEdges == 0);
  CHECK(cut.mesh.parityTriangles.size() == 12);
  CHECK(cut.mesh.parityTriangles.front() == 7 * 12);
  CHECK(cut.mesh.openTriangles.empty());
  const double house = 2 * 1.5 * 1.25;
  const auto volumes = volumesByNumbers(cut);
  CHECK(volumes.at({1, 1}) == Approx(25 * house));
  CHECK(volumes.at({0, 1}) == Approx(house));
  for (const WindingRule rule : {WindingRule::positive, WindingRule::nonZero, WindingRule::odd}) {
    CHECK(insideVolume(cut, rule) == Approx(26 * house));
    CHECK(shapes::signedVolume(boundary(cut.mesh, rule)) == Approx(26 * house));
    CHECK(shapes::signedVolume(boundary(resolved.mesh, rule)) == Approx(26 * house));
  }
  const InsideRegions inside = insideRegions(cut.mesh);
  CHECK(inside.by == InsideBy::parity);
  CHECK(inside.isComplete);
}

TEST_CASE("A house without a triangle is left out, and the others have winding numbers", "[parts]") {
  const CheckedCut cut = checkedCut(without(village(25), 0), unitGrid(18, 15, 3));
  const PartCounts& counts = cut.stats.parts;
  CHECK(std::array{counts.winding, counts.parity, counts.open} == std::array{24u, 1u, 1u});
  CHECK(std::array{counts.openEdges, counts.holes} == std::array{3u, 1u});
  CHECK(cut.mesh.openTriangles == std::vector<uint32_t>{0, 1, 2, 3, 4, 5, 6, 7, 8, 9, 10});
  CHECK(insideVolume(cut, WindingRule::positive) == Approx(25 * 2 * 1.5 * 1.25));
  const InsideRegions inside = insideRegions(cut.mesh);
  CHECK(inside.by == InsideBy::parity);
  CHECK_FALSE(inside.isComplete);
}

TEST_CASE("Two cubes that share an edge, one of them open: the other has winding numbers", "[parts]") {
  const Mesh first = shapes::cube(1, 2), second = shapes::box({2, 2, 1}, {3, 3, 2});
  for (size_t missing = 0; missing < 12; ++missing) {  // some of them at the shared edge
    const CheckedCut cut = checkedCut(shapes::merged({first, without(second, missing)}), unitGrid(4));
    const PartCounts& counts = cut.stats.parts;
    CHECK(std::array{counts.winding, counts.parity, counts.open} == std::array{1u, 0u, 1u});
    CHECK(volumesByNumbers(cut).at({1, 1}) == Approx(1));
  }
}

TEST_CASE("A triangle that lies twice in a cube's surface does not open it", "[parts]") {
  for (const bool sameWay : {true, false}) {
    Mesh mesh = shapes::cube(1, 2);
    for (const size_t i : {0, sameWay ? 1 : 2, sameWay ? 2 : 1}) mesh.triangles.push_back(mesh.triangles[15 + i]);
    for (const bool first : {false, true}) {
      if (first) std::rotate(mesh.triangles.begin(), mesh.triangles.end() - 3, mesh.triangles.end());
      const CheckedCut cut = checkedCut(mesh, unitGrid(3));
      CHECK_FALSE(cut.mesh.hasWinding);
      CHECK(std::array{cut.stats.parts.winding, cut.stats.parts.open} == std::array{1u, 1u});
      CHECK(cut.mesh.openTriangles.size() == 1);
      CHECK(volumesByNumbers(cut).at({1, 1}) == Approx(1));
    }
  }
}

TEST_CASE("Two cubes with a side in common have winding numbers beside an open sheet", "[parts]") {
  const Mesh sheet = shapes::quad({5, 5, 5}, {6, 5, 5}, {6, 6, 5}, {5, 6, 5});
  const Mesh cubes = shapes::merged({shapes::cube(1, 2), shapes::translated(shapes::cube(1, 2), {1, 0, 0})});
  CHECK(volumesByNumbers(checkedCut(shapes::merged({cubes, sheet}), unitGrid(7))).at({1, 1}) == Approx(2));
}

TEST_CASE("T-junctions close a surface", "[parts]") {
  const Mesh mesh = cubeWithTJunction();
  const CheckedCut cut = checkedCut(mesh, unitGrid(3));
  CHECK_FALSE(cut.mesh.hasWinding);  // its own edges don't cancel
  CHECK(std::array{cut.stats.parts.winding, cut.stats.parts.open} == std::array{1u, 0u});
  CHECK(volumesByNumbers(cut).at({1, 1}) == Approx(1));
  const InsideRegions inside = insideRegions(cut.mesh);
  CHECK(inside.by == InsideBy::winding);
  CHECK(inside.isComplete);
}

TEST_CASE("A sheet through a closed box does not blind it", "[parts]") {
  const Mesh sheet = shapes::quad({0.25, 0.25, 1.25}, {2.75, 0.25, 1.5}, {2.75, 2.75, 1.75}, {0.25, 2.75, 1.5});
  const CheckedCut cut = checkedCut(shapes::merged({sheet, shapes::cube(0.5, 2.5)}), unitGrid(3));
  CHECK(std::array{cut.stats.parts.winding, cut.stats.parts.open} == std::array{1u, 1u});
  CHECK(std::array{cut.stats.parts.openEdges, cut.stats.parts.holes} == std::array{4u, 1u});
  CHECK(cut.mesh.openTriangles == std::vector<uint32_t>{0, 1});
  CHECK(volumesByNumbers(cut).at({1, 1}) == Approx(8));
}

TEST_CASE("A sheet that ends at a box's edges does not blind it", "[parts]") {
  const Mesh fin = shapes::quad({2, 1, 1}, {3, 1, 1}, {3, 2, 1}, {2, 2, 1});
  const CheckedCut cut = checkedCut(shapes::merged({shapes::cube(1, 2), fin}), unitGrid(4));
  CHECK(std::array{cut.stats.parts.winding, cut.stats.parts.open} == std::array{1u, 1u});
  CHECK(volumesByNumbers(cut).at({1, 1}) == Approx(1));
}

TEST_CASE("Where three walls meet all around, nobody can tell which two are a solid's", "[parts]") {
  const Mesh wall = shapes::quad({1, 1, 1}, {2, 2, 1}, {2, 2, 2}, {1, 1, 2});  // between corners of the cube, along diagonals of two sides
  const CheckedCut cut = checkedCut(shapes::merged({shapes::cube(1, 2), wall}), unitGrid(3));
  CHECK(cut.stats.parts.open > 0);
}

TEST_CASE("A closed surface whose triangles are turned at random has parity", "[parts]") {
  Mesh mesh = shapes::merged({shapes::icosphere({2, 2, 2}, 1.5, 2), shapes::icosphere({2, 2, 2}, 0.75, 2)});
  for (size_t t = 0; t < mesh.triangleCount(); ++t) {
    if (t * 7 % 3 == 0) std::swap(mesh.triangles[3 * t], mesh.triangles[3 * t + 1]);
  }
  const CheckedCut cut = checkedCut(mesh, unitGrid(4));
  CHECK(std::array{cut.stats.parts.winding, cut.stats.parts.parity, cut.stats.parts.open} == std::array{0u, 2u, 0u});
  CHECK(cut.mesh.regionPartWinding.empty());
  const Mesh outer = shapes::icosphere({2, 2, 2}, 1.5, 2), inner = shapes::icosphere({2, 2, 2}, 0.75, 2);
  CHECK(insideVolume(cut, WindingRule::odd) == Approx(shapes::signedVolume(outer) - shapes::signedVolume(inner)));
}

TEST_CASE("An open surface alone has no inside, and says what to do", "[parts]") {
  const Mesh mesh = without(shapes::cube(0.5, 2.5), 0);
  const CheckedCut cut = checkedCut(mesh, unitGrid(3));
  CHECK(cut.mesh.regionParity.empty());
  CHECK(cut.mesh.openTriangles.size() == 11);
  CHECK(messageOf([&] { boundary(cut.mesh); }).find("estimateInside()") != std::string::npos);
  CHECK(messageOf([&] { boundary(resolve(mesh).mesh); }).find("estimateInside()") != std::string::npos);
}

TEST_CASE("Parts are the same for triangles in any order and any number of threads", "[parts]") {
  const Mesh mesh =
      shapes::merged({village(3), shapes::translated(without(shapes::cube(0.25, 1.75), 5), {0.1, 0.2, 0.3}), cubeWithTJunction()});
  const CheckedCut cut = checkedCut(mesh, unitGrid(18, 15, 3));
  CutOptions threads;
  threads.threads = 3;
  CHECK(differences(cut.mesh, checkedCut(mesh, unitGrid(18, 15, 3), threads).mesh).empty());
  for (const unsigned seed : {1u, 2u, 3u}) {
    std::vector<uint32_t> newTriangle;
    const CheckedCut other = checkedCut(shapes::shuffled(mesh, seed, newTriangle), unitGrid(18, 15, 3));
    for (const auto& [numbers, volume] : volumesByNumbers(cut)) CHECK(volumesByNumbers(other)[numbers] == Approx(volume));
    std::vector<uint32_t> open;
    for (const uint32_t t : cut.mesh.openTriangles) open.push_back(newTriangle[t]);
    std::sort(open.begin(), open.end());
    CHECK(other.mesh.openTriangles == open);
    const PartCounts &a = cut.stats.parts, &b = other.stats.parts;
    CHECK(std::array{a.winding, a.parity, a.open, a.openEdges, a.holes} == std::array{b.winding, b.parity, b.open, b.openEdges, b.holes});
  }
}

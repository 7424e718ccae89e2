// Octree cells in place of untouched grid cells, against an octree that divides its blocks until nothing is left to divide.
#include "mandoline/coarsen.h"

#include <set>

#include "case_list.h"
#include "catch.h"
#include "checked_cut.h"
#include "shapes.h"

using namespace mandoline;

namespace {

struct Leaf {
  std::array<int32_t, 3> corner;
  int level;
  bool operator==(const Leaf&) const = default;
  bool operator<(const Leaf& other) const { return corner != other.corner ? corner < other.corner : level < other.level; }
};

/// Octree cells by their definition, with a level per grid cell.
class Reference {
 public:
  Reference(const CutMesh& mesh, const CoarsenOptions& options) : mesh_(mesh), options_(options) {
    for (int d = 0; d < 3; ++d) n_[size_t(d)] = mesh.grid.cells(d);
    int top = 0;
    while (top < options.maxLevel && (int64_t(1) << top) < std::max({n_[0], n_[1], n_[2]})) ++top;
    levels_.assign(size_t(n_[0] * n_[1] * n_[2]), top);
    while (divideSome()) {
    }
  }

  std::set<Leaf> leaves() const {
    std::set<Leaf> leaves;
    forEachCell([&](int64_t i, int64_t j, int64_t k) {
      if (!isCut(i, j, k)) leaves.insert({blockOf({i, j, k}), level(i, j, k)});
    });
    return leaves;
  }

 private:
  template <class F>
  void forEachCell(const F& f) const {
    for (int64_t k = 0; k < n_[2]; ++k) {
      for (int64_t j = 0; j < n_[1]; ++j) {
        for (int64_t i = 0; i < n_[0]; ++i) f(i, j, k);
      }
    }
  }
  bool isCut(int64_t i, int64_t j, int64_t k) const { return mesh_.cutCellsAt(i, j, k).size() > 0; }
  int level(int64_t i, int64_t j, int64_t k) const { return levels_[size_t(i + n_[0] * (j + n_[1] * k))]; }
  std::array<int32_t, 3> blockOf(const std::array<int64_t, 3>& cell) const {
    const int l = level(cell[0], cell[1], cell[2]);
    return {int32_t(cell[0] >> l << l), int32_t(cell[1] >> l << l), int32_t(cell[2] >> l << l)};
  }

  /// Whether a grid cell's block must be smaller.
  bool isTooLarge(int64_t i, int64_t j, int64_t k) const {
    const int own = level(i, j, k);
    if (own == 0) return false;
    const int reach = options_.fineLayers;
    for (int64_t z = k - reach; z <= k + reach; ++z) {
      for (int64_t y = j - reach; y <= j + reach; ++y) {
        for (int64_t x = i - reach; x <= i + reach; ++x) {
          if (isCut(x, y, z)) return true;
        }
      }
    }
    if (own > 1 && hasSmallerNear({i, j, k}, own - 1)) return true;
    for (int dz = -1; dz <= 1; ++dz) {
      for (int dy = -1; dy <= 1; ++dy) {
        for (int dx = -1; dx <= 1; ++dx) {
          const int steps = std::abs(dx) + std::abs(dy) + std::abs(dz);
          if (steps < 1 || steps > (options_.balanceEdges ? 2 : 1)) continue;
          const int64_t x = i + dx, y = j + dy, z = k + dz;
          if (x < 0 || y < 0 || z < 0 || x >= n_[0] || y >= n_[1] || z >= n_[2]) continue;
          if (level(x, y, z) + 1 < own) return true;
        }
      }
    }
    return false;
  }

  /// Whether a grid cell below a level lies in the layers of blocks of this level around that of a cell.
  bool hasSmallerNear(const std::array<int64_t, 3>& cell, int at) const {
    std::array<int64_t, 3> first{}, past{};
    const int layers = at == 1 && options_.layersPerLevel > 2 ? std::max(2, options_.layersPerLevel / 4) : options_.layersPerLevel;
    for (size_t d = 0; d < 3; ++d) {
      first[d] = std::max<int64_t>(0, ((cell[d] >> at) - layers) << at);
      past[d] = std::min(n_[d], ((cell[d] >> at) + layers + 1) << at);
    }
    for (int64_t z = first[2]; z < past[2]; ++z) {
      for (int64_t y = first[1]; y < past[1]; ++y) {
        for (int64_t x = first[0]; x < past[0]; ++x) {
          if (level(x, y, z) < at) return true;
        }
      }
    }
    return false;
  }

  bool divideSome() {
    std::set<Leaf> tooLarge;
    forEachCell([&](int64_t i, int64_t j, int64_t k) {
      if (isTooLarge(i, j, k)) tooLarge.insert({blockOf({i, j, k}), level(i, j, k)});
    });
    forEachCell([&](int64_t i, int64_t j, int64_t k) {
      if (tooLarge.count({blockOf({i, j, k}), level(i, j, k)})) --levels_[size_t(i + n_[0] * (j + n_[1] * k))];
    });
    return !tooLarge.empty();
  }

  const CutMesh& mesh_;
  CoarsenOptions options_;
  std::array<int64_t, 3> n_{};
  std::vector<int> levels_;
};

std::set<Leaf> leavesOf(const OctreeCells& cells) {
  std::set<Leaf> leaves;
  for (size_t c = 0; c < cells.cellCount(); ++c) leaves.insert({cells.corner(c), cells.cellLevel[c]});
  return leaves;
}

/// Every grid cell lies in one cut cell or in one octree cell, which is of its region and is found.
void requireTiling(const CutMesh& mesh, const OctreeCells& cells) {
  std::vector<int32_t> regions = mesh.gridCellRegion();
  std::vector<uint8_t> covered(regions.size());
  const int64_t nx = mesh.grid.cells(0), ny = mesh.grid.cells(1);
  for (size_t c = 0; c < cells.cellCount(); ++c) {
    const auto corner = cells.corner(c), end = cells.end(c);
    for (int64_t k = corner[2]; k < end[2]; ++k) {
      for (int64_t j = corner[1]; j < end[1]; ++j) {
        for (int64_t i = corner[0]; i < end[0]; ++i) {
          const size_t at = size_t(i + nx * (j + ny * k));
          REQUIRE(++covered[at] == 1);
          REQUIRE(regions[at] == int32_t(cells.cellRegion[c]));
          REQUIRE(cells.find(i, j, k) == int64_t(c));
        }
      }
    }
  }
  for (int64_t at = 0; at < int64_t(regions.size()); ++at) {
    if (covered[size_t(at)]) continue;
    REQUIRE(regions[size_t(at)] == -1);
    REQUIRE(cells.find(at % nx, at / nx % ny, at / nx / ny) == -1);
  }
}

CutMesh cutOf(const Mesh& mesh, const Grid& grid) {
  CutResult result = cut(mesh, grid);
  REQUIRE(result);
  return std::move(result.mesh);
}

}  // namespace

TEST_CASE("coarsen: the fewest balanced cells, on all cases", "[coarsen]") {
  for (const NamedCase& c : caseList()) {
    CAPTURE(c.name);
    const CutMesh mesh = cutOf(c.mesh, c.grid);
    for (const auto& [maxLevel, fineLayers, layersPerLevel, balanceEdges] :
         {std::tuple(24, 0, 0, false), std::tuple(24, 0, 0, true), std::tuple(2, 1, 0, false), std::tuple(24, 2, 0, true),
          std::tuple(0, 0, 0, false), std::tuple(24, 0, 1, false), std::tuple(24, 1, 2, true), std::tuple(24, 0, 3, false),
          std::tuple(24, 0, 5, false)}) {
      CAPTURE(maxLevel, fineLayers, layersPerLevel, balanceEdges);
      CoarsenOptions options;
      options.maxLevel = maxLevel, options.fineLayers = fineLayers;
      options.layersPerLevel = layersPerLevel, options.balanceEdges = balanceEdges;
      const OctreeCells cells = coarsen(mesh, options);
      requireTiling(mesh, cells);
      REQUIRE(leavesOf(cells) == Reference(mesh, options).leaves());
    }
  }
}

TEST_CASE("coarsen: any counts of grid cells", "[coarsen]") {
  const Mesh ball = shapes::icosphere({9, 5, 4}, 2.2, 2);
  for (const auto& [nx, ny, nz] : {std::tuple(33, 10, 7), std::tuple(16, 16, 16), std::tuple(17, 9, 32)}) {
    const CutMesh mesh = cutOf(ball, unitGrid(nx, ny, nz));
    for (const auto& [layersPerLevel, balanceEdges] : {std::pair(0, false), std::pair(0, true), std::pair(2, false)}) {
      CoarsenOptions options;
      options.layersPerLevel = layersPerLevel, options.balanceEdges = balanceEdges;
      const OctreeCells cells = coarsen(mesh, options);
      requireTiling(mesh, cells);
      REQUIRE(leavesOf(cells) == Reference(mesh, options).leaves());
    }
  }
}

TEST_CASE("coarsen: by default a fine layer, and layers of each size in proportion to the grid cells", "[coarsen]") {
  for (const auto& [n, layers] : {std::pair(int64_t(20), 1), {64, 5}, {100, 8}}) {
    const CutMesh mesh = cutOf(shapes::icosphere({6, 5, 4}, 1.5, 2), unitGrid(12, 9, n));
    CoarsenOptions options;
    options.fineLayers = 1, options.layersPerLevel = layers;
    const OctreeCells byDefault = coarsen(mesh);
    CAPTURE(n);
    CHECK(byDefault.cellCorner == coarsen(mesh, options).cellCorner);
    CHECK(byDefault.fingerprint == coarsen(mesh, options).fingerprint);
    options.layersPerLevel = layers + 1;
    CHECK(byDefault.fingerprint != coarsen(mesh, options).fingerprint);
  }
}

TEST_CASE("coarsen: a grid without cut-cells is one cell", "[coarsen]") {
  const CutMesh mesh = cutOf(shapes::cube(100, 101), unitGrid(5, 4, 8));
  const OctreeCells cells = coarsen(mesh);
  REQUIRE(cells.cellCount() == 1);
  CHECK(cells.cellLevel[0] == 3);
  CHECK(cells.end(0) == std::array<int32_t, 3>{5, 4, 8});
}

TEST_CASE("coarsen: where every grid cell is cut there is nothing to merge", "[coarsen]") {
  const CutMesh mesh = cutOf(shapes::cube(0.25, 0.75), unitGrid(1));
  CHECK(coarsen(mesh).cellCount() == 0);
  CHECK(coarsen(mesh).find(0, 0, 0) == -1);
}

TEST_CASE("coarsen: bad options and cancelling", "[coarsen]") {
  const CutMesh mesh = cutOf(shapes::cube(1.25, 2.5), unitGrid(4));
  CoarsenOptions options;
  options.maxLevel = -1;
  REQUIRE_THROWS_AS(coarsen(mesh, options), CallError);
  options.maxLevel = 3, options.fineLayers = -1;
  REQUIRE_THROWS_AS(coarsen(mesh, options), CallError);
  options.fineLayers = 1 << 30;  // all of the grid
  CHECK(coarsen(mesh, options).cellCount() == UntouchedCells(mesh).count());
  options.fineLayers = 0, options.layersPerLevel = -2;
  REQUIRE_THROWS_AS(coarsen(mesh, options), CallError);
  options.layersPerLevel = 1 << 30;
  for (const uint8_t level : coarsen(mesh, options).cellLevel) CHECK(level <= 1);
  options.progress = [](const Progress&) { return false; };
  try {
    coarsen(mesh, options);
    FAIL("not cancelled");
  } catch (const CallError& failure) {
    CHECK(failure.error.status == Status::cancelled);
  }
  REQUIRE_THROWS_AS(coarsen(CutMesh()), CallError);
}

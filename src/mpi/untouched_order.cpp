#include "mpi/untouched_order.h"

#include <algorithm>

#include "operators/cell_complex/octree_index.h"

namespace mandoline::detail {
namespace {

/// Grid cells from the first up to, not including, the second, per axis.
struct Box {
  std::array<int64_t, 3> low, end;
};

class Orderer {
 public:
  Orderer(const CutMesh& cutMesh, const std::array<int64_t, 2>& layers) : cutMesh_(cutMesh), layers_(layers) {
    for (size_t d = 0; d < 3; ++d) n_[d] = cutMesh.grid.cells(int(d));
  }

  UntouchedOrder run() {
    for (size_t d = 0; d < 3; ++d) result_.cells.gridCells[d] = int32_t(n_[d]);
    result_.cells.madeFrom = cutMesh_.fingerprint;
    int64_t size = 1;
    while (size < *std::max_element(n_.begin(), n_.end())) size *= 2;
    visit({0, 0, 0}, size);
    return std::move(result_);
  }

 private:
  /// The block of so many grid cells on a side that begins at a corner.
  void visit(const std::array<int64_t, 3>& corner, int64_t size) {
    Box box{corner, {}};
    for (size_t d = 0; d < 3; ++d) {
      box.end[d] = std::min(corner[d] + size, n_[d]);
      if (box.low[d] >= box.end[d]) return;
    }
    if (box.end[2] <= layers_[0] || box.low[2] >= layers_[1]) return addAllIn(box);
    if (size == 1) return visitCell(box);
    for (int64_t child = 0; child < 8; ++child) {
      std::array<int64_t, 3> at = corner;
      for (size_t d = 0; d < 3; ++d) at[d] += (child >> d & 1) * (size / 2);
      visit(at, size / 2);
    }
  }

  void visitCell(const Box& box) {
    const auto [i, j, k] = box.low;
    const int64_t region = UntouchedCells(cutMesh_).regionAt(i, j, k);
    if (region < 0) return;
    for (const int64_t x : box.low) result_.cells.cellCorner.push_back(int32_t(x));
    result_.cells.cellLevel.push_back(0);
    result_.cells.cellRegion.push_back(uint32_t(region));
    result_.before.push_back(result_.all);
    addAllIn(box);
  }

  void addAllIn(const Box& box) {
    for (int64_t k = box.low[2]; k < box.end[2]; ++k) {
      for (int64_t j = box.low[1]; j < box.end[1]; ++j) {
        const size_t row = size_t(k * n_[1] + j);
        for (uint32_t r = firstRun(row, box.low[0]); r < cutMesh_.rowRunOffsets[row + 1] && cutMesh_.runBegin[r] < box.end[0]; ++r) {
          const int64_t begin = std::max<int64_t>(cutMesh_.runBegin[r], box.low[0]),
                        end = std::min<int64_t>(cutMesh_.runEnd[r], box.end[0]);
          addPiece({{begin, j, k}, {end, j + 1, k + 1}});
        }
      }
    }
  }

  /// Counts a piece of a run. Of two neighbours the lower one comes first.
  void addPiece(const Box& piece) {
    const auto [i, j, k] = piece.low;
    const int64_t end = piece.end[0];
    const uint64_t count = uint64_t(end - i);
    UntouchedCounts& all = result_.all;
    all.cells += count;
    all.faces += untouchedIn(i + 1, end + 1, j, k) + untouchedIn(i, end, j + 1, k) + untouchedIn(i, end, j, k + 1);
    const uint64_t sides = uint64_t(j == 0) + uint64_t(j + 1 == n_[1]) + uint64_t(k == 0) + uint64_t(k + 1 == n_[2]);
    all.faces += uint64_t(i == 0) + uint64_t(end == n_[0]) + count * sides;
  }

  /// How many of the grid cells (begin .. end - 1, j, k) are untouched.
  uint64_t untouchedIn(int64_t begin, int64_t end, int64_t j, int64_t k) const {
    if (j >= n_[1] || k >= n_[2]) return 0;
    const size_t row = size_t(k * n_[1] + j);
    uint64_t count = 0;
    for (uint32_t r = firstRun(row, begin); r < cutMesh_.rowRunOffsets[row + 1] && cutMesh_.runBegin[r] < end; ++r)
      count += uint64_t(std::min<int64_t>(cutMesh_.runEnd[r], end) - std::max<int64_t>(cutMesh_.runBegin[r], begin));
    return count;
  }

  /// The first run of a row that ends after x.
  uint32_t firstRun(size_t row, int64_t x) const {
    const auto first = cutMesh_.runEnd.begin() + cutMesh_.rowRunOffsets[row],
               past = cutMesh_.runEnd.begin() + cutMesh_.rowRunOffsets[row + 1];
    return uint32_t(std::upper_bound(first, past, x) - cutMesh_.runEnd.begin());
  }

  const CutMesh& cutMesh_;
  const std::array<int64_t, 2> layers_;
  std::array<int64_t, 3> n_{};
  UntouchedOrder result_;
};

/// Counts the faces of octree cells, each of which is a whole side of a cell.
class OctreeOrderer {
 public:
  explicit OctreeOrderer(const OctreeCells& whole) : whole_(whole), index_(whole) {}

  UntouchedOrder run(const std::array<int64_t, 2>& layers) {
    result_.cells.gridCells = whole_.gridCells;
    result_.cells.madeFrom = whole_.madeFrom;
    for (size_t c = 0; c < whole_.cellCount(); ++c) {
      const bool isHere = whole_.corner(c)[2] < layers[1] && whole_.end(c)[2] > layers[0];
      if (isHere) take(c);
      add(c, isHere);
    }
    return std::move(result_);
  }

 private:
  static constexpr size_t kLower = 4;  // the side along z

  void take(size_t c) {
    const std::array<int32_t, 3> corner = whole_.corner(c);
    OctreeCells& cells = result_.cells;
    cells.cellCorner.insert(cells.cellCorner.end(), corner.begin(), corner.end());
    cells.cellLevel.push_back(whole_.cellLevel[c]);
    cells.cellRegion.push_back(whole_.cellRegion[c]);
    result_.before.push_back(result_.all);
    result_.hasLower.push_back(0);
  }

  void add(size_t c, bool isHere) {
    ++result_.all.cells;
    for (size_t side = 0; side < 6; ++side) {
      if (!index_.acrossSide(c, side / 2, int(side % 2))) continue;
      ++result_.all.faces;
      if (isHere && side == kLower) result_.hasLower.back() = 1;
    }
  }

  const OctreeCells& whole_;
  const operators::OctreeIndex index_;
  UntouchedOrder result_;
};

}  // namespace

UntouchedOrder untouchedOrder(const CutMesh& cutMesh, const std::array<int64_t, 2>& layers) { return Orderer(cutMesh, layers).run(); }

UntouchedOrder octreeOrder(const OctreeCells& whole, const std::array<int64_t, 2>& layers) { return OctreeOrderer(whole).run(layers); }

}  // namespace mandoline::detail

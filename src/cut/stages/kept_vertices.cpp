#include "cut/stages/kept_vertices.h"

#include "base/csr.h"
#include "base/prefetch.h"

namespace mandoline::detail {

namespace {

/// Which bricks are kept, of one and those around it.
class KeptAround {
 public:
  KeptAround(const VerticesBefore& before, const KeptBricks& kept, const CutBricks& cut, BrickId brick) : box_(cut.bricks.boxes[brick]) {
    forSides({0, 0, 0}, {2, 2, 2}, [&](size_t i, const std::array<size_t, 3>& side) {
      Slab cell;
      for (size_t d = 0; d < 3; ++d) cell[d] = 2 * (box_.first[d] + (side[d] == 0 ? -1 : side[d] == 1 ? 0 : box_.count[d])) + 1;
      if (!cut.bricks.grid.hasCell(cell)) return;
      const std::optional<BrickId> at = cut.bricks.find(cell);
      areLost_[i] = at ? !kept.has(*at) : before.bricks.find(cell).has_value();
    });
  }

  /// Whether all that have a grid element of the brick are. So vertices on one element are kept together or not at all: see separate.h.
  bool haveKept(const Slab& element) const {
    const auto isInside = [&](size_t d) { return element[d] > 2 * box_.first[d] && element[d] < 2 * (box_.first[d] + box_.count[d]); };
    if (isInside(0) && isInside(1) && isInside(2)) return !areLost_[kWithin];
    std::array<size_t, 3> first, last;
    for (size_t d = 0; d < 3; ++d) {
      first[d] = element[d] > 2 * box_.first[d];
      last[d] = element[d] < 2 * (box_.first[d] + box_.count[d]) ? 1 : 2;
    }
    bool isAnyLost = false;
    forSides(first, last, [&](size_t i, const std::array<size_t, 3>&) { isAnyLost |= areLost_[i]; });
    return !isAnyLost;
  }

 private:
  /// Calls f(number, sides along each axis): 0 stands for below the brick, 1 for within, 2 for above.
  template <class F>
  static void forSides(const std::array<size_t, 3>& first, const std::array<size_t, 3>& last, const F& f) {
    for (size_t z = first[2]; z <= last[2]; ++z) {
      for (size_t y = first[1]; y <= last[1]; ++y) {
        for (size_t x = first[0]; x <= last[0]; ++x) f((3 * z + y) * 3 + x, std::array<size_t, 3>{x, y, z});
      }
    }
  }

  static constexpr size_t kWithin = 13;
  const BrickBox& box_;
  std::array<bool, 27> areLost_{};
};

class Finder {
 public:
  Finder(const VerticesBefore& before, const KeptBricks& kept, const CutBricks& cut, const Numbers& numbers)
      : before_(before), kept_(kept), cut_(cut), numbers_(numbers) {}

  KeptRuns run() {
    addOfSurface();
    for (const Numbers::RowOfBrick& of : numbers_.order) {
      if (kept_.isInner(of.brick)) addRow(of);
    }
    for (const BrickId b : cut_.bricks.ids()) {
      if (kept_.has(b) && !kept_.isInner(b)) addSomeOf(b);
    }
    return {sorted()};
  }

 private:
  using Run = KeptRuns::Run;

  static constexpr size_t kAhead = 16;

  void add(uint32_t number, uint32_t before, uint32_t count) {
    if (count > 0) append(runs_, {number, before, count});
  }
  /// Makes one run of two that follow each other.
  static void append(std::vector<Run>& runs, const Run& run) {
    if (!runs.empty() && runs.back().past() == run.first && runs.back().before + runs.back().count == run.before) {
      runs.back().count += run.count;
    } else {
      runs.push_back(run);
    }
  }

  /// Bricks own those in triangles.
  void addOfSurface() {
    const IdVector<VertexId, uint8_t> areLost = findLostOfSurface();
    const VertexId *const nows = kept_.vertices.data(), firstInTriangle = cut_.surface.vertices.firstInTriangle;
    for (uint32_t was = 0, past = uint32_t(kept_.vertices.size()); was < past;) {
      const VertexId first = nows[was];
      if (first >= firstInTriangle) {  // as kNoVertex is
        ++was;
        continue;
      }
      // Most have ids that follow each other.
      uint32_t count = 1;
      while (was + count < past && nows[was + count].number == first.number + count) ++count;
      const uint8_t* const lost = areLost.data() + first.number;
      const uint32_t countOnEdges = std::min(count, firstInTriangle.number - first.number);
      for (uint32_t i = 0; i < countOnEdges;) {
        const void* const found = std::memchr(lost + i, 1, countOnEdges - i);
        const uint32_t end = found ? uint32_t(static_cast<const uint8_t*>(found) - lost) : countOnEdges;
        addUsed(first.number + i, was + i, end - i);
        for (i = end; i < countOnEdges && lost[i]; ++i) {
        }
      }
      was += count;
    }
  }
  /// Vertices of the mesh and its edges with ids in a row. Numbers count those that are used.
  void addUsed(uint32_t first, uint32_t was, uint32_t count) {
    const uint32_t *const numbers = numbers_.ofSurface.data() + first, *const numbersBefore = before_.numbers.ofSurface.data() + was;
    const auto areAllUsed = [&](const uint32_t* of) {
      return of[0] != Numbers::kUnused && of[count - 1] != Numbers::kUnused && of[count - 1] - of[0] == count - 1;
    };
    if (count == 0) return;
    if (areAllUsed(numbers) && areAllUsed(numbersBefore)) return add(numbers[0], numbersBefore[0], count);
    for (uint32_t i = 0; i < count; ++i) {
      if (numbers[i] != Numbers::kUnused && numbersBefore[i] != Numbers::kUnused) add(numbers[i], numbersBefore[i], 1);
    }
  }
  /// Per vertex of the mesh and its edges: whether a brick has it that is not kept, or may have.
  IdVector<VertexId, uint8_t> findLostOfSurface() const {
    IdVector<VertexId, uint8_t> areLost(cut_.surface.vertices.size(), 0);
    for (const BrickId b : cut_.bricks.ids()) {
      if (kept_.isInner(b)) continue;
      const KeptAround around(before_, kept_, cut_, b);
      const std::span<const VertexId> list = cut_.cuts[b].surfaceVertices;
      for (size_t k = 0; k < list.size(); ++k) {
        if (k + kAhead < list.size()) prefetch(&cut_.surface.vertices.slab(list[k + kAhead]));
        areLost[list[k]] |= uint8_t(!kept_.has(b) || !around.haveKept(cut_.surface.vertices.slab(list[k])));
      }
    }
    return areLost;
  }

  /// All vertices in a row that an inner brick owns, which are in the order in which they were.
  void addRow(const Numbers::RowOfBrick& of) {
    const BrickCounts &before = before_.numbers.rows[kept_.before[of.brick]][of.row], &now = numbers_.rows[of.brick][of.row];
    add(numbers_.surfaceVertices + now.vertices, before_.numbers.surfaceVertices + before.vertices,
        cut_.seams[of.brick].rows[of.row].vertices);
  }

  /// Those that a brick owned and owns, of the others.
  void addSomeOf(BrickId brick) {
    const BrickCut& cut = cut_.cuts[brick];
    const BrickId was = kept_.before[brick];
    const KeptAround around(before_, kept_, cut_, brick);
    numbersBefore_.assign(cut.lineVertices.size(), Numbers::kUnused);
    forOwnNumbers(cut, before_.seams[was], before_.numbers.rows[was], kVertexRows, [&](uint32_t first, uint32_t past, uint32_t number) {
      for (uint32_t i = first; i < past; ++i) numbersBefore_[i] = before_.numbers.surfaceVertices + number++;
    });
    forOwnNumbers(cut, cut_.seams[brick], numbers_.rows[brick], kVertexRows, [&](uint32_t first, uint32_t past, uint32_t number) {
      for (uint32_t i = first; i < past; ++i, ++number) {
        if (numbersBefore_[i] != Numbers::kUnused && around.haveKept(cut.vertices.slab(cut.lineVertices[i])))
          add(numbers_.surfaceVertices + number, numbersBefore_[i], 1);
      }
    });
  }

  std::vector<Run> sorted() {
    std::vector<KeyedItem> order;
    order.reserve(runs_.size());
    uint32_t last = 0;
    for (const Run& run : runs_) {
      order.push_back({run.first, uint32_t(order.size())});
      last = std::max(last, run.first);
    }
    sortByKey(order, last);
    std::vector<Run> sorted;
    for (const KeyedItem& at : order) append(sorted, runs_[at.item]);
    return sorted;
  }

  const VerticesBefore& before_;
  const KeptBricks& kept_;
  const CutBricks& cut_;
  const Numbers& numbers_;
  std::vector<Run> runs_;
  std::vector<uint32_t> numbersBefore_;  // of a brick's line vertices
};

}  // namespace

KeptRuns findKeptVertices(const VerticesBefore& before, const KeptBricks& kept, const CutBricks& cut, const Numbers& numbers) {
  return Finder(before, kept, cut, numbers).run();
}

}  // namespace mandoline::detail

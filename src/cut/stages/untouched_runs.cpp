#include "cut/stages/untouched_runs.h"

namespace mandoline::detail {
namespace {

class RunFinder {
 public:
  RunFinder(const Input& input, const Bricks& bricks, UntouchedRuns& runs) : input_(input), bricks_(bricks), runs_(runs) {}

  /// `first` .. `past` - 1: the touched bricks that have cells of the row.
  void addRow(int32_t j, int32_t k, BrickId first, BrickId past) {
    int32_t from = 0;
    for (const BrickId b : Ids<BrickId>(first, past)) {
      const BrickBox& box = bricks_.boxes[b];
      const uint32_t begin = box.indexOf({2 * box.first[0] + 1, 2 * j + 1, 2 * k + 1});
      for (int32_t x = 0; x < box.count[0]; x += 64) {
        uint64_t bits = bricks_.touchedFrom(b, begin + uint32_t(x), uint32_t(std::min(box.count[0] - x, 64)));
        for (; bits != 0; bits &= bits - 1) {
          const int32_t at = box.first[0] + x + std::countr_zero(bits);
          addRun(from, at);
          from = at + 1;
        }
      }
    }
    addRun(from, input_.cells(0));
    runs_.rowOffsets.push_back(uint32_t(runs_.size()));
  }

 private:
  void addRun(int32_t begin, int32_t end) {
    if (begin >= end) return;
    runs_.begin.push_back(begin);
    runs_.end.push_back(end);
  }

  const Input& input_;
  const Bricks& bricks_;
  UntouchedRuns& runs_;
};

}  // namespace

UntouchedRuns findUntouchedRuns(const Input& input, const Bricks& bricks, const CellLayers& layers, Monitor& monitor) {
  UntouchedRuns runs;
  runs.ny = size_t(input.cells(1));
  runs.rowOffsets.reserve(runs.ny * size_t(input.cells(2)) + 1);
  runs.rowOffsets.assign(runs.ny * size_t(layers.first) + 1, 0);
  RunFinder finder(input, bricks, runs);
  const auto firstFrom = [&](uint64_t key) {
    return BrickId{uint32_t(std::lower_bound(bricks.keys.begin(), bricks.keys.end(), key) - bricks.keys.begin())};
  };
  for (int32_t k = layers.first; k < layers.past; ++k) {
    BrickId first{0}, past{0};
    for (int32_t j = 0; j < input.cells(1); ++j) {
      if ((j & ((1 << bricks.grid.shifts[1]) - 1)) == 0) {
        const uint64_t key = bricks.grid.keyOf({1, 2 * j + 1, 2 * k + 1});
        first = firstFrom(key);
        past = firstFrom(key + uint64_t(bricks.grid.counts[0]));
      }
      finder.addRow(j, k, first, past);
    }
    monitor.report(0, 1);  // it takes little of the stage, but may be told to stop
  }
  runs.rowOffsets.resize(runs.ny * size_t(input.cells(2)) + 1, uint32_t(runs.size()));
  return runs;
}

}  // namespace mandoline::detail

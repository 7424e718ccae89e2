#include "operators/refine/parts.h"

#include <algorithm>
#include <numeric>
#include <optional>

#include "base/sort.h"
#include "mandoline/for_each_brick.h"
#include "operators/measure/owners.h"

namespace mandoline::refining {

Parts::Parts(const PreparedMesh& mesh, const CutMesh& cutMesh, const std::vector<Grid>& grids, const OctreeCells& leaves)
    : mesh_(mesh), cutMesh_(cutMesh), grids_(grids), leaves_(leaves), numbers_(grids.size()) {}

uint64_t Parts::keyOf(int level, const Block& block) const {
  const auto count = [&](int d) { return uint64_t((grids_[size_t(level)].cells(d) - 1) >> kShift) + 1; };
  const auto at = [&](size_t d) { return uint64_t(block[d] >> kShift); };
  return (at(2) * count(1) + at(1)) * count(0) + at(0);
}

/// Whether all blocks around are in the same part.
bool Parts::isInside(const Block& block) {
  bool isInside = true;
  for (const int32_t x : block) isInside &= (x - 1) >> kShift == (x + 1) >> kShift;
  return isInside;
}

/// Those that have leaves of a level, or blocks around these inside of larger ones: faces of larger cells there are divided as such blocks
/// are, and edges have the vertices where the surface touches them.
std::vector<uint64_t> Parts::wantedAt(int level) const {
  std::vector<uint64_t> keys;
  const auto forLeaves = [&](const auto& visit) {
    for (size_t c = 0; c < leaves_.cellCount(); ++c) {
      if (leaves_.cellLevel[c] == level) visit(operators::blockOf(leaves_, c));
    }
  };
  forLeaves([&](const Block& block) {
    const uint64_t key = keyOf(level, block);
    if (keys.empty() || keys.back() != key) keys.push_back(key);
  });
  detail::sortUnique(keys);
  const std::vector<uint64_t> own = keys;
  forLeaves([&](const Block& block) {
    for (int32_t around = 0; around < 27 && !isInside(block); ++around) {
      const Block beside = {block[0] + around % 3 - 1, block[1] + around / 3 % 3 - 1, block[2] + around / 9 - 1};
      bool inGrid = true;
      for (size_t d = 0; d < 3; ++d) inGrid &= beside[d] >= 0 && beside[d] < grids_[size_t(level)].cells(int(d));
      if (!inGrid || std::binary_search(own.begin(), own.end(), keyOf(level, beside))) continue;
      const int64_t other = leaves_.find(int64_t(beside[0]) << level, int64_t(beside[1]) << level, int64_t(beside[2]) << level);
      if (other >= 0 && leaves_.cellLevel[size_t(other)] > level) keys.push_back(keyOf(level, beside));
    }
  });
  detail::sortUnique(keys);
  return keys;
}

void Parts::cut(detail::Monitor& monitor) {
  const size_t top = grids_.size() - 1;
  std::vector<std::optional<BrickCutter>> cutters(top);
  std::vector<uint64_t> bricks;  // per part
  for (size_t level = 0; level < top; ++level) {
    const std::vector<uint64_t> wanted = wantedAt(int(level));
    if (wanted.empty()) continue;
    ForEachBrickOptions options;
    options.threads = monitor.threads();
    options.cells = 1 << kShift;
    const BrickCutter& cutter = cutters[level].emplace(mesh_, grids_[level], options);
    for (uint64_t brick = 0; brick < cutter.count(); ++brick) {
      const auto first = cutter.first(brick);
      const Block block = {int32_t(first[0]), int32_t(first[1]), int32_t(first[2])};
      const uint64_t key = keyOf(int(level), block);
      if (!std::binary_search(wanted.begin(), wanted.end(), key)) continue;
      numbers_[level].emplace_back(key, uint32_t(parts_.size()));
      parts_.emplace_back();
      parts_.back().level = int(level);
      parts_.back().first = block;
      bricks.push_back(brick);
    }
  }
  std::vector<uint32_t> order(parts_.size());
  std::iota(order.begin(), order.end(), 0u);
  RunOptions single;
  single.threads = 1;
  detail::runItems(order, monitor, [&](size_t, uint32_t p) {
    Part& part = parts_[p];
    CutPiece piece = cutters[size_t(part.level)]->cut(bricks[p], single);
    part.measures = measure(piece.mesh, piece.cutMesh, single);
    part.own = std::move(piece.cutMesh);
    CutMesh::fields(part.own, [](const auto&, auto&& array) {
      if constexpr (requires { array.shrink_to_fit(); }) array.shrink_to_fit();
    });
    part.owners = operators::ownersOf(part.own);
    part.triangles = std::move(piece.triangles);
    part.triVertices = std::move(piece.triVertices);
  });
  Part whole;
  whole.level = int(top);
  whole.grid = &cutMesh_;
  RunOptions all;
  all.threads = monitor.threads();
  whole.measures = measure(mesh_.mesh(), cutMesh_, all);
  whole.owners = operators::ownersOf(cutMesh_);
  numbers_[top].emplace_back(0, uint32_t(parts_.size()));
  parts_.push_back(std::move(whole));
}

BlockCells Parts::at(int level, const Block& block) const {
  if (size_t(level) >= grids_.size()) return {};
  const auto& numbers = numbers_[size_t(level)];
  size_t number = 0;
  if (size_t(level) + 1 < grids_.size()) {
    const uint64_t key = keyOf(level, block);
    const auto found = std::lower_bound(numbers.begin(), numbers.end(), std::pair(key, uint32_t(0)));
    if (found == numbers.end() || found->first != key) return {};
    number = found->second;
  } else {
    number = numbers.front().second;
  }
  return {&parts_[number], number, parts_[number].cellsAt(block)};
}

}  // namespace mandoline::refining

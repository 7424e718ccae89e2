#include "operators/refine/leaves.h"

#include <algorithm>

#include "base/sort.h"
#include "operators/refine/features.h"

namespace mandoline::refining {
namespace {

class Divider {
 public:
  Divider(const MeshView& mesh, const CutMesh& cutMesh, const std::array<std::vector<double>, 3>& planes, const RefineOptions& options)
      : mesh_(mesh), cutMesh_(cutMesh), planes_(planes), options_(options), levels_(mostLevels(options)) {
    for (size_t d = 0; d < 3; ++d) tree_.gridCells[d] = int32_t(planes[d].size()) - 1;
    CoarsenOptions coarsening = options.coarsening;
    tree_.divided.resize(size_t(std::clamp(coarsening.maxLevel, 0, std::max(0, tree_.top() - levels_)) + levels_) + 1);
  }

  OctreeCells run(detail::Monitor& monitor) {
    markFeatures(monitor);
    addLayers();
    for (const RefinementBox& box : options_.boxes) markBox(box, monitor);
    if (options_.rule.divides) askOfAll(monitor);
    for (int level = 1; level <= levels_; ++level) {
      Blocks& blocks = tree_.divided[size_t(level)];
      if (level > 1) append(tree_.parentsAround(tree_.divided[size_t(level) - 1], level, options_.layers), blocks);
      detail::sortUnique(blocks, operators::isBefore);
    }
    Blocks kept = operators::cutBlocks(cutMesh_);
    if (levels_ > 0) append(tree_.divided[size_t(levels_)], kept);
    detail::sortUnique(kept, operators::isBefore);
    tree_.divideAbove(levels_, kept, operators::meantFor(cutMesh_.grid, options_.coarsening), monitor);
    return leaves(monitor);
  }

 private:
  static void append(const Blocks& from, Blocks& to) { to.insert(to.end(), from.begin(), from.end()); }

  void markFeatures(detail::Monitor& monitor) {
    if (options_.levels == 0) return;
    const Features features(mesh_, options_.angle);
    std::vector<uint32_t> triangles;
    for (size_t c = 0; c < cutMesh_.cellCount();) {  // all cut-cells of a grid cell at once
      const int32_t* at = &cutMesh_.cellGridCell[3 * c];
      triangles.clear();
      const size_t past = cutMesh_.cutCellsAt(at[0], at[1], at[2]).end;
      for (; c < past; ++c) addTriangles(c, triangles);
      detail::sortUnique(triangles);
      if (c % 1024 == 0) monitor.report(c, cutMesh_.cellCount());
      markIn({at[0], at[1], at[2]}, levels_, triangles, features);
    }
  }

  /// The cells in which the surface bends get layers around them of cells of half their size.
  void addLayers() {
    for (int level = 1; level <= levels_; ++level) {
      Blocks& blocks = tree_.divided[size_t(level)];
      Blocks inside;
      for (const Block& block : blocks) {
        for (int32_t child = 0; child < 8; ++child) inside.push_back(operators::childOf(block, child));
      }
      blocks = tree_.parentsAround(std::move(inside), level, options_.layers);
    }
  }

  void addTriangles(size_t cell, std::vector<uint32_t>& triangles) const {
    for (const uint32_t h : cutMesh_.halfFaces(cell)) {
      const uint32_t *first = &cutMesh_.faceParents[cutMesh_.faceParentOffsets[h / 2]],
                     *past = first + (cutMesh_.faceParentOffsets[h / 2 + 1] - cutMesh_.faceParentOffsets[h / 2]);
      triangles.insert(triangles.end(), first, past);
    }
  }

  void markIn(const Block& block, int level, const std::vector<uint32_t>& triangles, const Features& features) {
    if (level <= levels_ - options_.levels || !features.bends(triangles)) return;
    tree_.divided[size_t(level)].push_back(block);
    for (int32_t child = 0; child < 8; ++child) {
      const Block inside = operators::childOf(block, child);
      markIn(inside, level - 1, features.meeting(boxOf(inside, level - 1), triangles), features);
    }
  }

  Box boxOf(const Block& block, int level) const {
    Box box;
    for (size_t d = 0; d < 3; ++d) {
      box.low[d] = planes_[d][size_t(block[d]) << level];
      box.high[d] = planes_[d][size_t(block[d] + 1) << level];
    }
    return box;
  }

  void markBox(const RefinementBox& box, detail::Monitor& monitor) {
    for (int level = levels_; level > levels_ - box.levels; --level) {
      Block first, last;
      for (size_t d = 0; d < 3; ++d) {
        const auto place = [&](double x, auto bound) {
          return int32_t(bound(planes_[d].begin(), planes_[d].end(), x) - planes_[d].begin());
        };
        first[d] = std::max(place(box.min[d], std::upper_bound<std::vector<double>::const_iterator, double>) - 1, 0) >> level;
        last[d] = (place(box.max[d], std::lower_bound<std::vector<double>::const_iterator, double>) - 1);
        last[d] = last[d] < 0 ? -1 : std::min(last[d], tree_.gridCells[d] - 1) >> level;
        if (box.min[d] >= planes_[d].back()) last[d] = -1;
      }
      Blocks& blocks = tree_.divided[size_t(level)];
      for (int32_t z = first[2]; z <= last[2]; ++z) {
        for (int32_t y = first[1]; y <= last[1]; ++y) {
          for (int32_t x = first[0]; x <= last[0]; ++x) blocks.push_back({x, y, z});
        }
        monitor.report(size_t(levels_ - level), size_t(levels_));
      }
    }
  }

  void askOfAll(detail::Monitor& monitor) {
    Block block{}, cells;
    for (size_t d = 0; d < 3; ++d) cells[d] = tree_.gridCells[d] >> levels_;
    for (block[2] = 0; block[2] < cells[2]; ++block[2]) {
      for (block[1] = 0; block[1] < cells[1]; ++block[1]) {
        for (block[0] = 0; block[0] < cells[0]; ++block[0]) askOf(block, levels_);
        monitor.report(size_t(block[2]), size_t(cells[2]));
      }
    }
  }

  void askOf(const Block& block, int level) {
    if (level <= levels_ - options_.rule.levels || !divides(block, level)) return;
    tree_.divided[size_t(level)].push_back(block);
    for (int32_t child = 0; child < 8; ++child) askOf(operators::childOf(block, child), level - 1);
  }

  bool divides(const Block& block, int level) const {
    const Box box = boxOf(block, level);
    try {
      return options_.rule.divides(box.low, box.high, levels_ - level);
    } catch (...) {
      throw detail::ProgressFailed{std::current_exception()};
    }
  }

  OctreeCells leaves(detail::Monitor& monitor) const {
    OctreeCells result;
    result.gridCells = tree_.gridCells;
    tree_.forLeaves([&](const Block& block, int level) {
      for (const int32_t x : block) result.cellCorner.push_back(x << level);
      result.cellLevel.push_back(uint8_t(level));
      if (result.cellLevel.size() % 4096 == 0) monitor.report(0, 1);
    });
    return result;
  }

  const MeshView mesh_;
  const CutMesh& cutMesh_;
  const std::array<std::vector<double>, 3>& planes_;
  const RefineOptions& options_;
  const int levels_;  // of the cells of the grid
  operators::BlockTree tree_;
};

}  // namespace

int mostLevels(const RefineOptions& options) {
  int levels = std::max(options.levels, options.rule.levels);
  for (const RefinementBox& box : options.boxes) levels = std::max(levels, box.levels);
  return levels;
}

OctreeCells findLeaves(const MeshView& mesh, const CutMesh& cutMesh, const std::array<std::vector<double>, 3>& planes,
                       const RefineOptions& options, detail::Monitor& monitor) {
  return Divider(mesh, cutMesh, planes, options).run(monitor);
}

}  // namespace mandoline::refining

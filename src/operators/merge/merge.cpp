#include "mandoline/merge.h"

#include <algorithm>

#include "base/large_array.h"
#include "mesh/fingerprints.h"
#include "mesh/run_call.h"
#include "operators/cell_complex/half_faces.h"
#include "operators/merge/clusters.h"
#include "operators/merge/face_joiner.h"
#include "operators/merge/merge_parts.h"
#include "operators/require_cut_mesh.h"

namespace mandoline {
namespace {

using merging::Cluster;
using merging::Clusters;
using merging::FaceJoiner;
using merging::Fate;
using merging::JoinedFaces;

class Merger {
 public:
  Merger(const CutMesh& cutMesh, const CellComplex& cells, const MergeOptions& options)
      : cells_(cells), clusters_(cutMesh, cells, options.fraction) {}

  MergedCells run(detail::Monitor& monitor) {
    monitor.beginStage("cells", 0);
    clusters_.join(monitor);
    return take(monitor);
  }

  MergedCells run(std::span<const std::array<uint32_t, 2>> pairs, detail::Monitor& monitor) {
    monitor.beginStage("cells", 0);
    clusters_.join(pairs);
    return take(monitor);
  }

 private:
  MergedCells take(detail::Monitor& monitor) {
    numberCells();
    takeCells();
    monitor.beginStage("faces", 1);
    takeFaces(monitor);
    return std::move(result_);
  }

  /// In the order of their first members.
  void numberCells() {
    constexpr uint32_t kNone = ~0u;
    std::vector<uint32_t> number;  // per cluster
    detail::makeLarge(number, cells_.cellCount(), kNone);
    detail::reserveLarge(result_.mergedCell, cells_.cellCount());
    for (uint32_t c = 0; c < cells_.cellCount(); ++c) {
      uint32_t& mine = number[clusters_.clusterOf(c)];
      if (mine == kNone) mine = count_++, result_.cells.cutCells += c < cells_.cutCells;
      result_.mergedCell.push_back(mine);
    }
  }

  void takeCells() {
    CellComplex& to = result_.cells;
    auto members = detail::groupBy<uint32_t>(
        count_, cells_.cellCount(), [&](size_t c) { return size_t(result_.mergedCell[c]); }, [](size_t c) { return uint32_t(c); });
    for (auto* array : {&to.cellCentre, &to.cellCentroid}) detail::reserveLarge(*array, 3 * size_t(count_));
    detail::reserveLarge(to.cellCorner, 3 * size_t(count_));
    detail::reserveLarge(to.cellVolume, count_);
    detail::reserveLarge(to.cellRegion, count_);
    detail::reserveLarge(to.cellLevel, count_);
    for (uint32_t n = 0; n < count_; ++n) {
      const Cluster& cluster = clusters_[clusters_.clusterOf(members[n][0])];
      const size_t base = cluster.base;
      for (size_t i = 3 * base; i < 3 * base + 3; ++i) {
        to.cellCorner.push_back(cells_.cellCorner[i]);
        to.cellCentre.push_back(cells_.cellCentre[i]);
      }
      to.cellLevel.push_back(cells_.cellLevel[base]);
      to.cellRegion.push_back(cells_.cellRegion[base]);
      addMeasures(base, members[n]);
      if (clusters_.isSmall(to.cellVolume.back(), cluster.unit)) result_.pockets.push_back(n);
    }
    to.cellMemberOffsets = std::move(members.offsets);
    to.cellMembers = std::move(members.items);
  }

  void addMeasures(size_t base, std::span<const uint32_t> members) {
    double volume = 0, offset[3] = {};
    for (const size_t c : members) {
      volume += cells_.cellVolume[c];
      for (size_t d = 0; d < 3; ++d)
        offset[d] += cells_.cellVolume[c] * (cells_.cellCentroid[3 * c + d] - cells_.cellCentroid[3 * base + d]);
    }
    result_.cells.cellVolume.push_back(volume);
    for (size_t d = 0; d < 3; ++d)
      result_.cells.cellCentroid.push_back(cells_.cellCentroid[3 * base + d] + (volume > 0 ? offset[d] / volume : 0));
  }

  void takeFaces(detail::Monitor& monitor) {
    CellComplex& to = result_.cells;
    to.cutVertices = cells_.cutVertices;
    detail::copyLarge(cells_.positions, to.positions);
    std::vector<Fate> fates;
    detail::reserveLarge(fates, cells_.faceCount());
    for (size_t f = 0; f < cells_.faceCount(); ++f) fates.push_back(fateOf(f));
    const JoinedFaces faces = FaceJoiner(cells_, fates).join(fates, [&](uint32_t f, uint32_t g) { return areInOnePlane(f, g); });
    replaceFaces(cells_, faces, to, monitor);
    for (int32_t& cell : to.faceCells) cell = mergedCell(cell);
    operators::gatherHalfFaces(to);
  }

  int32_t mergedCell(int32_t cell) const { return cell < 0 ? cell : int32_t(result_.mergedCell[size_t(cell)]); }
  int32_t mergedCell(size_t face, size_t side) const { return mergedCell(cells_.faceCells[2 * face + side]); }

  Fate fateOf(size_t f) const {
    if (cells_.faceTag[f] == FaceTag::surface) return Fate::stays;
    const int32_t cells[] = {mergedCell(f, 0), mergedCell(f, 1)};
    if (cells[0] == cells[1]) return Fate::goes;
    const auto isMerged = [&](int32_t c) { return c >= 0 && result_.cells.membersOfCell(size_t(c)).size() > 1; };
    return isMerged(cells[0]) || isMerged(cells[1]) ? Fate::joins : Fate::stays;
  }

  /// Whether two faces of the grid are between the same cells, and in one plane.
  bool areInOnePlane(size_t f, size_t g) const {
    if (cells_.faceTag[f] != cells_.faceTag[g] || mergedCell(f, 0) != mergedCell(g, 0) || mergedCell(f, 1) != mergedCell(g, 1))
      return false;
    for (size_t d = 0; d < 3; ++d) {
      const bool isAcross = cells_.faceNormal[3 * f + d] != 0;
      if (isAcross != (cells_.faceNormal[3 * g + d] != 0) || (isAcross && place(f, d) != place(g, d))) return false;
    }
    return true;
  }
  double place(size_t face, size_t axis) const { return cells_.positions[3 * size_t(cells_.loops(face)[0][0]) + axis]; }

  const CellComplex& cells_;
  Clusters clusters_;
  uint32_t count_ = 0;
  MergedCells result_;
};

void requireUnmerged(const CutMesh& cutMesh, const CellComplex& cells) {
  operators::requireNotEmpty(cutMesh);
  operators::requireCellsOf(cutMesh, cells);
  if (!cells.cellMemberOffsets.empty()) operators::refuse("The cells are merged already.");
  operators::requireLengths(cells);
  for (size_t i = 0; i < cells.cellCorner.size(); ++i) {
    if (cells.cellCorner[i] < 0 || cells.cellCorner[i] >= cutMesh.grid.cells(int(i % 3))) operators::refuseCells();
  }
}

}  // namespace

MergedCells mergeSmallCells(const CutMesh& cutMesh, const CellComplex& cells, const MergeOptions& options) {
  if (!(options.fraction >= 0 && options.fraction <= 0.5))
    throw CallError({Status::badOption, -1, -1, "The fraction has to be from 0 to 0.5."});
  requireUnmerged(cutMesh, cells);
  return detail::runCall("merging of cells", [&] {
    detail::Monitor monitor(options, 2);
    MergedCells merged = Merger(cutMesh, cells, options).run(monitor);
    detail::Fingerprinter fingerprinter("merged cells", cells.fingerprint);
    fingerprinter.add(options.fraction);
    merged.cells.madeFrom = cells.madeFrom;
    merged.cells.fingerprint = fingerprinter.get();
    return merged;
  });
}

std::vector<uint32_t> operators::mergedWith(const CutMesh& cutMesh, const CellComplex& cells, const MergeOptions& options) {
  detail::Monitor monitor(options, 1);
  Clusters clusters(cutMesh, cells, options.fraction);
  clusters.join(monitor);
  std::vector<uint32_t> first(cells.cellCount()), ofCluster(cells.cellCount(), ~0u);
  for (uint32_t c = 0; c < cells.cellCount(); ++c) {
    uint32_t& least = ofCluster[clusters.clusterOf(c)];
    first[c] = least = std::min(least, c);
  }
  return first;
}

MergedCells operators::mergePairs(const CutMesh& cutMesh, const CellComplex& cells, std::span<const std::array<uint32_t, 2>> pairs,
                                  const MergeOptions& options) {
  detail::Monitor monitor(options, 2);
  return Merger(cutMesh, cells, options).run(pairs, monitor);
}

}  // namespace mandoline

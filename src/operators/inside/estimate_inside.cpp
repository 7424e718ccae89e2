#include <algorithm>
#include <numeric>

#include "base/csr.h"
#include "mandoline/coarsen.h"
#include "mesh/fingerprints.h"
#include "mesh/require_arrays.h"
#include "mesh/run_call.h"
#include "operators/cut_input.h"
#include "operators/inside/cell_samples.h"
#include "operators/inside/divided_regions.h"
#include "operators/inside/inside_rule.h"
#include "operators/inside/neighbours.h"
#include "operators/inside/winding_tree.h"
#include "operators/measure/owners.h"
#include "operators/require_cut_mesh.h"

namespace mandoline {
namespace {

using namespace operators;

constexpr size_t kBlock = 64;              // points between two reports
constexpr uint32_t kSamplesOfRegion = 16;  // of one that is not divided
constexpr uint32_t kStrides[] = {4096, 64, 1};
constexpr int kStages = 3 + 2 * int(std::size(kStrides));
constexpr size_t kShortRim = 12;  // edges of the rim for the square root of the number of triangles

/// The numbers of cut-cells, then octree cells.
class Estimator {
 public:
  Estimator(const MeshView& mesh, const CutMesh& cutMesh, const EstimateOptions& options, detail::Monitor& monitor)
      : mesh_(mesh), cutMesh_(cutMesh), options_(options), monitor_(monitor), owners_(ownersOf(cutMesh)) {
    isOpen_.assign(cutMesh.triangleCount, 0);
    for (const uint32_t t : cutMesh.openTriangles) isOpen_[t] = 1;
  }

  CutMesh run() {
    monitor_.beginStage("octree", 0);
    CoarsenOptions coarsening;
    coarsening.threads = options_.threads;
    octree_ = coarsen(cutMesh_, coarsening);
    findDivided();
    const WindingTree tree(mesh_, cutMesh_.openTriangles);
    monitor_.beginStage("insideness", 1);
    evaluate(tree, samplesOfOthers());
    labelDivided(tree);
    monitor_.beginStage("regions", kStages - 1);
    return divided();
  }

 private:
  uint32_t firstOctree() const { return uint32_t(cutMesh_.cellCount()); }
  uint32_t nodeCount() const { return firstOctree() + uint32_t(octree_.cellCount()); }
  uint32_t regionOf(uint32_t node) const {
    return node < firstOctree() ? cutMesh_.cellRegion[node] : octree_.cellRegion[node - firstOctree()];
  }

  /// The regions on both sides of an open part: they meet through its holes, and their cells need numbers of their own.
  void findDivided() {
    isDivided_.assign(cutMesh_.regionCount, 0);
    for (size_t f = 0; f < cutMesh_.faceCount(); ++f) {
      const int32_t behind = owners_[2 * f], front = owners_[2 * f + 1];
      if (behind < 0 || front < 0 || cutMesh_.cellRegion[size_t(behind)] != cutMesh_.cellRegion[size_t(front)]) continue;
      for (uint32_t p = cutMesh_.faceParentOffsets[f]; p < cutMesh_.faceParentOffsets[f + 1]; ++p) {
        if (isOpen_[cutMesh_.faceParents[p]]) isDivided_[cutMesh_.cellRegion[size_t(behind)]] = 1;
      }
    }
  }

  /// Some cells of each region that is not divided.
  std::vector<uint32_t> samplesOfOthers() const {
    std::vector<uint32_t> samples, count(cutMesh_.regionCount, 0), seen(cutMesh_.regionCount, 0);
    for (uint32_t node = 0; node < nodeCount(); ++node) ++count[regionOf(node)];
    for (uint32_t node = 0; node < nodeCount(); ++node) {
      const uint32_t region = regionOf(node), every = 1 + (count[region] - 1) / kSamplesOfRegion;
      if (!isDivided_[region] && seen[region]++ % every == 0) samples.push_back(node);
    }
    return samples;
  }

  CellSample sampleOf(uint32_t node, CellSampler& sampler) const {
    return node < firstOctree() ? sampler.sample(node) : CellSample{centreOf(node - firstOctree()), {}, 0};
  }

  /// Adds the numbers of these cells.
  void evaluate(const WindingTree& tree, const std::vector<uint32_t>& nodes) {
    const size_t first = sampled_.size();
    sampled_.insert(sampled_.end(), nodes.begin(), nodes.end());
    insideness_.resize(sampled_.size());
    struct Nothing {};
    detail::forChunks<Nothing>(
        nodes.size(), monitor_,
        [&](Nothing&, size_t begin, size_t end) {
          CellSampler sampler(cutMesh_, isOpen_);
          for (size_t i = begin; i < end; ++i) {
            const uint32_t node = nodes[i];
            const CellSample sample = sampleOf(node, sampler);
            const uint32_t region = regionOf(node);
            const int32_t part = cutMesh_.regionPartWinding.empty() ? 0 : cutMesh_.regionPartWinding[region];
            insideness_[first + i] = part + sample.step + tree.at(sample.point, sample.leftOut);
          }
        },
        kBlock);
  }

  /// Labels the cells of divided regions by the winding number that their own counts as. Numbers change steeply near the rim alone, and
  /// up to whole numbers they depend on the rim alone: where that is short, labels spread from cell to cell. Cells that none reaches have
  /// theirs evaluated.
  void labelDivided(const WindingTree& tree) {
    const bool spreads = tree.rimSize() * tree.rimSize() < kShortRim * kShortRim * cutMesh_.openTriangles.size();
    if (spreads) findNeighbours();
    labels_.assign(nodeCount(), 0);
    isLabelled_.assign(nodeCount(), 0);
    for (size_t round = 0; round < std::size(kStrides); ++round) {
      if (!spreads && kStrides[round] > 1) continue;
      monitor_.beginStage("insideness", 2 + 2 * int(round));
      std::vector<uint32_t> seeds;
      uint32_t seen = 0;
      for (uint32_t node = 0; node < nodeCount(); ++node) {
        if (isDivided_[regionOf(node)] && !isLabelled_[node] && seen++ % kStrides[round] == 0) seeds.push_back(node);
      }
      const size_t first = sampled_.size(), end = first + seeds.size();
      evaluate(tree, seeds);
      for (size_t i = first; i < end; ++i) label(sampled_[i], insideness_[i]);
      if (!spreads) continue;
      monitor_.beginStage("insideness", 3 + 2 * int(round));
      for (size_t i = first; i < end; ++i) spread(tree, sampled_[i], insideness_[i]);
    }
  }

  void label(uint32_t node, double number) { setLabel(node, roundedWinding(number, options_.threshold)); }
  void setLabel(uint32_t node, int32_t label) {
    labels_[node] = label;
    isLabelled_[node] = 1;
    ++labelled_;
  }

  void findNeighbours() {
    std::vector<std::array<uint32_t, 2>> pairs;
    forEachNeighbours(cutMesh_, octree_, owners_, [&](uint32_t a, uint32_t b) {
      if (!isDivided_[regionOf(a)]) return;
      pairs.push_back({a, b});
      pairs.push_back({b, a});
    });
    neighbours_ = detail::groupBy<uint32_t>(
        nodeCount(), pairs.size(), [&](size_t i) { return size_t(pairs[i][0]); }, [&](size_t i) { return pairs[i][1]; });
  }

  /// A number, where it was taken, and how much it varies on the way from there to a cell, at most.
  struct Reached {
    uint32_t node;
    detail::Point point;
    double number, variation;
  };

  /// Breadth first from a cell with this number, except along the rim. A cell where its label might change gets a number of its own.
  void spread(const WindingTree& tree, uint32_t seed, double number) {
    CellSampler sampler(cutMesh_, isOpen_);
    std::vector<Reached> reached{{seed, sampleOf(seed, sampler).point, number, 0}};
    for (size_t i = 0; i < reached.size(); ++i) {
      if (i % kBlock == kBlock - 1) monitor_.report(labelled_, nodeCount());
      Reached from = reached[i];
      for (const uint32_t next : neighbours_[from.node]) {
        if (isLabelled_[next]) continue;
        detail::Box box = boxOf(from.node);
        box.include(boxOf(next));
        const double further = from.variation + tree.variation(box);
        if (further == INFINITY) continue;
        if (isSteady(from.number, further)) {
          setLabel(next, labels_[from.node]);
          reached.push_back({next, from.point, from.number, further});
          continue;
        }
        if (from.variation > 0) from = moved(tree, from, from.node, sampler);
        reached.push_back(moved(tree, from, next, sampler));
        label(next, reached.back().number);
        sampled_.push_back(next);
        insideness_.push_back(reached.back().number);
      }
    }
  }

  /// The number at a cell that was reached, or next to that if its number was taken there.
  Reached moved(const WindingTree& tree, const Reached& from, uint32_t node, CellSampler& sampler) const {
    const detail::Point there = sampleOf(node, sampler).point;
    double change = tree.change(from.point, there);
    // On a longer way it is but for a whole number what it is on the line.
    if (from.variation > 0) change -= std::round(change);
    return {node, there, from.number + change, 0};
  }

  /// Whether the number varies by less than a half, and its label not at all.
  bool isSteady(double number, double variation) const {
    if (!(variation < 0.5)) return false;
    return roundedWinding(number - variation, options_.threshold) == roundedWinding(number + variation, options_.threshold);
  }

  /// The grid cells that hold a cell.
  detail::Box boxOf(uint32_t node) const {
    detail::Box box;
    for (size_t d = 0; d < 3; ++d) {
      const std::vector<double>& planes = cutMesh_.grid.planes[d];
      const int32_t low = node < firstOctree() ? cutMesh_.cellGridCell[3 * size_t(node) + d] : octree_.corner(node - firstOctree())[d];
      box.low[d] = planes[size_t(low)];
      box.high[d] = planes[size_t(node < firstOctree() ? low + 1 : octree_.end(node - firstOctree())[d])];
    }
    return box;
  }

  detail::Point centreOf(size_t octreeCell) const {
    const auto low = octree_.corner(octreeCell), high = octree_.end(octreeCell);
    detail::Point centre;
    for (size_t d = 0; d < 3; ++d) {
      const std::vector<double>& planes = cutMesh_.grid.planes[d];
      centre[d] = planes[size_t(low[d])] / 2 + planes[size_t(high[d])] / 2;
    }
    return centre;
  }

  CutMesh divided() {
    DividedRegions regions = divideRegions(cutMesh_, octree_, owners_, labels_);
    const auto newRegionOf = [&](uint32_t node) {
      return node < firstOctree() ? regions.cellRegion[node] : regions.octreeRegion[node - firstOctree()];
    };
    CutMesh result = cutMesh_;
    result.regionCount = regions.count;
    result.regionInsideness.assign(regions.count, 0);
    std::vector<uint32_t> samples(regions.count, 0), oldRegion(regions.count, 0);
    std::vector<double> least(regions.count, INFINITY), most(regions.count, -INFINITY);
    for (uint32_t node = 0; node < nodeCount(); ++node) oldRegion[newRegionOf(node)] = regionOf(node);
    for (size_t i = 0; i < sampled_.size(); ++i) {
      const uint32_t region = newRegionOf(sampled_[i]);
      ++samples[region];
      result.regionInsideness[region] += insideness_[i];
      least[region] = std::min(least[region], insideness_[i]);
      most[region] = std::max(most[region], insideness_[i]);
    }
    for (uint32_t r = 0; r < regions.count; ++r) {  // the mean, which rounding must not take across the threshold
      result.regionInsideness[r] = std::clamp(result.regionInsideness[r] / samples[r], least[r], most[r]);
    }
    takeOver(cutMesh_.regionPartWinding, oldRegion, result.regionPartWinding);
    takeOver(cutMesh_.regionParity, oldRegion, result.regionParity);
    result.cellRegion = std::move(regions.cellRegion);
    result.rowRunOffsets = std::move(regions.rowRunOffsets);
    result.runBegin = std::move(regions.runBegin);
    result.runEnd = std::move(regions.runEnd);
    result.runRegion = std::move(regions.runRegion);
    return result;
  }

  template <class Number>
  static void takeOver(const std::vector<Number>& numbers, const std::vector<uint32_t>& oldRegion, std::vector<Number>& out) {
    out.clear();
    for (const uint32_t region : oldRegion) {
      if (!numbers.empty()) out.push_back(numbers[region]);
    }
  }

  const MeshView mesh_;
  const CutMesh& cutMesh_;
  const EstimateOptions& options_;
  detail::Monitor& monitor_;
  std::vector<int32_t> owners_;
  std::vector<uint8_t> isOpen_;  // per triangle
  OctreeCells octree_;
  std::vector<uint8_t> isDivided_;  // per region
  detail::Csr<uint32_t> neighbours_;
  std::vector<uint32_t> sampled_;   // nodes whose numbers were evaluated
  std::vector<double> insideness_;  // per sampled node
  std::vector<int32_t> labels_;     // per node; 0 in regions that are not divided
  std::vector<uint8_t> isLabelled_;
  size_t labelled_ = 0;  // how often, of those evaluated together once more
};

}  // namespace

CutMesh estimateInside(const MeshView& mesh, const CutMesh& cutMesh, const EstimateOptions& options) {
  requireCutMesh(cutMesh);
  requireThreshold(options.threshold);
  const CutInput input(mesh, cutMesh);
  if (!cutMesh.regionInsideness.empty()) refuse("The cut-mesh has estimates already.");
  if (cutMesh.openTriangles.empty()) return cutMesh;
  return detail::runCall("estimate", [&] {
    detail::Monitor monitor(options, kStages);
    CutMesh result = Estimator(input.mesh(), cutMesh, options, monitor).run();
    detail::Fingerprinter fingerprinter("estimate", cutMesh.fingerprint);
    fingerprinter.add(options.threshold);
    result.fingerprint = fingerprinter.get();
    return result;
  });
}

std::vector<double> generalizedWindingNumbers(const MeshView& mesh, std::span<const double> points, const RunOptions& options) {
  if (points.size() % 3 != 0) refuse("The number of coordinates is not a multiple of 3.");
  detail::requireArrays(mesh);
  return detail::runCall("sum of solid angles", [&] {
    detail::Monitor monitor(options, 1);
    monitor.beginStage("insideness", 0);
    std::vector<uint32_t> all(mesh.triangleCount());
    std::iota(all.begin(), all.end(), 0u);
    const WindingTree tree(mesh, all);
    std::vector<double> numbers(points.size() / 3);
    struct Nothing {};
    detail::forChunks<Nothing>(
        numbers.size(), monitor,
        [&](Nothing&, size_t begin, size_t end) {
          for (size_t i = begin; i < end; ++i) numbers[i] = tree.at({points[3 * i], points[3 * i + 1], points[3 * i + 2]});
        },
        kBlock);
    return numbers;
  });
}

}  // namespace mandoline

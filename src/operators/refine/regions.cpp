#include "operators/refine/regions.h"

#include <algorithm>

#include "base/disjoint_sets.h"
#include "mesh/failure.h"

namespace mandoline::refining {
namespace {

constexpr uint32_t kNone = ~0u;

/// A side of a triangle at one of its vertices, which larger and smaller cells have in common.
struct Corner {
  uint32_t triangle, vertex, side, region;

  auto place() const { return std::array{triangle, vertex, side}; }
  bool operator<(const Corner& c) const { return place() != c.place() ? place() < c.place() : region < c.region; }
  bool operator==(const Corner& c) const { return place() == c.place() && region == c.region; }
};

class RegionFinder {
 public:
  RegionFinder(const CellComplex& cells, const CutMesh& cutMesh, const Assembled& assembled, const Sources& sources)
      : cells_(cells), cutMesh_(cutMesh), assembled_(assembled), sources_(sources), whole_(sources.parts[sources.parts.size() - 1]) {}

  std::vector<uint32_t> run() {
    joinCells();
    ofWhole_.assign(count_, kNone);
    takeUndivided();
    if (std::find(ofWhole_.begin(), ofWhole_.end(), kNone) != ofWhole_.end()) {
      takeCorners();
      takeRest();
    }
    std::vector<uint32_t> found = ofWhole_;
    detail::sortUnique(found);
    if (count_ != sources_.whole.regionCount || found.size() != count_ || (count_ > 0 && found.back() >= count_))
      throw detail::Failure{{Status::internalError, -1, -1, "Refined cells have other regions than the cut."}};
    for (uint32_t& region : regions_) region = ofWhole_[region];
    return std::move(regions_);
  }

 private:
  /// Through faces of the grid.
  void joinCells() {
    const size_t count = cells_.cellLevel.size();
    detail::DisjointSets sets(count);
    for (size_t f = 0; f < cells_.faceCount(); ++f) {
      const int32_t a = cells_.faceCells[2 * f], b = cells_.faceCells[2 * f + 1];
      if (cells_.faceTag[f] != FaceTag::surface && a >= 0 && b >= 0) sets.unite(uint32_t(a), uint32_t(b));
    }
    regions_.resize(count);
    for (uint32_t c = 0; c < count; ++c) {
      const uint32_t root = sets.find(c);
      regions_[c] = root == c ? count_++ : regions_[root];
    }
  }

  /// Those with cells that are not divided.
  void takeUndivided() {
    const UntouchedCells untouched(sources_.whole);
    for (size_t leaf = 0; leaf < sources_.leaves.cellCount(); ++leaf) {
      const BlockCells block = assembled_.cellsOf(sources_.parts, leaf);
      const uint32_t first = assembled_.firstCells[leaf];
      if (block.isCut()) {
        for (size_t i = 0; i < block.cells.size() && block.part == &whole_; ++i)
          ofWhole_[regions_[first + i]] = sources_.whole.cellRegion[block.cells.begin + i];
      } else if (ofWhole_[regions_[first]] == kNone) {
        Block at = sources_.leaves.corner(leaf);
        for (int32_t& x : at) x >>= whole_.level;
        const int64_t region = untouched.regionAt(at[0], at[1], at[2]);
        if (region >= 0) ofWhole_[regions_[first]] = uint32_t(region);
      }
    }
  }

  /// By triangles of the whole cut's cells that are divided.
  void takeCorners() {
    const CutMesh& whole = sources_.whole;
    std::vector<Corner> corners;
    for (uint32_t h = 0; h < whole_.owners.size(); ++h) {
      const int32_t triangle = whole.faceTriangle[h / 2], cell = whole_.owners[h];
      if (triangle < 0 || cell < 0) continue;
      for (const auto loop : whole.loops(h / 2)) {
        for (const uint32_t v : loop)
          corners.push_back({uint32_t(triangle), sources_.ids.of(sources_.parts.size() - 1, v), h % 2, whole.cellRegion[size_t(cell)]});
      }
    }
    detail::sortUnique(corners);
    for (size_t f = 0; f < cells_.cutFaces; ++f) {
      const int32_t triangle = cutMesh_.faceTriangle[f];
      if (triangle < 0) continue;
      for (const uint32_t side : {0u, 1u}) {
        const int32_t cell = cells_.faceCells[2 * f + side];
        if (cell < 0 || ofWhole_[regions_[size_t(cell)]] != kNone) continue;
        for (const auto loop : cells_.loops(f)) {
          for (const uint32_t v : loop) takeCorner({uint32_t(triangle), v, side, 0}, corners, regions_[size_t(cell)]);
        }
      }
    }
  }

  /// Where several triangles meet it may be that of several regions.
  void takeCorner(const Corner& corner, const std::vector<Corner>& corners, uint32_t region) {
    const auto found = std::lower_bound(corners.begin(), corners.end(), corner);
    if (found == corners.end() || found->place() != corner.place()) return;
    if (found + 1 != corners.end() && found[1].place() == corner.place()) return;
    ofWhole_[region] = found->region;
  }

  /// What is left, between triangles that meet near each other, by volume.
  void takeRest() {
    const std::vector<double> ofWhole = regionVolumes(sources_.whole, whole_.measures);
    std::vector<double> volumes(count_);
    for (size_t c = 0; c < regions_.size(); ++c) volumes[regions_[c]] += cells_.cellVolume[c];
    std::vector<uint8_t> isTaken(ofWhole.size());
    for (const uint32_t region : ofWhole_) {
      if (region != kNone) isTaken[region] = 1;
    }
    std::vector<uint32_t> left, leftOfWhole;
    for (uint32_t r = 0; r < count_; ++r) {
      if (ofWhole_[r] == kNone) left.push_back(r);
    }
    for (uint32_t r = 0; r < ofWhole.size(); ++r) {
      if (!isTaken[r]) leftOfWhole.push_back(r);
    }
    if (left.size() != leftOfWhole.size()) return;
    detail::sortItems(left, [&](uint32_t a, uint32_t b) { return volumes[a] < volumes[b]; });
    detail::sortItems(leftOfWhole, [&](uint32_t a, uint32_t b) { return ofWhole[a] < ofWhole[b]; });
    for (size_t i = 0; i < left.size(); ++i) ofWhole_[left[i]] = leftOfWhole[i];
  }

  const CellComplex& cells_;
  const CutMesh& cutMesh_;
  const Assembled& assembled_;
  const Sources& sources_;
  const Part& whole_;
  uint32_t count_ = 0;
  std::vector<uint32_t> regions_;  // per cell: in the order of first cells
  std::vector<uint32_t> ofWhole_;  // per region of these: that of the whole cut
};

}  // namespace

std::vector<uint32_t> findRegions(const CellComplex& cells, const CutMesh& cutMesh, const Assembled& assembled, const Sources& sources) {
  return RegionFinder(cells, cutMesh, assembled, sources).run();
}

}  // namespace mandoline::refining

#include "cut/stages/kept_bricks.h"

#include <algorithm>

#include "base/sort.h"

namespace mandoline::detail {
namespace {

class Keeper {
 public:
  Keeper(const CutBefore& before, SurfaceMap now, const Surface& surface, const SurfaceParts& parts, Bricks& bricks)
      : before_(before), surface_(surface), parts_(parts), bricks_(bricks), now_(std::move(now)) {}

  KeptBricks run() {
    KeptBricks kept;
    if (!now_.isOrdered()) return kept;
    kept.before.assign(bricks_.size(), KeptBricks::kNone);
    kept.inner.assign(bricks_.size(), 1);
    kept.cuts.resize(bricks_.size());
    const IdVector<BrickId, uint8_t> haveOthersBefore = findOthers(before_.parts, before_.bricks),
                                     haveOthersNow = findOthers(parts_, bricks_);
    IdVector<BrickId, uint8_t> isKept(before_.bricks.size(), 0);
    BrickId was{0};
    for (const BrickId b : bricks_.ids()) {
      while (was.number < before_.bricks.size() && before_.bricks.keys[was] < bricks_.keys[b]) ++was.number;
      if (was.number == before_.bricks.size()) break;
      if (before_.bricks.keys[was] != bricks_.keys[b]) continue;
      if (haveOthersBefore[was] || haveOthersNow[b] || !isSame(was, b)) continue;
      kept.before[b] = was;
      isKept[was] = 1;
      kept.cuts[b] = renumbered(before_.cuts[was]);
      const auto touched = before_.bricks.wordsOf(was);
      std::copy(touched.begin(), touched.end(), bricks_.wordsOf(b).begin());
    }
    for (const BrickId b : bricks_.ids()) {
      if (!kept.has(b)) noteAround(bricks_.boxes[b], kept.inner);
    }
    for (const BrickId b : isKept.ids()) {
      if (!isKept[b]) noteAround(before_.bricks.boxes[b], kept.inner);
    }
    kept.cuts.memory = std::move(before_.cuts.memory);
    dropUnused(kept);
    kept.vertices = now_.takeVertices();
    return kept;
  }

 private:
  /// Per brick: whether it has parts of triangles that are not the same.
  IdVector<BrickId, uint8_t> findOthers(const SurfaceParts& parts, const Bricks& bricks) const {
    IdVector<BrickId, uint8_t> haveOthers(bricks.size(), 0);
    const TriangleId last = now_.pastLast();
    auto part = parts.clipped.parts.begin();
    const auto end = parts.clipped.parts.end();
    for (TriangleId first = now_.pastSame({0}, last), past; first < last; first = now_.pastSame(past, last)) {
      past = now_.pastOthers(first, last);
      part = partitionPointAhead(part, end, [&](const ClippedTriangles::Part& p) { return p.triangle < first; });
      for (; part != end && part->triangle < past; ++part) {
        const auto found = std::lower_bound(bricks.keys.begin(), bricks.keys.end(), part->brick);
        haveOthers[{uint32_t(found - bricks.keys.begin())}] = 1;
      }
    }
    return haveOthers;
  }

  /// Of bricks all of whose triangles are the same: if there are as many parts, they are, too, and so are edges that clipping made of them.
  bool isSame(BrickId was, BrickId is) const {
    const auto areSame = [](const auto& a, const auto& b, const auto& same) {
      return std::equal(a.begin(), a.end(), b.begin(), b.end(), same);
    };
    const auto haveSame = [&](const auto& csrs, const auto& same) {
      return areSame((before_.bricks.*csrs)[was], (bricks_.*csrs)[is], same);
    };
    return before_.bricks.parts[was].size() == bricks_.parts[is].size() &&
           haveSame(&Bricks::dividedFaces, [&](FaceId a, FaceId b) { return isSameFace(a, b); }) &&
           areSame(edgesNotClipped(before_.parts, before_.bricks, was), edgesNotClipped(parts_, bricks_, is),
                   [&](uint32_t a, uint32_t b) {
                     return isSameEdge(faceEdge(before_.surface, before_.parts, a), faceEdge(surface_, parts_, b));
                   }) &&
           haveSame(&Bricks::seamVertices, [&](VertexId a, VertexId b) { return now_[a] == b; });
  }
  /// The edges in grid-faces of a brick that clipping did not make.
  static std::span<const uint32_t> edgesNotClipped(const SurfaceParts& parts, const Bricks& bricks, BrickId brick) {
    const std::span<const uint32_t> edges = bricks.faceEdges[brick];
    const auto first = std::lower_bound(edges.begin(), edges.end(), uint32_t(parts.clipped.hybridEdges.size()));
    return edges.subspan(size_t(first - edges.begin()));
  }
  /// Of a divided triangle.
  bool isSameFace(FaceId was, FaceId is) const {
    const TriFaces &before = before_.parts.divided, &now = parts_.divided;
    return before.triangles[was] == now.triangles[is] && now_.isSame(now.triangles[is]) && before.elements[was] == now.elements[is];
  }
  bool isSameEdge(const FaceEdge& a, const FaceEdge& b) const {
    return a.element == b.element && now_[a.from] == b.from && now_[a.to] == b.to;
  }

  /// Notes that not all bricks are kept around those about one, itself included.
  void noteAround(const BrickBox& box, IdVector<BrickId, uint8_t>& inner) const {
    bricks_.grid.forAround(box, [&](const Slab& cell) {
      if (const std::optional<BrickId> brick = bricks_.find(cell)) inner[*brick] = 0;
    });
  }

  /// Gives back the memory of bricks that are not kept, once that is half of it. What no other bricks are in is used again.
  static void dropUnused(KeptBricks& kept) {
    BrickCuts& cuts = kept.cuts;
    size_t used = 0;
    std::vector<uint8_t> isUsed(cuts.memory.size(), 0);
    for (const BrickId b : cuts.ids()) {
      if (!kept.has(b)) continue;
      isUsed[cuts[b].memory] = 1;
      cuts[b].forArrays([&](const auto& array, Arena BrickMemory::*) { used += array.size_bytes(); });
    }
    for (uint32_t i = 0; i < isUsed.size(); ++i) {
      if (isUsed[i]) continue;
      cuts.memory[i].clear();
      cuts.freeMemory.push_back(i);
    }
    if (cuts.bytes() <= 2 * used) return;
    BrickMemory memory;
    for (BrickCut& cut : cuts) {
      cut.forArrays([&](auto& array, Arena BrickMemory::*part) { array = (memory.*part).copy(array); });
      cut.memory = 0;
    }
    cuts.memory.clear();
    cuts.freeMemory.clear();
    cuts.memory.push_back(std::move(memory));
  }

  BrickCut renumbered(BrickCut& cut) const {
    BrickCut result = std::move(cut);
    CutVertices vertices = CutVertices::ofBrick(surface_.vertices);
    vertices.slabs = std::move(result.vertices.slabs);
    vertices.parentTriangles = std::move(result.vertices.parentTriangles);
    result.vertices = std::move(vertices);
    for (auto* ids : {&result.surfaceVertices, &result.lineVertices}) Arena::rewrite(*ids, [&](VertexId v) { return now_.inBrick(v); });
    return result;
  }

  const CutBefore& before_;
  const Surface& surface_;
  const SurfaceParts& parts_;
  Bricks& bricks_;
  SurfaceMap now_;
};

}  // namespace

KeptBricks keepBricks(const CutBefore& before, SurfaceMap now, const Surface& surface, const SurfaceParts& parts, Bricks& bricks) {
  return Keeper(before, std::move(now), surface, parts, bricks).run();
}

}  // namespace mandoline::detail

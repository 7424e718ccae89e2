#include "cut/stages/kept_clips.h"

namespace mandoline::detail {
namespace {

/// Joins what was known of triangles that are the same with what others gave. All lists ascend by triangle.
class ClipJoiner {
 public:
  ClipJoiner(const ClippedTriangles& before, const ClippedTriangles& others, const SurfaceMap& now)
      : before_(before), others_(others), now_(now) {}

  /// `vertices`: of the others; all, afterwards.
  void joinVertices(const CutVertices& before, CutVertices& vertices) {
    firstOther_ = vertices.firstInTriangle;
    const std::vector<TriangleId> parents = std::move(vertices.parentTriangles);
    const auto firstSlab = vertices.slabs.begin() + ptrdiff_t(firstOther_.number);
    const std::vector<Slab> slabs(firstSlab, vertices.slabs.end());
    vertices.slabs.erase(firstSlab, vertices.slabs.end());
    vertices.parentTriangles.clear();
    vertices.slabs.reserve(vertices.slabs.size() + before.parentTriangles.size() + slabs.size());
    vertices.parentTriangles.reserve(before.parentTriangles.size() + slabs.size());
    const Slab* slabsBefore = before.slabs.data() + before.firstInTriangle.number;
    const auto triangleIn = [](const std::vector<TriangleId>& list, size_t i) { return list[i]; };
    join(
        before.parentTriangles, parents, triangleIn, [&](size_t i) { vertices.add(slabsBefore[i], before.parentTriangles[i]); },
        [&](size_t i) { otherIds_.push_back(vertices.add(slabs[i], parents[i])); });
  }

  /// Once `now` has the vertices.
  ClippedTriangles joinRest() {
    joinParts();
    const size_t edges = before_.hybridEdges.size() + others_.hybridEdges.size();
    all_.hybridEdges.reserve(edges);
    all_.hybridTriangles.reserve(edges);
    joinTagged(before_.hybridTriangles, others_.hybridTriangles, all_.hybridTriangles,
               [&](const ClippedTriangles& from, size_t i, auto id) {
                 const FaceEdge& edge = from.hybridEdges[i];
                 all_.hybridEdges.push_back({edge.element, id(edge.from), id(edge.to)});
               });
    joinTagged(before_.seamTriangles, others_.seamTriangles, all_.seamTriangles,
               [&](const ClippedTriangles& from, size_t i, auto id) { all_.seamVertices.push_back(id(from.seamVertices[i])); });
    return std::move(all_);
  }

 private:
  /// Calls addBefore(place) for the entries of `before` whose triangles are the same, and addOther(place) for all of `others`.
  template <class List, class TriangleIn, class Before, class Other>
  void join(const List& before, const List& others, const TriangleIn& triangleIn, const Before& addBefore, const Other& addOther) const {
    size_t i = 0;
    const auto addBeforeUntil = [&](TriangleId past) {
      for (; i < before.size() && triangleIn(before, i) < past; ++i) {
        if (now_.isSame(triangleIn(before, i))) addBefore(i);
      }
    };
    for (size_t other = 0; other < others.size(); ++other) {
      addBeforeUntil(triangleIn(others, other));
      addOther(other);
    }
    addBeforeUntil({~0u});
  }

  VertexId idNow(VertexId other) const { return other < firstOther_ ? other : otherIds_[other.number - firstOther_.number]; }

  /// Of lists whose triangles are in one of their own: add(of whom, place, id now of their vertices).
  template <class Add>
  void joinTagged(const std::vector<TriangleId>& before, const std::vector<TriangleId>& others, std::vector<TriangleId>& triangles,
                  const Add& add) {
    join(
        before, others, [](const std::vector<TriangleId>& list, size_t i) { return list[i]; },
        [&](size_t i) {
          triangles.push_back(before[i]);
          add(before_, i, [&](VertexId v) { return now_[v]; });
        },
        [&](size_t i) {
          triangles.push_back(others[i]);
          add(others_, i, [&](VertexId v) { return idNow(v); });
        });
  }

  void joinParts() {
    const auto addPart = [&](const ClippedTriangles& from, size_t i, const auto& id) {
      ClippedTriangles::Part part = from.parts[i];
      if (part.piece != ClippedTriangles::kWhole) {
        const bool isNew = i == 0 || from.parts[i - 1].piece != part.piece;  // bricks beside each other may have the same one
        if (isNew) {
          for (const Corner& c : from.pieces[part.piece]) all_.pieces.items.push_back({id(c.id), c.slab});
          all_.pieces.endGroup();
        }
        part.piece = uint32_t(all_.pieces.size()) - 1;
      }
      all_.parts.push_back(part);
    };
    all_.parts.reserve(before_.parts.size() + others_.parts.size());
    all_.pieces.offsets.reserve(before_.pieces.offsets.size() + others_.pieces.offsets.size());
    all_.pieces.items.reserve(before_.pieces.items.size() + others_.pieces.items.size());
    join(
        before_.parts, others_.parts, [](const auto& list, size_t i) { return list[i].triangle; },
        [&](size_t i) { addPart(before_, i, [&](VertexId v) { return now_[v]; }); },
        [&](size_t i) { addPart(others_, i, [&](VertexId v) { return idNow(v); }); });
  }

  const ClippedTriangles &before_, &others_;
  const SurfaceMap& now_;
  VertexId firstOther_{0};
  std::vector<VertexId> otherIds_;  // now, of the others' vertices in triangles
  ClippedTriangles all_;
};

}  // namespace

void ClipsBefore::addTo(ClippedTriangles& others, CutVertices& vertices) {
  if (!now_.areEdgesSame()) return now_.mapInTriangles();
  ClipJoiner joiner(clipped_, others, now_);
  joiner.joinVertices(vertices_, vertices);
  now_.mapInTriangles();
  others = joiner.joinRest();
}

}  // namespace mandoline::detail

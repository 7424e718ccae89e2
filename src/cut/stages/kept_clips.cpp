#include "cut/stages/kept_clips.h"

#include "base/sort.h"

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
    const auto add = [&](const Slab* from, const std::vector<TriangleId>& triangles, const IdRange& range) {
      vertices.slabs.insert(vertices.slabs.end(), from + range.begin, from + range.end);
      append(triangles, range, vertices.parentTriangles);
    };
    join(
        before.parentTriangles, parents, [](TriangleId t) { return t; },
        [&](const IdRange& range) { add(before.slabs.data() + before.firstInTriangle.number, before.parentTriangles, range); },
        [&](const IdRange& range) {
          for (size_t i = 0; i < range.size(); ++i) otherIds_.push_back({uint32_t(vertices.size() + i)});
          add(slabs.data(), parents, range);
        });
  }

  /// Once `now` has the vertices.
  ClippedTriangles joinRest() {
    joinParts();
    const size_t edges = before_.hybridEdges.size() + others_.hybridEdges.size();
    all_.hybridEdges.reserve(edges);
    all_.hybridTriangles.reserve(edges);
    joinTagged(&ClippedTriangles::hybridTriangles, [&](const ClippedTriangles& from, const IdRange& range, const auto& id) {
      for (size_t i = range.begin; i < range.end; ++i) {
        const FaceEdge& edge = from.hybridEdges[i];
        all_.hybridEdges.push_back({edge.element, id(edge.from), id(edge.to)});
      }
    });
    joinTagged(&ClippedTriangles::seamTriangles, [&](const ClippedTriangles& from, const IdRange& range, const auto& id) {
      for (size_t i = range.begin; i < range.end; ++i) all_.seamVertices.push_back(id(from.seamVertices[i]));
    });
    return std::move(all_);
  }

 private:
  template <class Item>
  static void append(const std::vector<Item>& from, const IdRange& range, std::vector<Item>& to) {
    to.insert(to.end(), from.begin() + ptrdiff_t(range.begin), from.begin() + ptrdiff_t(range.end));
  }

  /// Calls addBefore(places) for the entries of `before` whose triangles are the same, and addOther(places) for all of `others`, whose
  /// triangles are not: for as many at once as follow each other.
  template <class Item, class TriangleOf, class Before, class Other>
  void join(const std::vector<Item>& before, const std::vector<Item>& others, const TriangleOf& triangleOf, const Before& addBefore,
            const Other& addOther) const {
    const TriangleId last = now_.pastLast();
    const auto placeOf = [&](const std::vector<Item>& list, size_t from, TriangleId triangle) {
      const auto first = list.begin() + ptrdiff_t(from);
      return size_t(partitionPointAhead(first, list.end(), [&](const Item& item) { return triangleOf(item) < triangle; }) - list.begin());
    };
    size_t i = 0, other = 0;
    while (i < before.size() || other < others.size()) {
      const TriangleId next =
          std::min(i < before.size() ? triangleOf(before[i]) : last, other < others.size() ? triangleOf(others[other]) : last);
      if (now_.isSame(next)) {
        const size_t first = i;
        i = placeOf(before, i, now_.pastSame(next, last));
        addBefore(IdRange{first, i});
        continue;
      }
      const TriangleId past = now_.pastOthers(next, last);
      const size_t first = other;
      i = placeOf(before, i, past);
      other = placeOf(others, other, past);
      if (first < other) addOther(IdRange{first, other});
    }
  }

  VertexId idNow(VertexId other) const { return other < firstOther_ ? other : otherIds_[other.number - firstOther_.number]; }

  /// Of lists whose triangles are in one of their own: add(of whom, places, id now of their vertices).
  template <class Add>
  void joinTagged(std::vector<TriangleId> ClippedTriangles::*triangles, const Add& add) {
    const auto addFrom = [&](const ClippedTriangles& from, const IdRange& range, const auto& id) {
      append(from.*triangles, range, all_.*triangles);
      add(from, range, id);
    };
    join(
        before_.*triangles, others_.*triangles, [](TriangleId t) { return t; },
        [&](const IdRange& range) { addFrom(before_, range, [&](VertexId v) { return now_[v]; }); },
        [&](const IdRange& range) { addFrom(others_, range, [&](VertexId v) { return idNow(v); }); });
  }

  void joinParts() {
    all_.parts.reserve(before_.parts.size() + others_.parts.size());
    all_.pieces.offsets.reserve(before_.pieces.offsets.size() + others_.pieces.offsets.size());
    all_.pieces.items.reserve(before_.pieces.items.size() + others_.pieces.items.size());
    join(
        before_.parts, others_.parts, [](const ClippedTriangles::Part& part) { return part.triangle; },
        [&](const IdRange& range) { addParts(before_, range, [&](VertexId v) { return now_[v]; }); },
        [&](const IdRange& range) { addParts(others_, range, [&](VertexId v) { return idNow(v); }); });
  }
  /// All parts of some triangles, whose pieces follow each other.
  template <class IdNow>
  void addParts(const ClippedTriangles& from, const IdRange& range, const IdNow& id) {
    const size_t at = all_.parts.size();
    append(from.parts, range, all_.parts);
    std::optional<uint32_t> first;
    uint32_t past = 0;
    for (ClippedTriangles::Part& part : std::span(all_.parts).subspan(at)) {
      if (part.piece == ClippedTriangles::kWhole) continue;
      if (!first) first = part.piece;
      past = part.piece + 1;
      part.piece += uint32_t(all_.pieces.size()) - *first;
    }
    if (!first) return;
    const std::vector<uint32_t>& offsets = from.pieces.offsets;
    const uint32_t shift = all_.pieces.offsets.back() - offsets[*first];
    for (uint32_t piece = *first; piece < past; ++piece) all_.pieces.offsets.push_back(offsets[piece + 1] + shift);
    const size_t count = offsets[past] - offsets[*first], end = all_.pieces.items.size();
    all_.pieces.items.resize(end + count);
    const Corner* const corners = from.pieces.items.data() + offsets[*first];
    std::transform(corners, corners + count, all_.pieces.items.data() + end, [&](const Corner& c) { return Corner{id(c.id), c.slab}; });
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

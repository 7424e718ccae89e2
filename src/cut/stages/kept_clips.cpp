#include "cut/stages/kept_clips.h"

#include "base/sort.h"

namespace mandoline::detail {
namespace {

/// Joins what is known of triangles that are the same with what others gave. All lists ascend by triangle.
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

  /// The others, with ids of all.
  void renumberOthers(ClippedTriangles& others) const {
    const auto renumber = [&](VertexId& v) { v = idNow(v); };
    for (Corner& c : others.pieces.items) renumber(c.id);
    for (FaceEdge& edge : others.hybridEdges) {
      renumber(edge.from);
      renumber(edge.to);
    }
    for (VertexId& v : others.seamVertices) renumber(v);
  }

  /// Once `now` has the vertices, and the others are renumbered.
  ClippedTriangles joinRest(ClippedAgain again, const CutVertices& vertices) {
    renumberAgain(again, vertices);
    joinParts(again.clipped);
    const size_t edges = again.clipped.hybridEdges.size() + others_.hybridEdges.size();
    all_.hybridEdges.reserve(edges);
    all_.hybridTriangles.reserve(edges);
    const auto addEdges = [&](const ClippedTriangles& from, const IdRange& range) {
      append(from.hybridEdges, range, all_.hybridEdges);
      append(from.hybridTriangles, range, all_.hybridTriangles);
    };
    join(
        again.clipped.hybridTriangles, others_.hybridTriangles, [](TriangleId t) { return t; },
        [&](const IdRange& range) { addEdges(again.clipped, range); }, [&](const IdRange& range) { addEdges(others_, range); });
    joinSeams();
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

  void renumberAgain(ClippedAgain& again, const CutVertices& vertices) const {
    const std::vector<TriangleId>& all = vertices.parentTriangles;
    std::vector<VertexId> ids;
    auto at = all.begin();
    for (const TriangleId parent : again.parents) {
      at = partitionPointAhead(at, all.end(), [&](TriangleId t) { return t < parent; });
      ids.push_back({vertices.firstInTriangle.number + uint32_t(at++ - all.begin())});
    }
    const uint32_t first = uint32_t(vertices.size());
    const auto renumber = [&](VertexId& v) {
      if (v.number >= first) v = ids[v.number - first];
    };
    for (Corner& c : again.clipped.pieces.items) renumber(c.id);
    for (FaceEdge& edge : again.clipped.hybridEdges) {
      renumber(edge.from);
      renumber(edge.to);
    }
  }

  /// Of all triangles: a brick may have a vertex on its seams without a part of the triangle.
  void joinSeams() {
    join(
        before_.seamTriangles, others_.seamTriangles, [](TriangleId t) { return t; },
        [&](const IdRange& range) {
          append(before_.seamTriangles, range, all_.seamTriangles);
          for (size_t i = range.begin; i < range.end; ++i) all_.seamVertices.push_back(now_[before_.seamVertices[i]]);
        },
        [&](const IdRange& range) {
          append(others_.seamTriangles, range, all_.seamTriangles);
          append(others_.seamVertices, range, all_.seamVertices);
        });
  }

  /// Pieces need not be in the order of parts.
  void joinParts(ClippedTriangles& again) {
    all_.pieces = std::move(again.pieces);
    const uint32_t shift = uint32_t(all_.pieces.size());
    all_.pieces.append(others_.pieces);
    all_.parts.reserve(again.parts.size() + others_.parts.size());
    join(
        again.parts, others_.parts, [](const ClippedTriangles::Part& part) { return part.triangle; },
        [&](const IdRange& range) { append(again.parts, range, all_.parts); },
        [&](const IdRange& range) {
          for (ClippedTriangles::Part part : std::span(others_.parts).subspan(range.begin, range.size())) {
            if (part.piece != ClippedTriangles::kWhole) part.piece += shift;
            all_.parts.push_back(part);
          }
        });
  }

  const ClippedTriangles &before_, &others_;
  const SurfaceMap& now_;
  VertexId firstOther_{0};
  std::vector<VertexId> otherIds_;  // now, of the others' vertices in triangles
  ClippedTriangles all_;
};

}  // namespace

void ClipsBefore::addTo(ClippedTriangles& others, Surface& surface, const BrickGrid& grid, Run& run) {
  if (!now_.areEdgesSame()) return now_.mapInTriangles();
  ClipJoiner joiner(clipped_, others, now_);
  joiner.joinVertices(surface_.vertices, surface.vertices);
  now_.mapInTriangles();
  joiner.renumberOthers(others);
  changed_.emplace(surface_, clipped_, bricks_, now_);
  changed_->addOf(others, surface);
  others = joiner.joinRest(clipAgain(surface, grid, changed_->trianglesAtRest(), run), surface.vertices);
}

}  // namespace mandoline::detail

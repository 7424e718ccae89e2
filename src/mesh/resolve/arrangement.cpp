#include "mesh/resolve/arrangement.h"

#include <algorithm>

#include "base/sort.h"
#include "mesh/resolve/contacts.h"
#include "mesh/resolve/equal_points.h"
#include "mesh/resolve/exact_points.h"
#include "mesh/resolve/segments.h"

namespace mandoline::detail {
namespace {

/// Something of a triangle or of an edge, before it is grouped.
struct OfTriangle {
  uint32_t triangle, item;
  auto operator<=>(const OfTriangle&) const = default;
};
struct OfEdge {
  PointKey::Edge edge;
  uint32_t point;
  bool operator==(const OfEdge&) const = default;
  bool operator<(const OfEdge& other) const { return edge != other.edge ? edge < other.edge : point < other.point; }
};

Csr<uint32_t> groupByTriangle(size_t triangles, std::vector<OfTriangle> items) {
  sortUnique(items);
  return groupBy<uint32_t>(
      triangles, items.size(), [&](size_t i) { return items[i].triangle; }, [&](size_t i) { return items[i].item; });
}

class Arranger {
 public:
  Arranger(const WeldedMesh& mesh, Monitor& monitor, Predicates& predicates)
      : mesh_(mesh), monitor_(monitor), predicates_(predicates), result_(mesh) {}

  Arrangement run(const Contacts& contacts) {
    result_.pairs = contacts.counts;
    if (contacts.pairs.empty()) {
      result_.sides = mesh_.stitches;
      return std::move(result_);
    }
    addContactPoints(contacts.pairs);
    for (const PairContact& pair : contacts.pairs) {
      takeApart(pair, 0);
      takeApart(pair, 1);
    }
    crossSegments();
    sortUnique(metVertices_);
    placeOf_ = findEqualPoints(result_.points, metVertices_, predicates_);
    makeInnerEdges();
    result_.curves = countCurves(result_.innerEdges.items, result_.points.size());
    makeSides();
    sortMadeEdges();
    return std::move(result_);
  }

 private:
  /// Makes points of keys, ascending, that have none yet.
  void addPoints(std::vector<PointKey> keys) {
    sortUnique(keys);
    const uint32_t first = result_.points.size();
    std::vector<std::pair<PointKey, uint32_t>> added;
    for (const PointKey& key : keys) {
      if (key.kind == PointKey::Kind::vertex || find(key)) continue;
      added.push_back({key, result_.points.add(key)});
    }
    const auto chunks =
        forChunks<Predicates>(result_.points.size() - first, monitor_, [&](Predicates& predicates, size_t begin, size_t end) {
          for (size_t i = begin; i < end; ++i) result_.points.place(first + uint32_t(i), predicates);
        });
    for (const Predicates& p : chunks) predicates_.fallbacks += p.fallbacks;
    ids_.insert(ids_.end(), added.begin(), added.end());
    sortItems(ids_);
  }
  const uint32_t* find(const PointKey& key) const {
    const auto at = std::lower_bound(ids_.begin(), ids_.end(), key, [](const auto& entry, const PointKey& k) { return entry.first < k; });
    return at != ids_.end() && at->first == key ? &at->second : nullptr;
  }
  uint32_t idOf(const PointKey& key) const { return key.kind == PointKey::Kind::vertex ? key.ids[0] : *find(key); }

  void addContactPoints(const std::vector<PairContact>& pairs) {
    for (const Stitch& stitch : mesh_.stitches) metVertices_.insert(metVertices_.end(), stitch.vertices.begin(), stitch.vertices.end());
    std::vector<PointKey> keys;
    for (const PairContact& pair : pairs) {
      for (int i = 0; i < pair.contact.count; ++i) {
        const PointKey& key = pair.contact.corners[size_t(i)].key;
        if (key.kind == PointKey::Kind::vertex) {
          metVertices_.push_back(key.ids[0]);
        } else {
          keys.push_back(key);
        }
      }
    }
    addPoints(std::move(keys));
  }

  /// What a contact leaves in one of its triangles.
  void takeApart(const PairContact& pair, size_t which) {
    const uint32_t triangle = pair.triangles[which], other = pair.triangles[1 - which];
    const Contact& contact = pair.contact;
    for (int i = 0; i < contact.count; ++i) {
      const auto& [key, places] = contact.corners[size_t(i)];
      if (places[which].isSide()) onEdges_.push_back({mesh_.edgeOf(triangle, places[which].index()), idOf(key)});
    }
    if (contact.hasArea()) {
      overlaps_.push_back({triangle, other});
      for (int side = 0; side < 3; ++side) addSideOfOther(contact, which, triangle, mesh_.edgeOf(other, side), side);
    } else if (contact.count == 1) {
      if (contact.corners[0].places[which].isInside()) isolated_.push_back({triangle, idOf(contact.corners[0].key)});
    } else {
      const int along = contact.alongSide(int(1 - which));
      const PointKey::Edge edge = along < 0 ? PointKey::Edge{triangle, other} : mesh_.edgeOf(other, along);
      addSegment(triangle, {&contact.corners[0], &contact.corners[1]}, which, {edge[0], edge[1], along < 0});
    }
  }

  /// The part of a side of the other triangle that lies in this one, whose plane is the same.
  void addSideOfOther(const Contact& contact, size_t which, uint32_t triangle, const PointKey::Edge& edge, int side) {
    std::array<const Contact::Corner*, 2> ends{};
    size_t count = 0;
    for (int i = 0; i < contact.count; ++i) {
      const Contact::Corner& corner = contact.corners[size_t(i)];
      if (corner.places[1 - which].onSide(side) && count < 2) ends[count++] = &corner;
    }
    if (count < 2) {
      if (count == 1 && ends[0]->places[which].isInside()) isolated_.push_back({triangle, idOf(ends[0]->key)});
      return;
    }
    addSegment(triangle, ends, which, {edge[0], edge[1], false});
  }

  /// A segment between two corners of a contact, unless it lies along a side of the triangle.
  void addSegment(uint32_t triangle, const std::array<const Contact::Corner*, 2>& ends, size_t which, const Line& line) {
    const std::vector<uint32_t> stitched = stitchedBetween(line, {idOf(ends[0]->key), idOf(ends[1]->key)});
    for (int mine = 0; mine < 3; ++mine) {
      if (!ends[0]->places[which].onSide(mine) || !ends[1]->places[which].onSide(mine)) continue;
      for (const uint32_t v : stitched) onEdges_.push_back({mesh_.edgeOf(triangle, mine), v});
      return;
    }
    for (const uint32_t v : stitched) touches_.push_back({uint32_t(segments_.size()), v});
    segments_.push_back(
        {triangle, {idOf(ends[0]->key), idOf(ends[1]->key)}, {ends[0]->places[which].isInside(), ends[1]->places[which].isInside()}, line});
  }

  /// The vertices that stitching has put on an edge, between two points of it.
  std::vector<uint32_t> stitchedBetween(const Line& line, const std::array<uint32_t, 2>& ends) {
    std::vector<uint32_t> between;
    const Stitch* stitch = line.ofPlanes ? nullptr : mesh_.findStitch(line.a, line.b);
    if (!stitch) return between;
    const MeshPoints& points = result_.points;
    const int axis = axisAlong(points, ends[0], ends[1], predicates_);
    for (const uint32_t v : stitch->vertices) {
      const int way = points.compare(ends[0], v, axis, predicates_);
      if (way != 0 && way == points.compare(v, ends[1], axis, predicates_)) between.push_back(v);
    }
    return between;
  }

  /// Finds where segments of one triangle meet: fills touches_.
  void crossSegments() {
    const size_t triangles = mesh_.triangles.size();
    bySegment_ = groupBy<uint32_t>(
        triangles, segments_.size(), [&](size_t i) { return segments_[i].triangle; }, [](size_t i) { return uint32_t(i); });
    const Csr<uint32_t> isolated = groupByTriangle(triangles, isolated_);
    std::vector<uint32_t> several;
    for (uint32_t t = 0; t < triangles; ++t) {
      if (bySegment_[t].size() + isolated[t].size() > 1) several.push_back(t);
    }
    struct Chunk {
      std::vector<PointOnSegment> touches;
      std::vector<Crossing> crossings;
      uint64_t fallbacks = 0;
    };
    const auto chunks = forChunks<Chunk>(
        several.size(), monitor_,
        [&](Chunk& chunk, size_t begin, size_t end) {
          SegmentCrosser crosser(mesh_, result_.points, segments_);
          for (size_t i = begin; i < end; ++i) crosser.cross(several[i], bySegment_[several[i]], isolated[several[i]]);
          chunk.touches.insert(chunk.touches.end(), crosser.touches.begin(), crosser.touches.end());
          chunk.crossings.insert(chunk.crossings.end(), crosser.crossings.begin(), crosser.crossings.end());
          chunk.fallbacks += crosser.predicates.fallbacks;
        },
        64);
    std::vector<PointKey> keys;
    for (const Chunk& chunk : chunks) {
      predicates_.fallbacks += chunk.fallbacks;
      touches_.insert(touches_.end(), chunk.touches.begin(), chunk.touches.end());
      for (const Crossing& c : chunk.crossings) keys.push_back(c.key);
    }
    addPoints(std::move(keys));
    for (const Chunk& chunk : chunks) {
      for (const Crossing& c : chunk.crossings) {
        for (const uint32_t s : c.segments) touches_.push_back({s, idOf(c.key)});
      }
    }
  }

  /// Sorts points of a line along it from u to v, and drops those that are at one place.
  void sortAlong(uint32_t u, uint32_t v, int axis, std::vector<uint32_t>& chain) {
    for (uint32_t& p : chain) p = placeOf_[p];
    sortUnique(chain);
    const int way = result_.points.compare(u, v, axis, predicates_);
    ExactPoints exact(result_.points, chain, predicates_);
    std::vector<uint32_t> sorted;
    for (const size_t i : exact.sorted([&](size_t j, size_t k) { return exact.compare(j, k, axis) == way; })) sorted.push_back(chain[i]);
    chain = std::move(sorted);
  }

  /// Whether a line runs from the lower to the higher coordinate along an axis.
  bool ascends(const Line& line, int axis) {
    return predicates_.sign([&](auto number) { return line.direction<decltype(number)>(mesh_).x[axis]; }) > 0;
  }

  /// Adds the made edges among those of a chain that ascends along an axis if `up`.
  void addMadeEdges(const std::vector<uint32_t>& chain, bool up, int axis, const Line& line) {
    int lineUp = -1;
    for (size_t i = 1; i < chain.size(); ++i) {
      if (!result_.points.isMade(chain[i - 1]) && !result_.points.isMade(chain[i])) continue;
      if (lineUp < 0) lineUp = ascends(line, axis);
      const bool sameWay = (up == (chain[i - 1] < chain[i])) == (lineUp == 1);
      Line directed = line;
      if (!sameWay) std::swap(directed.a, directed.b);
      const auto [low, high] = std::minmax(chain[i - 1], chain[i]);
      result_.madeEdges.push_back({low, high, directed});
    }
  }

  void makeInnerEdges() {
    sortItems(touches_, [](const PointOnSegment& a, const PointOnSegment& b) { return a.segment < b.segment; });
    struct Inner {
      uint32_t triangle;
      InnerEdge edge;
      auto operator<=>(const Inner&) const = default;
    };
    std::vector<Inner> edges;
    std::vector<OfTriangle> vertices;
    for (const auto& [triangle, v] : isolated_) vertices.push_back({triangle, placeOf_[v]});
    std::vector<uint32_t> chain;
    for (size_t s = 0, at = 0; s < segments_.size(); ++s) {
      const Segment& segment = segments_[s];
      const uint32_t first = placeOf_[segment.ends[0]], last = placeOf_[segment.ends[1]];
      chain.assign({first, last});
      for (; at < touches_.size() && touches_[at].segment == s; ++at) chain.push_back(touches_[at].point);
      const int axis = axisAlong(result_.points, first, last, predicates_);
      sortAlong(first, last, axis, chain);
      for (size_t i = 0; i < chain.size(); ++i) {
        const bool inside = chain[i] == first ? segment.inside[0] : chain[i] == last ? segment.inside[1] : true;
        if (inside) vertices.push_back({segment.triangle, chain[i]});
        if (i > 0) edges.push_back({segment.triangle, {std::min(chain[i - 1], chain[i]), std::max(chain[i - 1], chain[i])}});
      }
      addMadeEdges(chain, result_.points.compare(first, last, axis, predicates_) < 0, axis, segment.line);
    }
    sortUnique(edges);
    const size_t triangles = mesh_.triangles.size();
    result_.innerEdges = groupBy<InnerEdge>(
        triangles, edges.size(), [&](size_t i) { return edges[i].triangle; }, [&](size_t i) { return edges[i].edge; });
    result_.innerVertices = groupByTriangle(triangles, std::move(vertices));
    result_.overlaps = groupByTriangle(triangles, overlaps_);
  }

  /// The sides with vertices inside: those of stitching, and points of contacts.
  void makeSides() {
    for (const Stitch& stitch : mesh_.stitches) {
      for (const uint32_t v : stitch.vertices) onEdges_.push_back({{stitch.low, stitch.high}, v});
    }
    sortUnique(onEdges_);
    std::vector<uint32_t> chain;
    for (size_t i = 0, end; i < onEdges_.size(); i = end) {
      const auto [low, high] = onEdges_[i].edge;
      chain.assign({low, high});
      for (end = i; end < onEdges_.size() && onEdges_[end].edge == onEdges_[i].edge; ++end) chain.push_back(onEdges_[end].point);
      const int axis = axisAlong(result_.points, low, high, predicates_);
      sortAlong(low, high, axis, chain);
      addMadeEdges(chain, result_.points.compare(low, high, axis, predicates_) < 0, axis, {low, high, false});
      result_.sides.push_back({low, high, {chain.begin() + 1, chain.end() - 1}});
    }
  }

  /// One line for each made edge: that of a side if there is one.
  void sortMadeEdges() {
    const auto key = [](const MadeEdge& e) { return std::array<uint32_t, 5>{e.low, e.high, e.line.ofPlanes, e.line.a, e.line.b}; };
    std::vector<MadeEdge>& edges = result_.madeEdges;
    sortItems(edges, [&](const MadeEdge& a, const MadeEdge& b) { return key(a) < key(b); });
    const auto same = [](const MadeEdge& a, const MadeEdge& b) { return a.low == b.low && a.high == b.high; };
    edges.erase(std::unique(edges.begin(), edges.end(), same), edges.end());
  }

  const WeldedMesh& mesh_;
  Monitor& monitor_;
  Predicates& predicates_;
  Arrangement result_;
  std::vector<std::pair<PointKey, uint32_t>> ids_;  // by key
  std::vector<uint32_t> metVertices_;               // tri-vertices that bound a contact, or that stitching has put on an edge
  std::vector<Segment> segments_;
  Csr<uint32_t> bySegment_;  // per triangle
  std::vector<OfTriangle> isolated_, overlaps_;
  std::vector<OfEdge> onEdges_;
  std::vector<PointOnSegment> touches_;
  std::vector<uint32_t> placeOf_;  // per point: the lowest one at its place
};

}  // namespace

const MadeEdge* Arrangement::findMade(uint32_t low, uint32_t high) const {
  const auto at = std::lower_bound(madeEdges.begin(), madeEdges.end(), std::array<uint32_t, 2>{low, high},
                                   [](const MadeEdge& e, const auto& ends) { return e.ends() < ends; });
  return at != madeEdges.end() && at->low == low && at->high == high ? &*at : nullptr;
}

Arrangement arrange(const WeldedMesh& mesh, const Contacts& contacts, Monitor& monitor, Predicates& predicates) {
  return Arranger(mesh, monitor, predicates).run(contacts);
}

}  // namespace mandoline::detail

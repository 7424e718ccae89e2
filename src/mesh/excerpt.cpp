#include "mesh/excerpt.h"

#include <algorithm>
#include <utility>

#include "base/csr.h"
#include "base/sort.h"
#include "mesh/resolve/arrangement.h"

namespace mandoline::detail {
namespace {

/// Places with ids of the whole mesh, until these are known to be all.
class References {
 public:
  void add(uint32_t& id) {
    if (!places_.empty() && places_.back().data() + places_.back().size() == &id)
      places_.back() = {places_.back().data(), places_.back().size() + 1};
    else
      places_.push_back({&id, 1});
  }
  template <class Items>
  void addAll(Items& ids) {
    for (auto& id : ids) {
      if constexpr (requires { id.number; }) {
        add(id.number);
      } else {
        add(id);
      }
    }
  }

  /// Puts numbers in order in place of the ids. Gives the ids, ascending.
  std::vector<uint32_t> number() {
    size_t count = 0;
    uint32_t past = 0;
    forAll([&](uint32_t id) {
      past = std::max(past, id + 1);
      ++count;
    });
    constexpr uint32_t kMany = 8;
    return past / kMany < count ? numberByTable(past) : numberBySorting(past);
  }

 private:
  template <class F>
  void forAll(const F& f) {
    for (const std::span<uint32_t>& some : places_) {
      for (uint32_t& id : some) f(id);
    }
  }
  /// For many of the ids below `past`.
  std::vector<uint32_t> numberByTable(uint32_t past) {
    std::vector<uint32_t> ids, numbers(past, 0);
    forAll([&](uint32_t id) { numbers[id] = 1; });
    for (uint32_t id = 0; id < past; ++id) {
      if (std::exchange(numbers[id], uint32_t(ids.size()))) ids.push_back(id);
    }
    forAll([&](uint32_t& id) { id = numbers[id]; });
    return ids;
  }
  std::vector<uint32_t> numberBySorting(uint32_t past) {
    std::vector<uint32_t*> places;
    std::vector<KeyedItem> uses;
    forAll([&](uint32_t& id) {
      uses.push_back({id, uint32_t(places.size())});
      places.push_back(&id);
    });
    sortByKey(uses, past);
    std::vector<uint32_t> ids;
    for (const auto& [id, place] : uses) {
      if (ids.empty() || ids.back() != id) ids.push_back(uint32_t(id));
      *places[place] = uint32_t(ids.size() - 1);
    }
    return ids;
  }

  std::vector<std::span<uint32_t>> places_;
};

constexpr uint32_t kNone = ~0u;

/// Appends a copy of a group, or an empty one for kNone.
template <class Item, class Group>
void copyGroup(const Csr<Item, Group>& from, uint32_t group, Csr<Item, Group>& to) {
  if (group < from.size()) {
    const std::span<const Item> items = from[Group{group}];
    to.items.insert(to.items.end(), items.begin(), items.end());
  }
  to.endGroup();
}

class ExcerptMaker {
 public:
  ExcerptMaker(const Prepared& whole, std::span<const uint32_t> kept, Excerpt& out)
      : whole_(whole), kept_(kept), out_(out), mesh_(out.mesh), edges_(out.mesh.edges) {}

  void run() {
    mesh_.shift = whole_.shift;
    mesh_.closed = whole_.closed;
    mesh_.oriented = whole_.oriented;
    mesh_.parts.counts = whole_.parts.counts;
    listMembers();
    std::vector<uint32_t> triangles = members_;
    if (whole_.hasIntersections()) {
      findMade();
      triangles.insert(triangles.end(), namedTriangles_.begin(), namedTriangles_.end());
      sortUnique(triangles);
    }
    for (const uint32_t t : triangles) copyTriangle(t);
    numberEdges();
    numberTriangles(std::move(triangles));
    numberVertices();
  }

 private:
  bool isMember(uint32_t t) const { return std::binary_search(members_.begin(), members_.end(), t); }

  /// Members come with their tri-edges: duplicates, and triangles that share an area, too.
  void listMembers() {
    members_.assign(kept_.begin(), kept_.end());
    for (const uint32_t t : kept_) {
      for (const Duplicate& d : whole_.duplicatesOf({t})) {
        mesh_.duplicates.push_back(d);
        members_.push_back(d.triangle);
      }
      if (!whole_.hasIntersections()) continue;
      const auto overlaps = whole_.arrangement->overlaps[t];
      members_.insert(members_.end(), overlaps.begin(), overlaps.end());
    }
    if (members_.size() > kept_.size()) sortUnique(members_);
  }

  /// The made vertices of members, and the triangles in whose planes these and tri-edges lie.
  void findMade() {
    const auto add = [&](uint32_t v) {
      if (v >= whole_.triVertices) made_.push_back(v);
    };
    for (const uint32_t t : members_) {
      for (const uint32_t v : whole_.arrangement->innerVertices[t]) add(v);
      whole_.edges.forTriangle({t}, [&](TriEdgeId e) {
        for (const VertexId v : whole_.edges.ends[e]) add(v.number);
        const Line line = whole_.edges.line(e);
        if (line.ofPlanes) namedTriangles_.insert(namedTriangles_.end(), {line.a, line.b});
      });
    }
    sortUnique(made_);
    for (const uint32_t v : made_) {
      keys_.push_back(whole_.arrangement->points.key(v));
      forTriangles(keys_.back(), [&](uint32_t t) { namedTriangles_.push_back(t); });
    }
  }

  // What a key names.
  template <class F>
  static void forTriangles(PointKey& key, const F& f) {
    if (key.kind == PointKey::Kind::edgeTriangle) f(key.ids[2]);
    for (size_t i = 0; i < 3 && key.kind == PointKey::Kind::triangles; ++i) f(key.ids[i]);
  }
  template <class F>
  static void forVertices(PointKey& key, const F& f) {
    const size_t count = key.kind == PointKey::Kind::edgeTriangle ? 2 : key.kind == PointKey::Kind::edgeEdge ? 4 : 0;
    for (size_t i = 0; i < count; ++i) f(key.ids[i]);
  }

  void copyTriangle(uint32_t t) {
    const TriangleState state = whole_.states[t];
    const bool isKept = std::binary_search(kept_.begin(), kept_.end(), t);
    const uint32_t member = isKept || isMember(t) ? t : kNone;
    mesh_.triangles.push_back(whole_.triangles[t]);
    mesh_.states.push_back(state == TriangleState::kept && !isKept ? TriangleState::beside : state);
    if (!whole_.parts.kinds.empty()) mesh_.parts.kinds.push_back(whole_.parts.kinds[t]);
    for (size_t side = 0; side < 3; ++side) {
      const uint32_t edge = member == kNone ? kNone : whole_.edges.sideEdges[3 * size_t(t) + side];
      if (edge < MeshEdges::kStitched || edge == kNone) {
        edges_.sideEdges.push_back(edge);
      } else {
        edges_.sideEdges.push_back(MeshEdges::kStitched + uint32_t(edges_.stitched.size()));
        copyGroup(whole_.edges.stitched, edge - MeshEdges::kStitched, edges_.stitched);
      }
    }
    if (!whole_.hasIntersections()) return;
    if (whole_.edges.inner.size() > 0) copyGroup(whole_.edges.inner, member, edges_.inner);
    copyGroup(whole_.arrangement->innerVertices, member, innerVertices_);
    copyGroup(whole_.arrangement->innerEdges, member, innerEdges_);
    copyGroup(whole_.arrangement->overlaps, isKept ? t : kNone, overlaps_);
  }

  void numberEdges() {
    References references;
    for (uint32_t& edge : edges_.sideEdges) {
      if (edge < MeshEdges::kStitched) references.add(edge);
    }
    references.addAll(edges_.stitched.items);
    references.addAll(edges_.inner.items);
    out_.edges = references.number();
    for (const uint32_t e : out_.edges) {
      edges_.ends.push_back(whole_.edges.ends[{e}]);
      if (!whole_.edges.lines.empty()) edges_.lines.push_back(whole_.edges.lines[{e}]);
    }
  }

  void numberTriangles(std::vector<uint32_t> triangles) {
    References references;
    references.addAll(triangles);
    for (Duplicate& d : mesh_.duplicates) {
      references.add(d.original);
      references.add(d.triangle);
    }
    for (Line& line : edges_.lines) {
      if (!line.ofPlanes) continue;
      references.add(line.a);
      references.add(line.b);
    }
    references.addAll(overlaps_.items);
    for (PointKey& key : keys_) forTriangles(key, [&](uint32_t& t) { references.add(t); });
    out_.triangles = references.number();
  }

  void numberVertices() {
    References references;
    for (auto& triangle : mesh_.triangles) references.addAll(triangle);
    for (auto& ends : edges_.ends) references.addAll(ends);
    for (Line& line : edges_.lines) {
      if (line.ofPlanes) continue;
      references.add(line.a);
      references.add(line.b);
    }
    std::vector<uint32_t> made = made_;
    references.addAll(made);
    references.addAll(innerVertices_.items);
    for (InnerEdge& e : innerEdges_.items) {
      references.add(e.low);
      references.add(e.high);
    }
    for (PointKey& key : keys_) forVertices(key, [&](uint32_t& v) { references.add(v); });
    out_.vertices = references.number();
    for (const uint32_t v : out_.vertices) {
      if (v < whole_.triVertices) mesh_.points.push_back(whole_.points[v]);
    }
    mesh_.triVertices = uint32_t(mesh_.points.size());
    if (whole_.arrangement) takeArrangement();
  }

  void takeArrangement() {
    auto arrangement = std::make_unique<Arrangement>(mesh_);
    arrangement->pairs = whole_.arrangement->pairs;
    arrangement->innerEdges = std::move(innerEdges_);
    arrangement->innerVertices = std::move(innerVertices_);
    arrangement->overlaps = std::move(overlaps_);
    for (size_t i = 0; i < made_.size(); ++i) {
      arrangement->points.addSame(whole_.arrangement->points, made_[i], keys_[i]);
      mesh_.points.push_back(whole_.points[made_[i]]);
    }
    mesh_.arrangement = std::move(arrangement);
  }

  const Prepared& whole_;
  const std::span<const uint32_t> kept_;
  Excerpt& out_;
  Prepared& mesh_;
  MeshEdges& edges_;
  std::vector<uint32_t> members_;
  std::vector<uint32_t> namedTriangles_;  // of which only the planes matter
  std::vector<uint32_t> made_;            // vertices, ascending
  std::vector<PointKey> keys_;            // of these
  Csr<uint32_t> innerVertices_, overlaps_;
  Csr<InnerEdge> innerEdges_;
};

}  // namespace

Excerpt::Excerpt(const Prepared& whole, std::span<const uint32_t> kept) { ExcerptMaker(whole, kept, *this).run(); }

}  // namespace mandoline::detail

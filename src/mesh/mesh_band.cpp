#include "mesh/mesh_band.h"

#include <algorithm>
#include <cmath>

#include "base/disjoint_sets.h"
#include "base/position_table.h"
#include "base/sort.h"

namespace mandoline::detail {
namespace {

struct PositionOf {
  const double* positions;

  const double* operator()(uint32_t v) const { return positions + 3 * size_t(v); }
};
using Places = PositionTable<PositionOf>;

class BandMaker {
 public:
  BandMaker(const MeshView& mesh, CheckedMesh checked, const Band& band)
      : mesh_(mesh), at_{mesh.positions.data()}, marks_(std::move(checked.referenced)), scale_(checked.shift) {
    out_->band = band;
    out_->mesh.shift = checked.shift;
  }

  std::unique_ptr<MeshBand> make() {
    listWithin();
    const Places within = markEqual(kWithin);
    listAll();
    const Places beside = markEqual(kBeside);
    numberVertices(within, beside);
    takeTriangles();
    return std::move(out_);
  }

 private:
  enum Mark : uint8_t { kReferenced = 1, kBeside, kWithin };

  double height(uint32_t v) const {
    uint32_t ignored = 0;
    return scale_.scaled(mesh_.positions[3 * size_t(v) + 2], ignored);
  }

  void listWithin() {
    for (size_t t = 0; t < mesh_.triangleCount(); ++t) {
      const uint32_t* v = &mesh_.triangles[3 * t];
      const double a = height(v[0]), b = height(v[1]), c = height(v[2]);
      if (!out_->band.reaches(std::min({a, b, c}), std::max({a, b, c}))) continue;
      out_->triangles.push_back(uint32_t(t));
      for (size_t i = 0; i < 3; ++i) marks_[v[i]] = kWithin;
    }
  }

  /// Adds those beside, and marks their vertices.
  void listAll() {
    const std::vector<uint32_t> within = std::move(out_->triangles);
    out_->triangles = {};
    for (uint32_t t = 0, at = 0; t < mesh_.triangleCount(); ++t) {
      const bool isWithin = at < within.size() && within[at] == t;
      at += isWithin;
      const uint32_t* v = &mesh_.triangles[3 * size_t(t)];
      if (marks_[v[0]] != kWithin && marks_[v[1]] != kWithin && marks_[v[2]] != kWithin) continue;
      out_->triangles.push_back(t);
      out_->isWithin.push_back(isWithin);
      for (size_t i = 0; i < 3; ++i) marks_[v[i]] = std::max(marks_[v[i]], uint8_t(kBeside));
    }
  }

  /// Marks the other vertices at the positions of marked ones, and gives the lowest vertices there.
  Places markEqual(Mark mark) {
    Box box = Box::empty();
    size_t count = 0;
    const auto pointOf = [&](uint32_t v) { return Point{at_(v)[0], at_(v)[1], at_(v)[2]}; };
    for (uint32_t v = 0; v < marks_.size(); ++v) {
      if (marks_[v] != mark) continue;
      box.include({pointOf(v), pointOf(v)});
      ++count;
    }
    Places places(count, at_);
    for (uint32_t v = 0; v < marks_.size(); ++v) {
      if (marks_[v] != mark) continue;
      uint32_t& lowest = places.find(at_(v));
      lowest = std::min(lowest, v);
    }
    for (uint32_t v = 0; v < marks_.size(); ++v) {
      if (marks_[v] != kReferenced || !box.overlaps({pointOf(v), pointOf(v)})) continue;
      uint32_t& lowest = places.find(at_(v));
      if (lowest == Places::kFree) continue;
      lowest = std::min(lowest, v);
      marks_[v] = mark;
    }
    return places;
  }

  void numberVertices(Places within, Places beside) {
    Prepared& mesh = out_->mesh;
    numbers_.resize(marks_.size());
    for (uint32_t v = 0; v < marks_.size(); ++v) {
      if (marks_[v] < kBeside) continue;
      const bool isWithin = marks_[v] == kWithin;
      const uint32_t lowest = (isWithin ? within : beside).find(at_(v));
      if (lowest != v) {
        numbers_[v] = numbers_[lowest];
        out_->weldedVertices += isWithin && out_->band.owns(height(v));
        continue;
      }
      numbers_[v] = uint32_t(out_->vertices.size());
      out_->vertices.push_back(v);
      out_->isComplete.push_back(isWithin);
      Point& point = mesh.points.emplace_back();
      for (size_t d = 0; d < 3; ++d) point[d] = scale_.scaled(at_(v)[d], mesh.counts.flushedCoordinates);
    }
    mesh.triVertices = uint32_t(mesh.points.size());
  }

  void takeTriangles() {
    Prepared& mesh = out_->mesh;
    mesh.states.assign(out_->triangles.size(), TriangleState::kept);
    mesh.triangles.reserve(out_->triangles.size());
    for (const uint32_t t : out_->triangles) {
      const uint32_t* v = &mesh_.triangles[3 * size_t(t)];
      mesh.triangles.push_back({numbers_[v[0]], numbers_[v[1]], numbers_[v[2]]});
    }
  }

  const MeshView& mesh_;
  const PositionOf at_;
  std::vector<uint8_t> marks_;     // per vertex of the whole
  std::vector<uint32_t> numbers_;  // likewise, where it is marked: in the band
  const Scale scale_;
  std::unique_ptr<MeshBand> out_ = std::make_unique<MeshBand>();
};

/// The triangles at a tri-edge.
struct Uses {
  uint32_t count = 0, first = 0, second = 0;
  int32_t net = 0;  ///< how many more run through it from its lower end than from its higher
};

/// Calls f(tri-edge, its uses) for those of which all triangles are here.
template <class F>
void forCompleteEdges(const MeshBand& band, const F& f) {
  const Prepared& mesh = band.mesh;
  std::vector<Uses> uses(mesh.edges.ends.size());
  for (const TriangleId t : mesh.triangleIds()) {
    for (int side = 0; side < 3; ++side) {
      mesh.edges.forSide(mesh, t, side, [&](TriEdgeId edge, bool forward) {
        Uses& use = uses[edge.number];
        if (use.count < 2) (use.count == 0 ? use.first : use.second) = t.number;
        ++use.count;
        use.net += forward ? 1 : -1;
      });
    }
  }
  for (const TriEdgeId edge : mesh.edges.ends.ids()) {
    const auto& [low, high] = mesh.edges.ends[edge];
    if (band.isComplete[low.number] || band.isComplete[high.number]) f(edge, uses[edge.number]);
  }
}

/// Numbers some ids of the whole, ascending.
class Named {
 public:
  explicit Named(std::vector<uint32_t> ids) : ids_(std::move(ids)) { sortUnique(ids_); }

  size_t size() const { return ids_.size(); }
  uint32_t operator()(uint32_t id) const { return uint32_t(std::lower_bound(ids_.begin(), ids_.end(), id) - ids_.begin()); }

 private:
  std::vector<uint32_t> ids_;
};

/// The connected sets of open edges, each of which several bands may tell.
void countOpenEdges(std::span<const BandParts> all, PartCounts& counts) {
  std::vector<std::array<uint32_t, 2>> edges;
  std::vector<uint32_t> ends;
  for (const BandParts& band : all) {
    ends.insert(ends.end(), band.openEdges.begin(), band.openEdges.end());
    for (size_t i = 0; i < band.openEdges.size(); i += 2) edges.push_back({band.openEdges[i], band.openEdges[i + 1]});
  }
  sortUnique(edges);
  const Named named(std::move(ends));
  DisjointSets chains(named.size());
  for (const auto& [low, high] : edges) chains.unite(named(low), named(high));
  counts.openEdges = uint32_t(edges.size());
  for (uint32_t v = 0; v < named.size(); ++v) counts.holes += chains.find(v) == v;
}

}  // namespace

std::unique_ptr<MeshBand> weldBand(const MeshView& mesh, CheckedMesh checked, const Band& band) {
  return BandMaker(mesh, std::move(checked), band).make();
}

bool findPlainEdges(MeshBand& band, Intersections intersections, Monitor& monitor, Predicates& predicates) {
  Prepared& mesh = band.mesh;
  if (mesh.counts.flushedCoordinates > 0) return false;  // which may bring positions together
  dropFlat(mesh, nullptr, monitor, predicates);
  if (mesh.counts.zeroAreaTriangles > 0) return false;
  std::vector<TriangleState> searched = mesh.states;
  for (size_t t = 0; t < searched.size(); ++t) {
    if (!band.isWithin[t]) searched[t] = TriangleState::beside;
  }
  return findEdgesIfPlain(mesh, searched, intersections, monitor, predicates);
}

BandEdges inspectEdges(const MeshBand& band) {
  BandEdges found;
  forCompleteEdges(band, [&](TriEdgeId edge, const Uses& uses) {
    found.closed &= uses.net == 0;
    found.oriented &= uses.count != 2 || uses.net == 0;
    found.haveAtMostTwo &= uses.count <= 2;
    if (uses.net == 0 || !band.band.owns(band.mesh.point(band.mesh.edges.ends[edge][0])[2])) return;
    found.open += uses.count == 1;
    found.inconsistent += uses.count == 2;
  });
  return found;
}

BandParts findBandParts(const MeshBand& band) {
  const Prepared& mesh = band.mesh;
  DisjointSets sets(mesh.triangles.size());
  std::vector<PartKind> kinds(mesh.triangles.size(), PartKind::winding);  // of triangles, then of sets
  BandParts parts;
  forCompleteEdges(band, [&](TriEdgeId edge, const Uses& uses) {
    PartKind& kind = kinds[uses.first];
    if (uses.count == 1) {
      kind = PartKind::open;
      for (const VertexId v : mesh.edges.ends[edge]) parts.openEdges.push_back(band.vertices[v.number]);
    } else {
      sets.unite(uses.first, uses.second);
      if (uses.net != 0) kind = std::max(kind, PartKind::parity);
    }
  });
  std::vector<uint8_t> reaches(kinds.size(), 0);  // per set: whether a triangle of it is within
  for (uint32_t t = 0; t < kinds.size(); ++t) {
    const uint32_t set = sets.find(t);
    kinds[set] = std::max(kinds[set], kinds[t]);
    reaches[set] |= band.isWithin[t];
    parts.setOf.push_back(band.triangles[set]);
  }
  for (uint32_t t = 0; t < kinds.size(); ++t) {
    if (sets.find(t) == t && reaches[t]) parts.kinds.insert(parts.kinds.end(), {band.triangles[t], uint32_t(kinds[t])});
    const Box box = boxOf(mesh, t);
    const bool isInAnother = box.low[2] <= band.band.low || box.high[2] >= band.band.high;
    if (band.isWithin[t] && isInAnother) parts.shared.insert(parts.shared.end(), {band.triangles[t], parts.setOf[t]});
  }
  return parts;
}

Parts joinParts(const MeshBand& band, const std::vector<uint32_t>& setOf, std::span<const BandParts> all) {
  std::vector<uint32_t> ids;
  for (const BandParts& one : all) {
    for (size_t i = 0; i < one.kinds.size(); i += 2) ids.push_back(one.kinds[i]);
    ids.insert(ids.end(), one.shared.begin(), one.shared.end());
  }
  const Named named(std::move(ids));
  DisjointSets sets(named.size());
  std::vector<PartKind> kinds(named.size(), PartKind::winding);
  for (const BandParts& one : all) {
    for (size_t i = 0; i < one.shared.size(); i += 2) sets.unite(named(one.shared[i]), named(one.shared[i + 1]));
  }
  for (const BandParts& one : all) {
    for (size_t i = 0; i < one.kinds.size(); i += 2) {
      PartKind& kind = kinds[sets.find(named(one.kinds[i]))];
      kind = std::max(kind, PartKind(one.kinds[i + 1]));
    }
  }
  Parts result;
  PartCounts& counts = result.counts;
  for (uint32_t set = 0; set < named.size(); ++set) {
    if (sets.find(set) != set) continue;
    ++(kinds[set] == PartKind::winding ? counts.winding : kinds[set] == PartKind::parity ? counts.parity : counts.open);
  }
  if (counts.open > 0) countOpenEdges(all, counts);
  result.kinds.assign(setOf.size(), PartKind::none);
  for (size_t t = 0; t < setOf.size(); ++t) {
    if (band.isWithin[t]) result.kinds[t] = kinds[sets.find(named(setOf[t]))];
  }
  return result;
}

}  // namespace mandoline::detail

#include "mesh/mesh_band.h"

#include <algorithm>

#include "base/disjoint_sets.h"
#include "base/sort.h"
#include "mesh/places.h"

namespace mandoline::detail {
namespace {

std::array<double, 2> rangeOf(const MeshPart& part, const std::vector<double>& heights, size_t triangle) {
  const uint32_t* v = &part.corners[3 * triangle];
  return {std::min({heights[v[0]], heights[v[1]], heights[v[2]]}), std::max({heights[v[0]], heights[v[1]], heights[v[2]]})};
}

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

/// The connected sets of open edges, each of which several bands may tell.
void countOpenEdges(std::span<const BandParts> all, PartCounts& counts) {
  std::vector<std::array<uint32_t, 2>> edges;
  std::vector<uint32_t> ends;
  for (const BandParts& band : all) {
    ends.insert(ends.end(), band.openEdges.begin(), band.openEdges.end());
    for (size_t i = 0; i < band.openEdges.size(); i += 2) edges.push_back({band.openEdges[i], band.openEdges[i + 1]});
  }
  sortUnique(edges);
  const RankedSet named = rankedIds(ends);
  DisjointSets chains(named.size());
  for (const auto& [low, high] : edges) chains.unite(named.rankOf(low), named.rankOf(high));
  counts.openEdges = uint32_t(edges.size());
  for (uint32_t v = 0; v < named.size(); ++v) counts.holes += chains.find(v) == v;
}

}  // namespace

BandFinder::BandFinder(std::span<const Band> bands) : bands_(bands) {
  for (size_t b = 0; b < bands.size(); ++b) {
    if (bands[b].low < bands[b].high) filled_.push_back(b);
  }
}

size_t BandFinder::owner(double height) const {
  return *(std::partition_point(filled_.begin(), filled_.end(), [&](size_t b) { return bands_[b].low <= height; }) - 1);
}

std::vector<double> heightsOf(const MeshPart& part, const Scale& scale) {
  std::vector<double> heights;
  heights.reserve(part.vertices.size());
  uint32_t ignored = 0;
  for (size_t v = 0; v < part.vertices.size(); ++v) heights.push_back(scale.scaled(part.positions[3 * v + 2], ignored));
  return heights;
}

std::vector<MeshPart> trianglesOfBands(const MeshPart& part, const std::vector<double>& heights, const BandFinder& finder) {
  std::vector<std::vector<uint32_t>> triangles(finder.count());
  for (size_t t = 0; t < part.triangles.size(); ++t) {
    const auto [least, greatest] = rangeOf(part, heights, t);
    finder.forReached(least, greatest, [&, id = part.triangles[t]](size_t band) { triangles[band].push_back(id); });
  }
  std::vector<MeshPart> parts;
  const NamedMesh named(part);
  for (std::vector<uint32_t>& some : triangles) parts.push_back(takePart(named, std::move(some), {}));
  return parts;
}

std::vector<std::vector<double>> positionsElsewhere(const MeshPart& part, const std::vector<double>& heights,
                                                    const std::vector<uint8_t>& asked, const BandFinder& finder, const Band& here) {
  std::vector<std::vector<double>> positions(finder.count());
  const auto isAsked = [&](uint32_t v) { return asked[v] && !here.reaches(heights[v], heights[v]); };
  Places places = placesOf(part.positions, isAsked);
  for (uint32_t v = 0; v < part.vertices.size(); ++v) {
    const double* p = &part.positions[3 * size_t(v)];
    if (!isAsked(v) || places.find(p) != v) continue;
    const size_t band = finder.owner(heights[v]);
    positions[band].insert(positions[band].end(), p, p + 3);
  }
  return positions;
}

MeshPart trianglesAt(const std::vector<double>& positions, const MeshPart& part, const std::vector<double>& heights, const Band& there) {
  if (positions.empty()) return {};
  FirstAt asked(positions);
  std::vector<uint32_t> triangles;
  for (size_t t = 0; t < part.triangles.size(); ++t) {
    const auto isAsked = [&](uint32_t v) { return asked.has(&part.positions[3 * size_t(v)]); };
    const auto [least, greatest] = rangeOf(part, heights, t);
    const uint32_t* v = &part.corners[3 * t];
    if (!there.reaches(least, greatest) && (isAsked(v[0]) || isAsked(v[1]) || isAsked(v[2]))) triangles.push_back(part.triangles[t]);
  }
  return takePart(part, std::move(triangles), {});
}

std::vector<uint32_t> lowestAt(const std::vector<double>& positions, const MeshPart& part) {
  if (positions.empty()) return {};
  FirstAt places(positions);
  for (size_t v = 0; v < part.vertices.size(); ++v) places.add(part.vertices[v], &part.positions[3 * v]);
  return places.first();
}

void findLowest(BandTriangles& triangles) {
  const MeshPart& part = triangles.part;
  const size_t count = part.vertices.size();
  std::vector<uint32_t>& lowest = triangles.lowest;
  lowest = lowestAtPosition(count, PositionOf{part.positions.data()}, [](uint32_t) { return true; });
  std::vector<uint8_t>& isComplete = triangles.isComplete;
  isComplete.assign(count, 0);
  for (size_t t = 0; t < part.triangles.size(); ++t) {
    for (size_t i = 0; i < 3 && triangles.isWithin[t]; ++i) isComplete[lowest[part.corners[3 * t + i]]] = 1;
  }
  for (size_t v = 0; v < count; ++v) {
    isComplete[v] = isComplete[lowest[v]];
    lowest[v] = part.vertices[lowest[v]];
  }
}

void takeLowest(const std::vector<double>& asked, const std::vector<uint32_t>& told, BandTriangles& triangles) {
  const MeshPart& part = triangles.part;
  Places places = placesOf(asked);
  for (size_t v = 0; v < part.vertices.size() && !told.empty(); ++v) {
    if (triangles.isComplete[v]) continue;
    const uint32_t at = places.find(&part.positions[3 * v]);
    if (at != Places::kFree) triangles.lowest[v] = told[at];
  }
}

std::unique_ptr<MeshBand> weldBand(const BandTriangles& triangles, int shift, const Band& band) {
  const MeshPart& part = triangles.part;
  const Scale scale(shift);
  auto out = std::make_unique<MeshBand>();
  Prepared& mesh = out->mesh;
  out->band = band;
  mesh.shift = shift;
  const RankedSet named = rankedIds(triangles.lowest);
  out->vertices = idsOf(named);
  out->isComplete.resize(named.size());
  mesh.points.resize(named.size());
  mesh.triVertices = uint32_t(named.size());
  const std::vector<uint8_t>& within = triangles.isComplete;
  std::vector<uint32_t> numbers;
  numbers.reserve(part.vertices.size());
  for (size_t v = 0; v < part.vertices.size(); ++v) {
    const uint32_t number = numbers.emplace_back(named.rankOf(triangles.lowest[v]));
    out->isComplete[number] = within[v];
    for (size_t d = 0; d < 3; ++d) mesh.points[number][d] = scale.scaled(part.positions[3 * v + d], mesh.counts.flushedCoordinates);
    out->weldedVertices += within[v] && triangles.lowest[v] != part.vertices[v] && band.owns(mesh.points[number][2]);
  }
  mesh.states.assign(part.triangles.size(), TriangleState::kept);
  mesh.triangles.reserve(part.triangles.size());
  for (size_t t = 0; t < part.triangles.size(); ++t) {
    const uint32_t* v = &part.corners[3 * t];
    mesh.triangles.push_back({numbers[v[0]], numbers[v[1]], numbers[v[2]]});
  }
  out->triangles = part.triangles;
  out->isWithin = triangles.isWithin;
  return out;
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
  const RankedSet named = rankedIds(ids);
  DisjointSets sets(named.size());
  std::vector<PartKind> kinds(named.size(), PartKind::winding);
  for (const BandParts& one : all) {
    for (size_t i = 0; i < one.shared.size(); i += 2) sets.unite(named.rankOf(one.shared[i]), named.rankOf(one.shared[i + 1]));
  }
  for (const BandParts& one : all) {
    for (size_t i = 0; i < one.kinds.size(); i += 2) {
      PartKind& kind = kinds[sets.find(named.rankOf(one.kinds[i]))];
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
    if (band.isWithin[t]) result.kinds[t] = kinds[sets.find(named.rankOf(setOf[t]))];
  }
  return result;
}

}  // namespace mandoline::detail

#include "cut/share_input.h"

#include <limits>

#include "cut/stages/input.h"

namespace mandoline::detail {
namespace {

/// Runs body(), which says whether a share can go on. It can't if the input is not fit.
template <class Body>
bool goesOn(const Body& body) {
  try {
    return body();
  } catch (const Failure&) {
    return false;
  }
}

}  // namespace

ShareInputMaker::ShareInputMaker(const MeshFacts& facts, const Grid& grid, const ShareOf& shareOf, const PrepareOptions& options)
    : facts_(facts), grid_(grid), shareOf_(shareOf), options_(options), monitor_(options_, kMeshStages) {
  in_->intersections = options.intersections;
  in_->fingerprint = facts.fingerprint;
  clock_.emplace(in_->preparation, monitor_);
}

bool ShareInputMaker::begin(const MeshPart& some, std::vector<uint64_t>& work) {
  clock_->begin("input");
  return goesOn([&] {
    checkGrid(grid_, 0);
    if (!fits(facts_.shift, grid_)) return false;
    const Scale scale(facts_.shift);
    uint32_t flushed = 0;
    in_->input.planes = scaledPlanes(grid_, scale, flushed);
    const SlabFinder finder(in_->input.planes);
    LayerWork layerWork(in_->input);
    std::vector<Slab> slabs;
    slabs.reserve(some.vertices.size());
    for (size_t i = 0; i < some.positions.size(); i += 3) {
      const double* p = &some.positions[i];
      slabs.push_back(finder.find({scale.scaled(p[0], flushed), scale.scaled(p[1], flushed), scale.scaled(p[2], flushed)}));
    }
    for (size_t i = 0; i < some.corners.size(); i += 3)
      layerWork.add(slabs[some.corners[i]], slabs[some.corners[i + 1]], slabs[some.corners[i + 2]]);
    work = layerWork.perLayer();
    return true;
  });
}

void ShareInputMaker::makeBands(const std::vector<uint64_t>& work) {
  constexpr double kFar = std::numeric_limits<double>::infinity();
  in_->layers.emplace(in_->input, work, shareOf_.count);
  const std::vector<double>& planes = in_->input.planes[2];
  for (uint32_t share = 0; share < shareOf_.count; ++share) {
    const CellLayers layers = in_->layers->of(share);
    Band& band = bands_.emplace_back(Band{kFar, -kFar});  // of no layers
    if (layers.first == layers.past) continue;
    band.low = layers.first == 0 ? -kFar : planes[size_t(layers.first)];
    band.high = layers.past == in_->input.cells(2) ? kFar : planes[size_t(layers.past)];
  }
}

bool ShareInputMaker::prepare(BandTriangles triangles) {
  return goesOn([&] {
    in_->band = weldBand(triangles, facts_.shift, band());
    keepSurface(triangles);
    triangles = {};
    if (in_->intersections != Intersections::assumeNone) clock_->begin("intersections");
    return findPlainEdges(*in_->band, in_->intersections, monitor_, predicates_);
  });
}

/// What lies within the band, with the tri-vertices that stand for several.
void ShareInputMaker::keepSurface(const BandTriangles& from) {
  std::vector<uint8_t> takesVertex(from.part.vertices.size(), 0);
  for (size_t v = 0; v < takesVertex.size(); ++v) takesVertex[v] = from.isComplete[v] && from.lowest[v] == from.part.vertices[v];
  in_->surface = std::make_shared<MeshPart>(takeFlagged(from.part, from.isWithin, std::move(takesVertex)));
}

BandFindings ShareInputMaker::found() const { return {inspectEdges(*in_->band), in_->band->weldedVertices}; }
BandParts ShareInputMaker::parts() const { return findBandParts(*in_->band); }

std::vector<int64_t> ShareInputMaker::join(const BandFindings& whole, const std::vector<uint32_t>& setOf,
                                           std::span<const BandParts> parts) {
  Prepared& mesh = in_->band->mesh;
  mesh.closed = whole.edges.closed;
  mesh.oriented = whole.edges.oriented;
  mesh.counts.weldedVertices = uint32_t(whole.weldedVertices);
  Parts joined = joinParts(*in_->band, setOf, parts);
  partCounts_ = joined.counts;
  if (!mesh.closed) mesh.parts = std::move(joined);
  if (in_->intersections == Intersections::resolve) arrangeInput(mesh, {}, false, monitor_, predicates_);
  Run run{in_->stats, monitor_};
  in_->input = prepareInput(mesh, grid_, run);
  std::vector<int64_t> winding(in_->input.cornerWinding.begin(), in_->input.cornerWinding.end());
  if (in_->band->band.owns(in_->input.planes[2][0])) return winding;
  return std::vector<int64_t>(winding.size(), 0);  // triangles in several bands are counted in one
}

std::vector<uint8_t> ShareInputMaker::trianglesOf(PartKind kind) const {
  const MeshBand& band = *in_->band;
  std::vector<uint8_t> flags(facts_.triangles, 0);
  for (size_t t = 0; t < band.triangles.size(); ++t) {
    if (band.isWithin[t] && band.mesh.parts.kinds[t] == kind) flags[band.triangles[t]] = 1;
  }
  return flags;
}

CrossingCounts ShareInputMaker::crossings() const {
  const MeshBand& band = *in_->band;
  const auto& slabs = in_->input.slabs;
  std::vector<uint64_t> counts(band.vertices.size(), 0);
  for (const auto& ends : band.mesh.edges.ends) counts[ends[0].number] += crossingIds(slabs[ends[0]], slabs[ends[1]]);
  CrossingCounts known;
  known.counts.assign(facts_.vertices, 0);
  for (size_t v = 0; v < counts.size(); ++v) {
    if (!band.isComplete[v]) continue;
    requireFewVertices(counts[v]);
    known.counts[band.vertices[v]] = uint8_t(std::min<uint64_t>(counts[v], known.kMany));
    if (counts[v] >= known.kMany) known.many.insert(known.many.end(), {band.vertices[v], uint32_t(counts[v])});
  }
  return known;
}

/// Ids are in the order of the tri-edges, by their lower ends. Those of edges that are not complete here are of no use.
void ShareInputMaker::numberCrossings(const CrossingCounts& all) {
  const MeshBand& band = *in_->band;
  const auto& slabs = in_->input.slabs;
  const auto& ends = band.mesh.edges.ends;
  in_->firstCrossings.reserve(ends.size());
  uint64_t next = all.counts.size();
  size_t many = 0, edge = 0, vertex = 0;
  for (uint32_t v = 0; v < all.counts.size(); ++v) {
    if (vertex < band.vertices.size() && band.vertices[vertex] == v) {
      uint64_t first = next;
      for (; edge < ends.size() && ends[{uint32_t(edge)}][0].number == vertex; ++edge) {
        const auto& [low, high] = ends[{uint32_t(edge)}];
        in_->firstCrossings.push_back(uint32_t(first));
        first += crossingIds(slabs[low], slabs[high]);
      }
      ++vertex;
    }
    if (all.counts[v] < all.kMany) {
      next += all.counts[v];
    } else {
      next += all.many[2 * many + 1];
      ++many;
    }
    requireFewVertices(next);
  }
  in_->wholeVertices = uint32_t(next);
}

std::unique_ptr<ShareInput> ShareInputMaker::take(const SharedFindings& all) {
  MeshBand& band = *in_->band;
  in_->input.cornerWinding.assign(all.cornerWinding.begin(), all.cornerWinding.end());
  numberCrossings(all.crossings);
  WholeTriangles& triangles = in_->triangles.emplace(uint32_t(facts_.triangles));
  for (uint32_t t = 0; t < all.inParity.size(); ++t) {
    if (all.inParity[t]) triangles.parity.push_back(t);
  }
  for (uint32_t t = 0; t < all.inOpen.size(); ++t) {
    if (all.inOpen[t]) triangles.open.push_back(t);
  }
  band.mesh.counts.exactFallbacks = predicates_.fallbacks;
  addCounts(band.mesh, in_->stats);
  addCounts(band.mesh, in_->preparation);
  clock_.reset();
  return std::move(in_);
}

}  // namespace mandoline::detail

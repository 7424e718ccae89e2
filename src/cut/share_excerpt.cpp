#include "cut/share_excerpt.h"

#include <utility>

namespace mandoline::detail {
namespace {

/// The whole's ids of crossings, which are those of cutTriEdges().
void numberCrossings(const Input& whole, ShareExcerpt& out) {
  const auto& ends = whole.mesh->edges.ends;
  const std::vector<uint32_t>& kept = out.excerpt.edges;
  uint64_t next = whole.slabs.size();
  size_t at = 0;
  for (const TriEdgeId e : ends.ids()) {
    if (at < kept.size() && kept[at] == e.number) {
      out.firstCrossings.push_back(uint32_t(next));
      ++at;
    }
    next += crossingIds(whole.slabs[ends[e][0]], whole.slabs[ends[e][1]]);
    requireFewVertices(next);
  }
  out.wholeVertices = uint32_t(next);
}

std::vector<uint32_t> trianglesInLayers(const CutState& state) {
  const Input& input = state.surface.input;
  std::vector<uint32_t> kept;
  for (const TriangleId t : input.triangleIds()) {
    if (input.kept(t) && isInLayers(input, t, *state.layersHere)) kept.push_back(t.number);
  }
  return kept;
}

/// Of the state's input, by whose ids the excerpt still goes.
void takeInput(const ShareExcerpt& from, Input& input) {
  input.mesh = &from.excerpt.mesh;
  IdVector<VertexId, Slab> slabs;
  slabs.reserve(from.excerpt.vertices.size());
  for (const uint32_t v : from.excerpt.vertices) slabs.push_back(input.slabs[{v}]);
  input.slabs = std::move(slabs);
}

void takePositions(const NamedMesh& mesh, ShareExcerpt& out) {
  out.positions.reserve(3 * size_t(out.excerpt.mesh.triVertices));
  for (size_t i = 0; i < out.excerpt.mesh.triVertices; ++i) {
    const double* p = mesh.vertex(out.excerpt.vertices[i]);
    out.positions.insert(out.positions.end(), p, p + 3);
  }
}

}  // namespace

std::unique_ptr<ShareExcerpt> takeExcerpt(const MeshView& mesh, CutState& state) {
  Input& input = state.surface.input;
  state.wholeTriangles.emplace(*input.mesh);
  auto out = std::make_unique<ShareExcerpt>(*input.mesh, trianglesInLayers(state));
  numberCrossings(input, *out);
  takeInput(*out, input);
  takePositions(mesh, *out);
  return out;
}

std::unique_ptr<ShareExcerpt> takeInputExcerpt(ShareInput& from, CutState& state) {
  MeshBand& band = *from.band;
  state.surface.input = std::move(from.input);
  state.wholeTriangles = std::move(from.triangles);
  auto out = std::make_unique<ShareExcerpt>(band.mesh, trianglesInLayers(state));
  Excerpt& excerpt = out->excerpt;
  takeInput(*out, state.surface.input);
  for (const uint32_t e : excerpt.edges) out->firstCrossings.push_back(from.firstCrossings[e]);
  out->wholeVertices = from.wholeVertices;
  for (uint32_t& t : excerpt.triangles) t = band.triangles[t];
  for (uint32_t& v : excerpt.vertices) v = band.vertices[v];
  takePositions(*from.surface, *out);
  return out;
}

void ShareExcerpt::nameByWhole(CutMesh& cutMesh) const {
  const auto name = [](auto& id, const std::vector<uint32_t>& ids) {
    if (id >= 0) id = int32_t(ids[size_t(id)]);
  };
  for (int32_t& t : cutMesh.faceTriangle) name(t, excerpt.triangles);
  for (uint32_t& t : cutMesh.faceParents) t = excerpt.triangles[t];
  for (int32_t& v : cutMesh.vertexTriVertex) name(v, excerpt.vertices);
  for (size_t v = 0; v < cutMesh.vertexCount(); ++v) {  // two ends of an edge, or a triangle alone
    int32_t* parents = &cutMesh.vertexParents[2 * v];
    const auto& ids = parents[1] < 0 ? excerpt.triangles : excerpt.vertices;
    for (size_t i = 0; i < 2; ++i) name(parents[i], ids);
  }
  for (size_t i = 0; i < cutMesh.madeVertices.size(); ++i) {
    const MadeVertex kind = MadeVertex(cutMesh.madeVertexKinds[i]);
    const size_t vertices = kind == MadeVertex::edgeEdge ? 4 : kind == MadeVertex::edgeTriangle ? 2 : 0;  // then come triangles
    for (size_t k = 0; k < 4; ++k) name(cutMesh.madeVertexParents[4 * i + k], k < vertices ? excerpt.vertices : excerpt.triangles);
  }
}

void ShareExcerpt::nameByWhole(Error& error) const {
  if (error.status == Status::selfIntersection || error.status == Status::meshTooLarge) excerpt.nameByWhole(error);
}

}  // namespace mandoline::detail

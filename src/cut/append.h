// Elements of one cut-mesh, added to another one, and the triangles that faces are of.
#pragma once

#include <algorithm>
#include <initializer_list>

#include "base/sort.h"
#include "mandoline/cut_mesh.h"

namespace mandoline::detail {

template <class T>
void append(std::vector<T>& to, const std::vector<T>& from, size_t index, size_t items = 1) {
  to.insert(to.end(), from.begin() + ptrdiff_t(index * items), from.begin() + ptrdiff_t((index + 1) * items));
}

/// Makes room for arrays of all of `from`.
template <class... Items>
void reserveFor(std::initializer_list<const CutMesh*> from, CutMesh& to, std::vector<Items> CutMesh::*... arrays) {
  const auto reserve = [&](auto array) {
    size_t count = 1;  // where offsets begin
    for (const CutMesh* one : from) count += (one->*array).size();
    (to.*array).reserve(count);
  };
  (reserve(arrays), ...);
}
inline void reserveFaces(std::initializer_list<const CutMesh*> from, CutMesh& to) {
  reserveFor(from, to, &CutMesh::loopVertices, &CutMesh::loopOffsets, &CutMesh::faceLoopOffsets, &CutMesh::faceParents,
             &CutMesh::faceParentSigns, &CutMesh::faceParentOffsets, &CutMesh::faceTriangle, &CutMesh::faceAxis, &CutMesh::facePlane);
}
inline void reserveVertices(std::initializer_list<const CutMesh*> from, CutMesh& to) {
  reserveFor(from, to, &CutMesh::positions, &CutMesh::vertexCell, &CutMesh::vertexMask, &CutMesh::vertexTriVertex, &CutMesh::vertexParents);
}

/// Begins the offsets of faces.
inline void beginFaces(CutMesh& to) {
  to.loopOffsets.assign(1, 0);
  to.faceLoopOffsets.assign(1, 0);
  to.faceParentOffsets.assign(1, 0);
}

/// Adds a face, which keeps the numbers of its vertices.
inline void appendFace(const CutMesh& from, size_t f, CutMesh& to) {
  for (const std::span<const uint32_t> loop : from.loops(f)) {
    to.loopVertices.insert(to.loopVertices.end(), loop.begin(), loop.end());
    to.loopOffsets.push_back(uint32_t(to.loopVertices.size()));
  }
  to.faceLoopOffsets.push_back(uint32_t(to.loopOffsets.size() - 1));
  for (uint32_t i = from.faceParentOffsets[f]; i < from.faceParentOffsets[f + 1]; ++i) {
    append(to.faceParents, from.faceParents, i);
    append(to.faceParentSigns, from.faceParentSigns, i);
  }
  to.faceParentOffsets.push_back(uint32_t(to.faceParents.size()));
  append(to.faceTriangle, from.faceTriangle, f);
  append(to.faceAxis, from.faceAxis, f);
  append(to.facePlane, from.facePlane, f);
}

/// Adds a vertex. Whether it is a made one is not told.
inline void appendVertex(const CutMesh& from, size_t v, CutMesh& to) {
  append(to.positions, from.positions, v, 3);
  append(to.vertexCell, from.vertexCell, v, 3);
  append(to.vertexMask, from.vertexMask, v);
  append(to.vertexTriVertex, from.vertexTriVertex, v);
  append(to.vertexParents, from.vertexParents, v, 2);
}

/// Adds a made vertex of `from`, the i-th, as `vertex`.
inline void appendMade(const CutMesh& from, size_t i, uint32_t vertex, CutMesh& to) {
  to.madeVertices.push_back(vertex);
  append(to.madeVertexKinds, from.madeVertexKinds, i);
  append(to.madeVertexParents, from.madeVertexParents, i, 4);
}

/// Adds the made vertices of parts of a cut-mesh, whose ids are those of the whole.
inline void joinMade(const std::vector<const CutMesh*>& parts, CutMesh& to) {
  struct Place {
    uint32_t vertex, part, index;
  };
  std::vector<Place> places;
  for (uint32_t part = 0; part < parts.size(); ++part) {
    const std::vector<uint32_t>& made = parts[part]->madeVertices;
    for (uint32_t i = 0; i < made.size(); ++i) places.push_back({made[i], part, i});
  }
  sortItems(places, [](const Place& a, const Place& b) { return a.vertex < b.vertex; });
  for (const Place& at : places) appendMade(*parts[at.part], at.index, at.vertex, to);
}

/// Copies what all pieces of a cut have alike: the grid, what is known of the regions, and of the input.
inline void copyCommon(const CutMesh& from, CutMesh& to) {
  const auto copy = [&](auto... members) { ((to.*members = from.*members), ...); };
  copy(&CutMesh::grid, &CutMesh::regionCount, &CutMesh::hasWinding, &CutMesh::regionWinding, &CutMesh::regionPartWinding,
       &CutMesh::regionParity, &CutMesh::parityTriangles, &CutMesh::openTriangles, &CutMesh::triangleCount, &CutMesh::snapTolerance,
       &CutMesh::madeFrom);
}

/// Per triangle of the input 1 if the cut-mesh has a face of it, else 0.
inline std::vector<uint8_t> trianglesWithFace(const CutMesh& cutMesh, size_t triangles) {
  std::vector<uint8_t> hasFace(triangles, 0);
  for (const uint32_t t : cutMesh.faceParents) hasFace[t] = 1;
  return hasFace;
}

/// Lists the triangles of which the cut-mesh has no face as dropped.
inline void listWithoutFace(CutMesh& cutMesh) {
  const std::vector<uint8_t> hasFace = trianglesWithFace(cutMesh, cutMesh.triangleCount);
  cutMesh.droppedTriangles.reserve(size_t(std::count(hasFace.begin(), hasFace.end(), 0)));
  for (uint32_t t = 0; t < cutMesh.triangleCount; ++t) {
    if (!hasFace[t]) cutMesh.droppedTriangles.push_back(t);
  }
}

}  // namespace mandoline::detail

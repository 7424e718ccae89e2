// The places that a brick's loops have in the place of vertices: those of its own by number, then the surface's as they come.
#pragma once

#include <span>
#include <vector>

#include "base/prefetch.h"
#include "cut/predicates/cut_vertices.h"

namespace mandoline::detail {

class VertexPlaces {
 public:
  static constexpr uint32_t kNone = ~0u;

  /// `places`: per vertex of the surface, kNone at first; and of those of bricks so far. `surfaceVertices` gets those that come.
  VertexPlaces(const CutVertices& vertices, IdVector<VertexId, uint32_t>& places, std::vector<VertexId>& surfaceVertices)
      : ownCount_(uint32_t(vertices.slabs.size())), surfaceVertices_(surfaceVertices) {
    const uint32_t firstOwn = vertices.firstOwn.number;
    if (places.empty()) places.assign(firstOwn, kNone);
    while (places.size() < vertices.size()) places.push_back(uint32_t(places.size()) - firstOwn);
    places_ = places.data();
  }

  /// Writes the places of some. Which of them are new can't be foretold, so there is no branch on it.
  void of(std::span<const VertexId> vertices, uint32_t* places) {
    size_t count = surfaceVertices_.size();
    surfaceVertices_.resize(count + vertices.size());
    VertexId* const list = surfaceVertices_.data();
    for (size_t i = 0; i < vertices.size(); ++i) {
      if (i + kAhead < vertices.size()) prefetch(places_ + vertices[i + kAhead].number);
      const VertexId v = vertices[i];
      const bool isNew = places_[v.number] == kNone;
      list[count] = v;
      places[i] = places_[v.number] = isNew ? ownCount_ + uint32_t(count) : places_[v.number];
      count += isNew;
    }
    surfaceVertices_.resize(count);
  }

 private:
  static constexpr size_t kAhead = 16;

  const uint32_t ownCount_;
  uint32_t* places_;
  std::vector<VertexId>& surfaceVertices_;
};

}  // namespace mandoline::detail

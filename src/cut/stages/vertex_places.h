// The places that a brick's loops have in the place of vertices: those of its own by number, then the surface's as they come.
#pragma once

#include <vector>

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

  uint32_t of(VertexId v) const {
    const uint32_t place = places_[v.number];
    return place != kNone ? place : add(v);
  }

 private:
  uint32_t add(VertexId v) const {
    const uint32_t place = ownCount_ + uint32_t(surfaceVertices_.size());
    surfaceVertices_.push_back(v);
    return places_[v.number] = place;
  }

  const uint32_t ownCount_;
  uint32_t* places_;
  std::vector<VertexId>& surfaceVertices_;
};

}  // namespace mandoline::detail

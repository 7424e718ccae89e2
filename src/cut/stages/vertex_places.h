// The places that a brick's loops have in the place of vertices: those of its own by number, then the surface's as they come.
#pragma once

#include <vector>

#include "cut/predicates/cut_vertices.h"

namespace mandoline::detail {

class VertexPlaces {
 public:
  static constexpr uint32_t kNone = ~0u;

  /// `places`: per vertex of the surface, kNone at first. `surfaceVertices` gets those that come.
  VertexPlaces(const CutVertices& vertices, IdVector<VertexId, uint32_t>& places, std::vector<VertexId>& surfaceVertices)
      : firstOwn_(vertices.firstOwn.number),
        ownCount_(uint32_t(vertices.slabs.size())),
        places_(places.data()),
        surfaceVertices_(surfaceVertices) {}

  uint32_t of(VertexId v) const {
    if (v.number >= firstOwn_) return v.number - firstOwn_;
    const uint32_t place = places_[v.number];
    return place != kNone ? place : add(v);
  }

 private:
  uint32_t add(VertexId v) const {
    const uint32_t place = ownCount_ + uint32_t(surfaceVertices_.size());
    surfaceVertices_.push_back(v);
    return places_[v.number] = place;
  }

  const uint32_t firstOwn_, ownCount_;
  uint32_t* const places_;
  std::vector<VertexId>& surfaceVertices_;
};

}  // namespace mandoline::detail

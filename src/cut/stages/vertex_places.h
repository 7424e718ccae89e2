// The places that a brick's loops have in the place of vertices: those of its own by number, then the surface's as they come.
#pragma once

#include <algorithm>
#include <vector>

#include "base/prefetch.h"
#include "cut/predicates/cut_vertices.h"

namespace mandoline::detail {

class VertexPlaces {
 public:
  static constexpr uint32_t kNone = ~0u;  // of() relies on all bits being set

  /// `places`: per vertex of the surface, kNone at first; and of those of bricks so far. `surfaceVertices` gets those that come.
  VertexPlaces(const CutVertices& vertices, IdVector<VertexId, uint32_t>& places, std::vector<VertexId>& surfaceVertices)
      : ownCount_(uint32_t(vertices.slabs.size())), surfaceVertices_(surfaceVertices) {
    const uint32_t firstOwn = vertices.firstOwn.number;
    if (places.empty()) {
      places.reserve(vertices.size() + ownCount_ / 4);
      places.assign(firstOwn, kNone);
    }
    while (places.size() < vertices.size()) places.push_back(uint32_t(places.size()) - firstOwn);
    places_ = places.data();
  }

  /// Writes the places of count vertices, which are vertexOf(i). Which of them are new can't be foretold, so there is no branch on it.
  template <class F>
  void of(size_t count, const F& vertexOf, uint32_t* places) {
    size_t known = surfaceVertices_.size();
    for (size_t begin = 0; begin < count; begin += kBatch) {
      const size_t end = std::min(count, begin + kBatch);
      surfaceVertices_.resize(known + kBatch);
      VertexId* const list = surfaceVertices_.data();
      for (size_t i = begin; i < end; ++i) {
        if (i + kAhead < count) prefetch(places_ + vertexOf(i + kAhead).number);
        const VertexId v = vertexOf(i);
        uint32_t& place = places_[v.number];
        const bool isNew = place == kNone;
        list[known] = v;
        place &= (ownCount_ + uint32_t(known)) | (uint32_t(isNew) - 1);
        places[i] = place;
        known += isNew;
      }
      surfaceVertices_.resize(known);
    }
  }

 private:
  static constexpr size_t kAhead = 16, kBatch = 1024;

  const uint32_t ownCount_;
  uint32_t* places_;
  std::vector<VertexId>& surfaceVertices_;
};

}  // namespace mandoline::detail

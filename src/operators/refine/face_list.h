// Faces as they are made, one after the other.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "mandoline/cell_complex.h"

namespace mandoline::refining {

/// Some faces of a cell complex, and what a cut-mesh has of them, under the same names.
struct FaceList {
  std::vector<uint32_t> loopOffsets{0}, loopVertices, faceLoopOffsets{0};
  std::vector<int32_t> faceCells;
  std::vector<FaceTag> faceTag;
  std::vector<double> faceArea, faceNormal, faceCentroid;
  std::vector<int32_t> faceTriangle, facePlane;
  std::vector<int8_t> faceAxis;
  std::vector<uint32_t> faceParentOffsets{0}, faceParents;
  std::vector<int8_t> faceParentSigns;

  uint32_t size() const { return uint32_t(faceAxis.size()); }
  Loops loops(size_t f) const {
    return {loopOffsets.data() + faceLoopOffsets[f], size_t(faceLoopOffsets[f + 1] - faceLoopOffsets[f]), loopVertices.data()};
  }
  std::span<const uint32_t> parents(size_t f) const {
    return {faceParents.data() + faceParentOffsets[f], faceParentOffsets[f + 1] - faceParentOffsets[f]};
  }
  void endLoop() { loopOffsets.push_back(uint32_t(loopVertices.size())); }
  /// After its loops and parents.
  void endFace() {
    faceLoopOffsets.push_back(uint32_t(loopOffsets.size() - 1));
    faceParentOffsets.push_back(uint32_t(faceParents.size()));
  }
};

/// Calls visit(from, to) for each edge of some loops.
template <class Range, class Visit>
void forEdges(const Range& loops, const Visit& visit) {
  for (const std::span<const uint32_t> loop : loops) {
    for (size_t i = 0; i < loop.size(); ++i) visit(loop[i], loop[i + 1 < loop.size() ? i + 1 : 0]);
  }
}

}  // namespace mandoline::refining

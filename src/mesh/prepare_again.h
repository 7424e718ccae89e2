// Preparing a mesh that has moved: how its triangles are connected is known from the time before, and only triangles that have moved are
// tested for whether they meet others.
#pragma once

#include "mesh/prepared.h"

namespace mandoline::detail {

/// Per tri-vertex: whether it is elsewhere than before.
using Moved = IdVector<VertexId, uint8_t>;

inline bool hasMoved(const Moved& moved, const std::array<uint32_t, 3>& triangle) {
  return moved[{triangle[0]}] || moved[{triangle[1]}] || moved[{triangle[2]}];
}

struct PreparedAgain {
  std::unique_ptr<Prepared> mesh;  ///< as prepareMesh() gives it
  Moved moved;                     ///< empty if nothing is known. If it isn't, the triangles, their states and the scale are as before
};

/// `before` was prepared with the same preparation, its contacts kept.
PreparedAgain prepareAgain(const MeshView& mesh, const Preparation& preparation, const Prepared& before, Monitor& monitor,
                           const std::function<void(const char*)>& beginStage);

}  // namespace mandoline::detail

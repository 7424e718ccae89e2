// Preparing a mesh that has moved: how its triangles are connected is known from the time before, and only triangles that have moved are
// tested for whether they meet others.
#pragma once

#include "mesh/prepared.h"

namespace mandoline::detail {

struct PreparedAgain {
  std::unique_ptr<Prepared> mesh;  ///< as prepareMesh() gives it
  Moved moved;                     ///< empty if nothing is known. If it isn't, the triangles, their states and the scale are as before
};

/// `before` was prepared with the same preparation, its contacts kept. If no triangles meet in both, its edges are moved out of it.
PreparedAgain prepareAgain(const MeshView& mesh, const Preparation& preparation, Prepared& before, Monitor& monitor,
                           const std::function<void(const char*)>& beginStage);

}  // namespace mandoline::detail

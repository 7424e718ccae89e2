// Where the surface bends.
#pragma once

#include "operators/refine/leaves.h"

namespace mandoline::refining {

/// A box, by its planes along each axis.
struct Box {
  std::array<double, 3> low, high;
};

class Features {
 public:
  /// `angle` in degrees. The mesh has to outlive this.
  Features(const MeshView& mesh, double angle);

  /// Whether normals of some triangles are farther from each other than the angle.
  bool bends(const std::vector<uint32_t>& triangles) const;
  /// Those of the triangles that a box meets, up to rounding.
  std::vector<uint32_t> meeting(const Box& box, const std::vector<uint32_t>& triangles) const;

 private:
  const MeshView mesh_;
  const double angle_, cosine_;
};

}  // namespace mandoline::refining

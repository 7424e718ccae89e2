// Which triangles winding numbers and parity are counted of.
#pragma once

#include "mesh/prepared.h"

namespace mandoline::detail {

/// Which triangles count, and how: all of a mesh that has winding numbers, or those of parts that have them, or that have parity.
class Counted {
 public:
  explicit Counted(const Prepared& mesh) : mesh_(&mesh) {}
  /// Of parts that are at most as bad; modulo 2 unless those have winding numbers.
  Counted(const Prepared& mesh, PartKind worst) : mesh_(&mesh), worst_(worst) {}

  bool has(TriangleId t) const { return mesh_->parts.kinds.empty() || mesh_->parts.kinds[t.number] <= worst_; }
  /// The sum of the signs of a kept triangle and its duplicates.
  int32_t signSum(TriangleId t) const {
    int32_t sum = has(t);
    for (const Duplicate& d : mesh_->duplicatesOf(t)) sum += !has({d.triangle}) ? 0 : d.sameWay ? 1 : -1;
    return sum;
  }
  bool areEqual(int32_t a, int32_t b) const { return worst_ == PartKind::winding ? a == b : (a - b) % 2 == 0; }

 private:
  const Prepared* mesh_;
  PartKind worst_ = PartKind::winding;
};

/// What there is to be found of a mesh: its winding numbers alone, or those of parts, and parity; nothing if all of it is open.
inline std::vector<Counted> countedOf(const Prepared& mesh) {
  const PartCounts& parts = mesh.parts.counts;
  if (mesh.closed) return {Counted(mesh)};
  std::vector<Counted> counted;
  if (parts.winding > 0) counted.push_back({mesh, PartKind::winding});
  if (parts.winding + parts.parity > 0) counted.push_back({mesh, PartKind::parity});
  return counted;
}

}  // namespace mandoline::detail

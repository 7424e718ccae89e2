// A mesh that is read several times, and may be written by others meanwhile.
#pragma once

#include <optional>

#include "mesh/failure.h"
#include "mesh/fingerprints.h"
#include "mesh/mesh_source.h"

namespace mandoline::detail {

/// Of a mesh: its fingerprint, and what that has come to before the triangles.
struct MeshSums {
  uint64_t beforeTriangles = 0;
  Fingerprint whole;
};

/// Throws Failure (badArgument) once all vertices or all triangles are read, in their order, if they are not those of the sums. So what is
/// made of them before has to be able to follow any.
class CheckedSource : public MeshSource {
 public:
  /// `mesh` has to outlive this.
  CheckedSource(const MeshSource& mesh, const MeshSums& sums) : mesh_(mesh), sums_(sums) {
    vertices = mesh.vertices;
    triangles = mesh.triangles;
  }

  void readPositions(uint64_t first, std::span<double> positions) const override {
    mesh_.readPositions(first, positions);
    if (first == 0) sum_ = Fingerprinter("mesh"), sum_.add(3 * vertices);
    for (const double x : positions) sum_.add(x);
    if (first + positions.size() / 3 == vertices && sum_.state() != sums_.beforeTriangles) fail();
  }

  void readCorners(uint64_t first, std::span<uint32_t> corners) const override {
    mesh_.readCorners(first, corners);
    if (first == 0) sum_ = Fingerprinter::goingOn(sums_.beforeTriangles), sum_.add(3 * triangles), odd_.reset();
    for (const uint32_t v : corners) {
      if (!odd_) {
        odd_ = v;
        continue;
      }
      sum_.add(uint64_t(*odd_) << 32 | v);
      odd_.reset();
    }
    if (first + corners.size() / 3 != triangles) return;
    if (odd_) sum_.add(uint64_t(*odd_));
    if (sum_.get() != sums_.whole) fail();
  }

 private:
  [[noreturn]] static void fail() { throw Failure{{Status::badArgument, -1, -1, "The mesh has changed while processes read it."}}; }

  const MeshSource& mesh_;
  const MeshSums sums_;
  mutable Fingerprinter sum_{"mesh"};
  mutable std::optional<uint32_t> odd_;  // a number that waits for the next
};

}  // namespace mandoline::detail

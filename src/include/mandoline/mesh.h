// Triangle meshes, the input of a cut.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "mandoline/api.h"

namespace MANDOLINE_API mandoline {

/// A triangle mesh. The normal of triangle (a, b, c) is (b - a) x (c - a). It may be open, non-manifold, inconsistently oriented, unwelded,
/// and its triangles may meet anywhere.
struct Mesh {
  std::vector<double> positions;    ///< 3 per tri-vertex: x, y, z
  std::vector<uint32_t> triangles;  ///< 3 per triangle: tri-vertex ids, from 0

  size_t vertexCount() const { return positions.size() / 3; }
  size_t triangleCount() const { return triangles.size() / 3; }

  static void fields(auto& self, const auto& f) {
    f("positions", self.positions);
    f("triangles", self.triangles);
  }
};

/// A mesh that somebody else owns, in the layout of Mesh. It must outlive the view, so a view of a temporary does not compile.
struct MeshView {
  std::span<const double> positions;
  std::span<const uint32_t> triangles;

  MeshView(std::span<const double> positions_, std::span<const uint32_t> triangles_) : positions(positions_), triangles(triangles_) {}
  MeshView(const Mesh& mesh) : positions(mesh.positions), triangles(mesh.triangles) {}
  MeshView(const Mesh&&) = delete;
  size_t vertexCount() const { return positions.size() / 3; }
  size_t triangleCount() const { return triangles.size() / 3; }
};

}  // namespace mandoline

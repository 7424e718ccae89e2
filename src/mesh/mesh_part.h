// Some vertices and triangles of a mesh, which keep the ids of the whole: what one of several processes has of the user's mesh.
#pragma once

#include "base/ranked_set.h"
#include "base/shared.h"
#include "mandoline/mesh.h"

namespace mandoline::detail {

struct MeshPart {
  std::vector<uint32_t> vertices;   ///< ids, ascending
  std::vector<uint32_t> triangles;  ///< likewise
  std::vector<double> positions;    ///< 3 per vertex
  std::vector<uint32_t> corners;    ///< 3 per triangle: which vertices of the part

  static void fields(auto& self, const auto& f) {
    f("vertices", self.vertices);
    f("triangles", self.triangles);
    f("positions", self.positions);
    f("corners", self.corners);
  }
};

/// A set of ids, to be had in ascending order and found among these.
MANDOLINE_SHARED RankedSet rankedIds(std::span<const uint32_t> ids);
MANDOLINE_SHARED std::vector<uint32_t> idsOf(const RankedSet& set);

/// A mesh, or a part of one, which has to outlive this, by the ids of the whole. Throws Failure for what a part does not have
/// (internalError).
class NamedMesh {
 public:
  NamedMesh(const MeshView& mesh) : positions_(mesh.positions), corners_(mesh.triangles) {}
  MANDOLINE_SHARED NamedMesh(const MeshPart& part);
  NamedMesh(const MeshPart&&) = delete;

  const double* vertex(size_t v) const { return at(ids_ ? indexOf(v, vertices_) : v); }
  const double* corner(size_t triangle, size_t i) const { return at(cornerIndex(triangle, i)); }
  uint32_t cornerId(size_t triangle, size_t i) const {
    const uint32_t index = cornerIndex(triangle, i);
    return ids_ ? (*ids_)[index] : index;
  }

 private:
  MANDOLINE_SHARED static size_t indexOf(size_t id, const RankedSet& ids);
  const double* at(size_t vertex) const { return positions_.data() + 3 * vertex; }
  uint32_t cornerIndex(size_t triangle, size_t i) const { return corners_[3 * (ids_ ? indexOf(triangle, triangles_) : triangle) + i]; }

  std::span<const double> positions_;
  std::span<const uint32_t> corners_;
  const std::vector<uint32_t>* ids_ = nullptr;  // of a part's vertices; null for all, in their order
  RankedSet vertices_, triangles_;              // of a part
};

/// Triangles with their vertices, and other vertices; ids in any order, also more than once.
MANDOLINE_SHARED MeshPart takePart(const NamedMesh& mesh, std::vector<uint32_t> triangles, std::vector<uint32_t> vertices);
/// The triangles that are flagged, with their vertices, and the vertices that are.
MANDOLINE_SHARED MeshPart takeFlagged(const MeshPart& part, const std::vector<uint8_t>& takesTriangle, std::vector<uint8_t> takesVertex);
/// Whether a part has all that another one of the mesh has.
MANDOLINE_SHARED bool hasAll(const MeshPart& part, const MeshPart& other);
/// What any of some parts of a mesh has.
MANDOLINE_SHARED MeshPart united(std::span<const MeshPart> parts);

}  // namespace mandoline::detail

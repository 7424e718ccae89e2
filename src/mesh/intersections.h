// Self-intersections (paper, Appendix A "Bad Input Meshes"): which triangles meet other than in a shared vertex or edge.
//
// All answers are signs of polynomials of the input's doubles: nothing is constructed, nothing rounded. A stitched side (see Stitch) counts
// as the vertices and edges that it is made of, which both of its neighbours share.
#pragma once

#include <array>
#include <span>

#include "mesh/welded_mesh.h"

namespace mandoline::detail {

/// Tests pairs of kept triangles of one mesh.
class Intersections {
 public:
  explicit Intersections(const WeldedMesh& mesh);

  /// Whether two triangles meet other than in shared vertices or whole shared edges: they cross, touch, overlap in one plane, are folded
  /// onto each other, or are the same.
  bool meet(uint32_t s, uint32_t t);

 private:
  using Vertices = std::span<const uint32_t>;

  /// A triangle with the tri-vertices on each side, from the side's lower end to its higher.
  struct Outline {
    std::array<uint32_t, 3> corners;
    std::array<std::array<uint32_t, 2>, 3> ends;           ///< of the side that starts at corner i
    std::array<const std::vector<uint32_t>*, 3> stitched;  ///< all vertices of that side, if there are more

    Vertices side(int i) const { return stitched[i] ? Vertices(*stitched[i]) : Vertices(ends[i]); }
    uint32_t apex(int i) const { return corners[(i + 2) % 3]; }
  };

  Outline outline(uint32_t t) const;
  void findShared(const Outline& a, const Outline& b);
  bool isShared(uint32_t v) const;
  int sharedSide(const Outline& a) const;
  bool meetAlongSides(const Outline& a, const Outline& b);
  bool meetBeyondVertex(const Outline& a, const Outline& b);
  bool liesBeside(const Outline& a, const Outline& b);
  bool segmentMeets(uint32_t p, uint32_t q, const Outline& t);
  bool segmentMeetsInPlane(uint32_t p, uint32_t q, const Outline& t);
  bool isBetween(uint32_t v, uint32_t p, uint32_t q) const;
  int orient(uint32_t a, uint32_t b, uint32_t c, uint32_t d);
  int orient(uint32_t a, uint32_t b, uint32_t c, int axis);
  int axisAcross(const Outline& t);

  const WeldedMesh& mesh_;
  Predicates predicates_;
  std::vector<std::vector<uint32_t>> stitchedSides_;  ///< per Stitch: its vertices with both ends
  std::vector<uint32_t> shared_;                      ///< of the two triangles at hand
};

}  // namespace mandoline::detail

// A mesh with its triangles turned so that they agree, and face outward.
#pragma once

#include "mandoline/mesh.h"
#include "mandoline/status.h"

namespace MANDOLINE_API mandoline {

/// Where the normals of a patch point to, once it is oriented. A patch is triangles that hang together through edges with two triangles;
/// vertices at one position count as one.
enum class Facing : uint8_t {
  outward,       ///< out of what the patch encloses
  inward,        ///< into it: a cavity, since the patch lies inside an odd number of other closed ones
  unknown,       ///< open, or it encloses nothing: its triangles agree, and at most half of them were turned
  nonOrientable  ///< as in a Moebius strip no orientation lets its triangles agree: none was turned
};

/// The facing as the word above.
inline const char* name(Facing facing) {
  constexpr const char* kNames[] = {"outward", "inward", "unknown", "nonOrientable"};
  return kNames[size_t(facing)];
}

struct OrientedMesh {
  Mesh mesh;                              ///< vertices and triangles in the order of the input; (a, b, c) turned is (a, c, b)
  std::vector<uint32_t> turnedTriangles;  ///< ascending
  std::vector<int32_t> trianglePatch;     ///< per triangle; -1 without three different vertices. In the order of their first triangles
  std::vector<Facing> patchFacing;        ///< per patch

  size_t patchCount() const { return patchFacing.size(); }

  static void fields(auto& self, const auto& f) {
    f("mesh", self.mesh);
    f("turnedTriangles", self.turnedTriangles);
    f("trianglePatch", self.trianglePatch);
    f("patchFacing", self.patchFacing);
  }
};

/// Turns triangles so that two at an edge run along it in opposite directions, and so that
/// - closed patches face outward, by the sign of the volume that they enclose, but inward where they lie inside an odd number of others.
///   Patches that cross each other do not lie inside each other;
/// - patches that only together close every edge, since more than two triangles meet at some, face away from what they enclose, from where
///   a ray meets an odd number of them;
/// - open patches face outward if closing their holes in any way within their bounding box would enclose a volume of the same sign, as of a
///   scan with holes; else most of their triangles stay.
/// All signs are exact. Throws CallError if cancelled, and for meshes that cut() refuses: emptyMesh, badArrays, badIndex,
/// nonFiniteCoordinate, meshTooLarge.
OrientedMesh orient(const MeshView& mesh, const RunOptions& options = {});

}  // namespace mandoline

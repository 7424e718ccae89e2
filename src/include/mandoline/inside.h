// Which regions of a cut-mesh are inside of the solid that its input bounds: by the best that the input allows.
#pragma once

#include "mandoline/cut_mesh.h"
#include "mandoline/status.h"

namespace MANDOLINE_API mandoline {

/// Which winding numbers are inside of the solid.
enum class WindingRule : uint8_t {
  positive,  ///< above 0: parts that overlap are one, inverted ones are nothing
  nonZero,   ///< any but 0
  odd        ///< where two parts overlap, there is a hole
};

/// What tells inside from outside.
enum class InsideBy : uint8_t {
  winding,  ///< winding numbers, exactly
  parity,   ///< the number of crossings modulo 2, exactly: for parts that are not consistently oriented
  estimate  ///< generalized winding numbers: for open parts
};

/// The word above.
inline const char* name(InsideBy by) {
  constexpr const char* kNames[] = {"winding", "parity", "estimate"};
  return kNames[size_t(by)];
}

struct InsideOptions {
  WindingRule rule = WindingRule::positive;
  double threshold = 0.5;  ///< where there are estimates: they count as the winding number n from n - 1 + threshold on. Above 0, at most 1
};

/// What insideRegions() says.
struct InsideRegions {
  std::vector<uint8_t> isInside;    ///< per region
  InsideBy by = InsideBy::winding;  ///< the least certain that any part of the input needs
  bool isComplete = true;           ///< whether all parts count: without estimates, open ones are left out

  static void fields(auto& self, const auto& f) {
    f("isInside", self.isInside);
    f("by", self.by);
    f("isComplete", self.isComplete);
  }
};

/// A region is inside if its winding number is by the rule: the sum over the parts that have one, or its estimate; or if it is inside
/// of an odd number of parts that have parity alone (by WindingRule::odd these are added). Throws CallError if the cut-mesh is empty,
/// has open parts only and no estimates, or if the threshold is not above 0 and at most 1.
InsideRegions insideRegions(const CutMesh& cutMesh, const InsideOptions& options = {});

struct EstimateOptions : RunOptions {
  double threshold = 0.5;  ///< as of InsideOptions
};

/// The cut-mesh with estimates where parts are open: regionInsideness, from generalized winding numbers (Jacobson et al. 2013). Inside
/// and outside of an open surface are one region, which meet through its holes: such regions are divided at grid-faces into connected sets
/// of cut-cells and octree cells (those of coarsen()) on one side of the threshold, so that all that goes by regions closes the holes
/// there. Without open parts, what comes back is the cut-mesh. `mesh` is its input. Throws CallError if they don't belong together, if
/// the cut-mesh is empty or has estimates already, if the threshold is not above 0 and at most 1, or if cancelled.
CutMesh estimateInside(const MeshView& mesh, const CutMesh& cutMesh, const EstimateOptions& options = {});

/// The sums of the signed solid angles of all triangles, seen from points, in whole spheres: inside of a closed surface that is oriented
/// outwards 1, outside 0; about open ones between. Right to some 1e-12, in less than linear time per point, the same bits everywhere.
/// `points`: 3 per point. Triangles with the point on them count as 0. Throws CallError if the number of coordinates is not a multiple
/// of 3 (badArgument), for meshes that inspect() throws it for, or if cancelled.
std::vector<double> generalizedWindingNumbers(const MeshView& mesh, std::span<const double> points, const RunOptions& options = {});

}  // namespace mandoline

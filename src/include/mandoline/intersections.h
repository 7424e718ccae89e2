// Triangles of a mesh that meet other than in shared vertices and whole shared edges.
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "mandoline/mesh.h"
#include "mandoline/status.h"

namespace MANDOLINE_API mandoline {

/// What to do about them.
enum class Intersections : uint8_t {
  resolve,    ///< cut as if the exact arrangement of the triangles had been given
  refuse,     ///< fail with selfIntersection, naming the first pair and the number of all
  assumeNone  ///< don't look: quicker, but the result may be wrong where triangles do meet
};

/// How two triangles meet.
enum class IntersectionKind : uint8_t {
  crossing,     ///< along a segment that runs through both
  touching,     ///< in a point, or along a segment on the outline of one
  overlapping,  ///< they lie in one plane and have an area in common
  folded,       ///< overlapping, of triangles that share an edge
  identical     ///< they have the same three vertices; CutStats::duplicateTriangles counts such triangles rather than pairs
};

/// How many pairs of triangles meet, by how they do.
struct PairCounts {
  uint64_t crossing = 0, touching = 0, overlapping = 0, folded = 0, identical = 0;

  PairCounts& operator+=(const PairCounts& more) {
    crossing += more.crossing;
    touching += more.touching;
    overlapping += more.overlapping;
    folded += more.folded;
    identical += more.identical;
    return *this;
  }
  uint64_t total() const { return crossing + touching + overlapping + folded + identical; }

  static void fields(auto& self, const auto& f) {
    f("crossing", self.crossing);
    f("touching", self.touching);
    f("overlapping", self.overlapping);
    f("folded", self.folded);
    f("identical", self.identical);
  }
};

/// All pairs of triangles that meet, exactly. Triangles without area are left out; the vertices that they put on the edges of their
/// neighbours count as shared.
struct MeshIntersections {
  PairCounts counts;  ///< of all pairs

  // The pairs, ascending: as many as were asked for.
  std::vector<uint32_t> pairTriangles;        ///< 2 per pair: the lower triangle first
  std::vector<uint8_t> pairKinds;             ///< per pair: IntersectionKind
  std::vector<uint32_t> pairPointOffsets{0};  ///< into positions (in points, not entries), per pair
  /// 3 per point, world units, rounded. What the two have in common: a point, the ends of a segment, or the corners of a convex polygon,
  /// counter-clockwise about the normal of the first.
  std::vector<double> positions;

  size_t pairCount() const { return pairKinds.size(); }

  static void fields(auto& self, const auto& f) {
    f("counts", self.counts);
    f("pairTriangles", self.pairTriangles);
    f("pairKinds", self.pairKinds);
    f("pairPointOffsets", self.pairPointOffsets);
    f("positions", self.positions);
  }
};

struct IntersectionOptions : RunOptions {
  size_t maxPairs = 100000;  ///< how many pairs are listed; all are counted
};

/// Throws CallError if cancelled, and for meshes that cut() refuses: emptyMesh, badArrays, badIndex, nonFiniteCoordinate, meshTooLarge.
MeshIntersections findIntersections(const MeshView& mesh, const IntersectionOptions& options = {});

}  // namespace mandoline

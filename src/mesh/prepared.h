// The mesh (paper, Algorithm 1 and Appendix A "Bad Input Meshes"): the part of a cut that does not depend on the grid. Checks the mesh,
// welds identical positions, drops triangles without area and duplicates, finds the unique tri-edges and where triangles meet.
//
// In: the user's mesh. Out: Prepared, or a Failure that names the offending element.
// After it: all coordinates are finite and scaled by one power of two, so that polynomials of them up to degree 7 neither overflow nor
// underflow; triangles refer to welded vertices; kept triangles have area, exactly.
#pragma once

#include <functional>
#include <limits>
#include <memory>

#include "base/shared.h"
#include "mandoline/intersections.h"
#include "mandoline/mesh.h"
#include "mesh/failure.h"
#include "mesh/parts.h"
#include "mesh/resolve/search_share.h"

namespace mandoline::detail {

struct MeshCounts {
  uint32_t weldedVertices = 0, zeroAreaTriangles = 0;
  uint32_t flushedCoordinates = 0;  ///< below 2^-200 of the largest, taken as 0
  uint64_t exactFallbacks = 0;
};

struct Prepared : WeldedMesh {
  int shift = 0;                    ///< scaled = world * 2^shift
  uint32_t triVertices = 0;         ///< made vertices follow in `points`, rounded
  std::vector<uint8_t> referenced;  ///< per tri-vertex: whether an input triangle has it
  MeshEdges edges;
  /// Where triangles meet, or null if they are assumed or required not to.
  std::unique_ptr<const Arrangement> arrangement;
  std::vector<PairContact> contacts;  ///< that it was made of, if they were to be kept
  Parts parts;
  MeshCounts counts;

  Prepared() = default;
  Prepared(const Prepared&) = delete;  // the arrangement refers to it

  bool isMade(VertexId v) const { return v.number >= triVertices; }
  bool hasIntersections() const { return arrangement && !arrangement->empty(); }
};

/// A power of two that brings coordinates into the range of exact arithmetic.
class Scale {
 public:
  explicit Scale(int shift)
      : factor_{std::ldexp(1.0, shift / 2), std::ldexp(1.0, shift - shift / 2)},  // a double can't hold 2^1194
        inverse_{1 / factor_[0], 1 / factor_[1]} {}

  /// Counts coordinates that are too small, and takes them as 0.
  double scaled(double x, uint32_t& flushed) const {
    x = x * factor_[0] * factor_[1] + 0.0;  // -0 becomes 0
    if (std::fabs(x) >= kFlushBelow || x == 0) return x;
    ++flushed;
    return 0.0;
  }
  double world(double x) const { return x * inverse_[0] * inverse_[1]; }
  /// Whether world() rounds none but numbers below kFlushBelow: what is left of them are normal numbers.
  bool isWorldExact() const { return kFlushBelow * inverse_[0] * inverse_[1] >= std::numeric_limits<double>::min(); }

  /// Scaled coordinates of a mesh are below 2^121 and multiples of 2^-133, or 0: degree 7 stays within 2^860 and 2^-931. Planes may be as
  /// much as 2^kRoom larger.
  static constexpr int kLargestExponent = 120, kRoom = 2;
  /// Smaller ones are taken as 0.
  static constexpr double kFlushBelow = 0x1p-80;

 private:
  double factor_[2], inverse_[2];
};

struct Preparation {
  double largest = 0;  ///< of all coordinates that are to be scaled, beside the mesh's
  Intersections intersections = Intersections::resolve;
  bool keepContacts = false;
  std::function<void()> meanwhile = {};  ///< what a thread of its own can do while vertices are welded
};

/// Makes room in the heaps of all threads that work on such a mesh, if it is large: in a small one's, most of a large page would not be
/// used.
void makeRoomFor(size_t triangles, const Monitor& monitor);

/// The input of a cut, checked, and how it is scaled.
struct CheckedMesh {
  std::vector<uint8_t> referenced;  ///< per tri-vertex
  int shift;                        ///< see Prepared
};
/// `largest` as of a Preparation.
MANDOLINE_SHARED CheckedMesh checkInput(const MeshView& mesh, double largest, Monitor& monitor);
/// The first third: the checked and welded mesh. `largest` and `meanwhile` as of a Preparation.
std::unique_ptr<Prepared> weldInput(const MeshView& mesh, double largest, Monitor& monitor, const std::function<void()>& meanwhile = {});
/// The same of a mesh that has moved since it was prepared, perhaps with other triangles.
std::unique_ptr<Prepared> weldAgain(const MeshView& mesh, double largest, const Prepared& before, Monitor& monitor);
/// The second: drops triangles without area; `some` as of dropZeroArea().
void dropFlat(Prepared& prepared, const std::vector<uint32_t>* some, Monitor& monitor, Predicates& predicates);
/// The third: its edges and, unless intersections are assumed to be none, where triangles meet.
void resolveInput(Prepared& prepared, const Preparation& preparation, Monitor& monitor, Predicates& predicates);
/// The same where several processes share the search: the pairs that meet in a share, those of all with what becomes of them, and between
/// these the edges, by findInputEdges(). A share that is not below the count searches nothing.
std::vector<TrianglePair> findPairs(const Prepared& prepared, const ShareOf& shareOf, Monitor& monitor, Predicates& predicates);
void resolvePairs(Prepared& prepared, const std::vector<TrianglePair>& pairs, const Preparation& preparation, Monitor& monitor,
                  Predicates& predicates);
/// Of a part of a mesh: finds its edges, but no parts, and whether no triangles are the same and none of those that `states` keep meet.
bool findEdgesIfPlain(Prepared& prepared, const std::vector<TriangleState>& states, Intersections intersections, Monitor& monitor,
                      Predicates& predicates);
/// Its parts. The edges of the mesh itself, which triangles are the same, and whether it is closed:
void findInputEdges(Prepared& prepared);
/// Once these and the contacts are known: the arrangement, and where any triangles meet its vertices and edges in the place
/// of the mesh's.
void arrangeInput(Prepared& prepared, Contacts contacts, bool keepContacts, Monitor& monitor, Predicates& predicates);

/// All. `beginStage` is called with "input" and "intersections".
std::unique_ptr<Prepared> prepareMesh(const MeshView& mesh, const Preparation& preparation, Monitor& monitor,
                                      const std::function<void(const char*)>& beginStage);

}  // namespace mandoline::detail

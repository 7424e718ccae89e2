// All pairs of triangles that meet other than in shared vertices and whole shared edges (paper, Appendix A "Bad Input Meshes").
#pragma once

#include "base/parallel.h"
#include "mandoline/intersections.h"
#include "mesh/resolve/charts.h"
#include "mesh/resolve/contact.h"
#include "mesh/resolve/triangle_tree.h"

namespace mandoline::detail {

struct PairContact {
  std::array<uint32_t, 2> triangles;  ///< ascending
  Contact contact;

  IntersectionKind kind() const;
  bool operator<(const PairContact& other) const { return triangles < other.triangles; }
};

/// Tests pairs of kept triangles. One per thread.
class PairTest {
 public:
  explicit PairTest(const WeldedMesh& mesh) : mesh_(mesh), finder_(mesh) {}

  /// How two triangles meet, if they do so other than in shared vertices and whole shared edges. The vertices of a stitched side count as
  /// shared.
  bool find(uint32_t s, uint32_t t, PairContact& pair);
  /// The same of any two, also of the same three vertices.
  bool meet(uint32_t s, uint32_t t);
  uint64_t fallbacks() const { return finder_.predicates.fallbacks; }

 private:
  const WeldedMesh& mesh_;
  ContactFinder finder_;
};

struct Contacts {
  std::vector<PairContact> pairs;  ///< of kept triangles, ascending
  PairCounts counts;               ///< of all pairs, those of duplicates too
};

/// The triangles, and those that may meet because their boxes overlap.
struct NearTriangles {
  SortedMesh mesh;
  TriangleTree tree;
  std::vector<TriangleTree::LeafPair> leaves;

  NearTriangles(SortedMesh sorted, const Charts& charts, Monitor& monitor);
};
NearTriangles findNear(SortedMesh mesh, Monitor& monitor);

/// Counts pairs, which are sorted.
Contacts contactsOf(const WeldedMesh& mesh, std::vector<PairContact> pairs);

/// Gives the lowest pairs, if there are more than `most`.
Contacts findContacts(const WeldedMesh& mesh, const NearTriangles& near, Monitor& monitor, Predicates& predicates, size_t most = SIZE_MAX);

}  // namespace mandoline::detail

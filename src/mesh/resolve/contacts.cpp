#include "mesh/resolve/contacts.h"

#include <cmath>

#include "base/keep_lowest.h"
#include "base/sort.h"

namespace mandoline::detail {
namespace {

/// The tri-vertices on a side of a triangle from one to another, both corners or stitched into the side; empty if either is neither.
std::vector<uint32_t> chainBetween(const WeldedMesh& mesh, uint32_t triangle, int side, uint32_t from, uint32_t to) {
  const auto& t = mesh.triangles[triangle];
  const auto [low, high] = std::minmax(t[size_t(side)], t[size_t(side + 1) % 3]);
  std::vector<uint32_t> chain{low};
  if (const Stitch* stitch = mesh.findStitch(low, high)) chain.insert(chain.end(), stitch->vertices.begin(), stitch->vertices.end());
  chain.push_back(high);
  auto first = std::find(chain.begin(), chain.end(), from), last = std::find(chain.begin(), chain.end(), to);
  if (first == chain.end() || last == chain.end()) return {};
  if (first > last) {
    std::reverse(chain.begin(), chain.end());
    first = std::find(chain.begin(), chain.end(), from);
    last = std::find(chain.begin(), chain.end(), to);
  }
  return {first, last + 1};
}

/// Whether two triangles have only vertices and edges on one side of each in common, which stitching makes shared ones.
bool isStitched(const WeldedMesh& mesh, const PairContact& pair) {
  if (mesh.stitches.empty() || pair.contact.hasArea()) return false;
  std::vector<uint32_t> chains[2];
  for (size_t which = 0; which < 2; ++which) {
    const int side = pair.contact.alongSide(int(which));
    if (side < 0) return false;
    const PointKey &from = pair.contact.corners[0].key, &to = pair.contact.corners[size_t(pair.contact.count) - 1].key;
    if (from.kind != PointKey::Kind::vertex || to.kind != PointKey::Kind::vertex) return false;
    chains[which] = chainBetween(mesh, pair.triangles[which], side, from.ids[0], to.ids[0]);
  }
  return !chains[0].empty() && chains[0] == chains[1];
}

/// Tells in doubles that others lie apart from a triangle: quickly, but without finding all that do.
class Quick {
 public:
  explicit Quick(const SortedMesh& mesh) : mesh_(mesh) {}

  void set(uint32_t triangle) {
    if (triangle == triangle_) return;
    triangle_ = triangle;
    const auto& v = mesh_.triangles[triangle];
    for (size_t i = 0; i < 3; ++i) corners_[i] = mesh_.points[v[i]];
    error_ = 0;
    for (size_t d = 0; d < 3; ++d) {
      const size_t p = (d + 1) % 3, q = (d + 2) % 3;
      const double left = (corners_[1][p] - corners_[0][p]) * (corners_[2][q] - corners_[0][q]),
                   right = (corners_[1][q] - corners_[0][q]) * (corners_[2][p] - corners_[0][p]);
      normal_[d] = left - right;
      // The height of a point is orient3d() with its terms in another order: Shewchuk's bound, and some room.
      error_ = std::max(error_, 9 * kRoundoff * (std::fabs(left) + std::fabs(right)));
    }
  }

  /// True if another triangle certainly meets this one only in shared vertices and whole shared sides.
  bool isApartFrom(uint32_t other) const { return isBeside(mesh_.triangles[other]) || isBesideSide(mesh_.triangles[other]); }

 private:
  using Corners = std::array<uint32_t, 3>;

  /// Whether all corners of the other, except shared ones, lie on one side of this triangle's plane.
  bool isBeside(const Corners& other) const {
    const Corners& mine = mesh_.triangles[triangle_];
    bool above = false, below = false;
    for (const uint32_t w : other) {
      if (w == mine[0] || w == mine[1] || w == mine[2]) continue;
      const Point& p = mesh_.points[w];
      const double x = p[0] - corners_[0][0], y = p[1] - corners_[0][1], z = p[2] - corners_[0][2];
      const double height = normal_[0] * x + normal_[1] * y + normal_[2] * z;
      if (!(std::fabs(height) > error_ * (std::fabs(x) + std::fabs(y) + std::fabs(z)))) return false;
      (height > 0 ? above : below) = true;
    }
    return !above || !below;
  }
  /// Whether, seen along an axis, all corners of the other but its ends lie beyond a side of this triangle.
  bool isBesideSide(const Corners& other) const {
    const Corners& mine = mesh_.triangles[triangle_];
    size_t d = 0;
    for (size_t e = 1; e < 3; ++e) {
      if (std::fabs(normal_[e]) > std::fabs(normal_[d])) d = e;
    }
    const size_t p = (d + (normal_[d] > 0 ? 1 : 2)) % 3, q = 3 - d - p;
    const auto seen = [&](const Point& corner) { return Point2{corner[p], corner[q]}; };
    const Point2 corners[3] = {seen(corners_[0]), seen(corners_[1]), seen(corners_[2])};
    if (!surelyTurnsLeft(corners[0], corners[1], corners[2])) return false;
    for (size_t i = 0; i < 3; ++i) {
      const size_t j = (i + 1) % 3;
      bool beyond = true;
      for (const uint32_t w : other) {
        if (w != mine[i] && w != mine[j]) beyond = beyond && surelyTurnsLeft(corners[j], corners[i], seen(mesh_.points[w]));
      }
      if (beyond) return true;
    }
    return false;
  }

  const SortedMesh& mesh_;
  uint32_t triangle_ = ~0u;
  std::array<Point, 3> corners_{};
  Point normal_{};
  double error_ = 0;
};

uint64_t& countOf(PairCounts& counts, IntersectionKind kind) {
  switch (kind) {
    case IntersectionKind::crossing:
      return counts.crossing;
    case IntersectionKind::touching:
      return counts.touching;
    case IntersectionKind::overlapping:
      return counts.overlapping;
    case IntersectionKind::folded:
      return counts.folded;
    case IntersectionKind::identical:
      break;
  }
  return counts.identical;
}

/// How many triangles a kept one stands for.
class Copies {
 public:
  explicit Copies(const WeldedMesh& mesh) {
    if (mesh.duplicates.empty()) return;
    counts_.assign(mesh.triangles.size(), 1);
    for (const Duplicate& d : mesh.duplicates) identicalPairs_ += counts_[d.original]++;
  }
  uint64_t of(uint32_t triangle) const { return counts_.empty() ? 1 : counts_[triangle]; }
  uint64_t identicalPairs() const { return identicalPairs_; }

 private:
  std::vector<uint32_t> counts_;
  uint64_t identicalPairs_ = 0;
};

struct Chunk {
  std::vector<PairContact> found;
  PairCounts counts;
  uint64_t fallbacks = 0;
};

}  // namespace

IntersectionKind PairContact::kind() const {
  if (contact.hasArea()) {
    int shared = 0;
    for (int i = 0; i < contact.count; ++i) {
      shared += contact.corners[size_t(i)].places[0].isCorner() && contact.corners[size_t(i)].places[1].isCorner();
    }
    return shared == 2 ? IntersectionKind::folded : IntersectionKind::overlapping;
  }
  const bool through = contact.count == 2 && contact.alongSide(0) < 0 && contact.alongSide(1) < 0;
  return through ? IntersectionKind::crossing : IntersectionKind::touching;
}

bool PairTest::find(uint32_t s, uint32_t t, PairContact& pair) {
  pair.triangles = {s, t};
  return finder_.find(s, t, pair.contact) && !isStitched(mesh_, pair);
}

bool PairTest::meet(uint32_t s, uint32_t t) {
  auto a = mesh_.triangles[s], b = mesh_.triangles[t];
  sortItems(a);
  sortItems(b);
  PairContact pair;
  return a == b || find(s, t, pair);
}

NearTriangles::NearTriangles(SortedMesh sorted, const Charts& charts, Monitor& monitor)
    : mesh(std::move(sorted)), tree(mesh, charts.chartOf, charts.triangles, monitor), leaves(tree.overlappingLeaves(monitor)) {}

NearTriangles findNear(SortedMesh mesh, Monitor& monitor) {
  const Charts charts = findCharts(mesh, monitor);
  return {std::move(mesh), charts, monitor};
}

Contacts contactsOf(const WeldedMesh& mesh, std::vector<PairContact> pairs) {
  Contacts contacts;
  const Copies copies(mesh);
  contacts.counts.identical = copies.identicalPairs();
  for (const PairContact& pair : pairs)
    countOf(contacts.counts, pair.kind()) += copies.of(pair.triangles[0]) * copies.of(pair.triangles[1]);
  contacts.pairs = std::move(pairs);
  sortItems(contacts.pairs);
  return contacts;
}

Contacts findContacts(const WeldedMesh& mesh, const NearTriangles& near, Monitor& monitor, Predicates& predicates, size_t most) {
  const SortedMesh& sorted = near.mesh;
  const TriangleTree& tree = near.tree;
  const std::vector<TriangleTree::LeafPair>& leaves = near.leaves;
  const Copies copies(mesh);
  const auto chunks = forChunks<Chunk>(
      leaves.size(), monitor,
      [&](Chunk& chunk, size_t begin, size_t end) {
        PairTest test(mesh);
        Quick first(sorted), second(sorted);
        PairContact pair;
        for (size_t i = begin; i < end; ++i) {
          tree.forOverlapping(leaves[i], [&](uint32_t i, uint32_t j) {
            first.set(i);
            if (first.isApartFrom(j)) return;
            second.set(j);
            if (second.isApartFrom(i)) return;
            const auto [s, t] = std::minmax(sorted.ids[i], sorted.ids[j]);
            if (!test.find(s, t, pair)) return;
            countOf(chunk.counts, pair.kind()) += copies.of(s) * copies.of(t);
            chunk.found.push_back(pair);
          });
          if (chunk.found.size() / 2 > most) keepLowest(chunk.found, most);
        }
        chunk.fallbacks += test.fallbacks();
      },
      256);
  Contacts contacts;
  contacts.counts.identical = copies.identicalPairs();
  for (const Chunk& chunk : chunks) {
    predicates.fallbacks += chunk.fallbacks;
    contacts.counts += chunk.counts;
    contacts.pairs.insert(contacts.pairs.end(), chunk.found.begin(), chunk.found.end());
  }
  keepLowest(contacts.pairs, most);
  sortItems(contacts.pairs);
  return contacts;
}

}  // namespace mandoline::detail

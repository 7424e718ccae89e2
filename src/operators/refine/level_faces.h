// The faces of leaves as they are found: which they are, and the cells on both sides. What they are made of is looked up when they are
// written.
#pragma once

#include "operators/refine/chains.h"
#include "operators/refine/shared_ids.h"

namespace mandoline::refining {

/// What there is of the leaves.
struct Sources {
  const OctreeCells& leaves;
  const Parts& parts;
  const SharedIds& ids;
  const CutMesh& whole;  ///< the cut of the grid
};

struct Side {
  uint32_t leaf;
  uint8_t axis, side;

  uint64_t key() const { return 6 * uint64_t(leaf) + 2 * axis + side; }
};

/// A face of a part, or a whole side of a leaf.
struct LevelFace {
  static constexpr uint32_t kNone = ~0u;

  uint32_t part = kNone;  ///< kNone of a whole side
  uint32_t face = 0;      ///< of the part
  Side side{};            ///< of pieces of triangles inside of the leaf: any
  bool isBesideLarger = false;
  std::array<int32_t, 2> cells{};

  bool isWhole() const { return part == kNone; }
};

/// The faces of the leaves of one level that no smaller ones are beside, by leaf, then those inside before those on its sides.
struct LevelFaces {
  std::vector<LevelFace> faces;
  Chains extras;  ///< vertices on the edges of blocks of this level, where these are untouched
  Chains chains;  ///< those of smaller cells

  /// Those on a side.
  std::pair<size_t, size_t> on(const Side& side) const {
    const auto isBefore = [](const LevelFace& face, uint64_t key) { return face.side.key() < key; };
    const auto first = std::lower_bound(faces.begin(), faces.end(), side.key(), isBefore),
               past = std::lower_bound(first, faces.end(), side.key() + 1, isBefore);
    return {size_t(first - faces.begin()), size_t(past - faces.begin())};
  }
};

/// The corners of a side of a leaf.
inline std::array<uint32_t, 4> cornersOf(const Sources& sources, const Side& side) {
  const Block low = sources.leaves.corner(side.leaf), high = sources.leaves.end(side.leaf);
  const size_t u = (side.axis + 1u) % 3, v = (side.axis + 2u) % 3;
  Block at = low;
  at[side.axis] = (side.side ? high : low)[side.axis];
  std::array<uint32_t, 4> corners;
  for (size_t i = 0; i < 4; ++i) {
    at[u] = (i == 1 || i == 2 ? high : low)[u];
    at[v] = (i >= 2 ? high : low)[v];
    corners[i] = sources.ids.ofGridVertex(at);
  }
  return corners;
}

/// Calls visit(from, to) for each edge of some loops.
template <class Range, class Visit>
void forEdges(const Range& loops, const Visit& visit) {
  for (const std::span<const uint32_t> loop : loops) {
    for (size_t i = 0; i < loop.size(); ++i) visit(loop[i], loop[i + 1 < loop.size() ? i + 1 : 0]);
  }
}

/// The loops of faces, in ids of SharedIds.
class LoopMaker {
 public:
  LoopMaker(const Sources& sources, const LevelFaces& level) : sources_(sources), level_(level) {}

  /// Calls visit(loop) for those of a face, with all vertices on their edges.
  template <class Visit>
  void forLoops(const LevelFace& face, const Visit& visit) {
    forLargeLoops(face, [&](std::span<const uint32_t> loop) {
      loop_.clear();
      level_.chains.append(loop, loop_);
      visit(std::span<const uint32_t>(loop_));
    });
  }
  /// Without those of smaller cells.
  template <class Visit>
  void forLargeLoops(const LevelFace& face, const Visit& visit) {
    if (face.isWhole()) {
      large_.clear();
      level_.extras.append(cornersOf(sources_, face.side), large_);
      return visit(std::span<const uint32_t>(large_));
    }
    for (const auto loop : sources_.parts[face.part].cutMesh().loops(face.face)) {
      large_.clear();
      for (const uint32_t v : loop) large_.push_back(sources_.ids.of(face.part, v));
      visit(std::span<const uint32_t>(large_));
    }
  }

 private:
  const Sources& sources_;
  const LevelFaces& level_;
  std::vector<uint32_t> large_, loop_;
};

}  // namespace mandoline::refining

// One complex of the leaves: level by level, from the smallest blocks on, so that faces of smaller cells are known where larger ones meet
// them.
#pragma once

#include <optional>

#include "operators/cell_complex/octree_index.h"
#include "operators/refine/face_list.h"
#include "operators/refine/shared_ids.h"
#include "operators/refine/side_matcher.h"

namespace mandoline::refining {

/// What the leaves' cells and faces are, in ids of SharedIds.
struct Assembled {
  std::vector<BlockCells> leafCells;  ///< per leaf; none if it is untouched
  std::vector<uint32_t> firstCells;   ///< per leaf: its only or first cell
  uint32_t cutCells = 0, cells = 0;
  FaceList cut;    ///< of cut-cells
  FaceList plain;  ///< between untouched blocks
};

class Assembly {
 public:
  /// `planes`: those of the smallest cells.
  Assembly(const OctreeCells& leaves, const Parts& parts, SharedIds& ids, const std::array<std::vector<double>, 3>& planes);
  Assembled run(detail::Monitor& monitor);

 private:
  static constexpr int32_t kPending = -2;  // a larger block's cell that is found later
  static constexpr uint32_t kNone = SharedIds::kNone;

  struct Side {
    size_t leaf, axis;
    int side;

    uint64_t key() const { return 6 * uint64_t(leaf) + 2 * axis + uint64_t(side); }
  };
  /// A face of the current level: of a part, or a whole side of a leaf.
  struct LevelFace {
    const Part* part;
    uint32_t number;  ///< of the part
    uint32_t face;
    Side side;
    std::array<int32_t, 2> cells;
    bool isBesideLarger;
    std::array<uint32_t, 4> corners;  ///< of a whole side
  };
  /// A face that a larger block is beside.
  struct Beside {
    uint64_t side;
    uint32_t face;
    bool isPlain;
    bool operator<(const Beside& b) const { return side < b.side; }
  };

  void numberCells();
  void addLevel(int level);
  void addExtras(int level);
  void addInnerFaces(size_t leaf);
  void addSide(const Side& side);
  void addFacesOf(const Side& side, const BlockCells& from, int64_t other);
  int32_t cellAcross(const LevelFace& face, const BlockCells& own, const BlockCells& other) const;
  int32_t cellOf(const BlockCells& cells, int32_t cell) const;
  Block neighbour(const Side& side) const;
  int64_t leafAt(const Block& at) const;
  BlockCells blockAt(const Block& at, int level) const;
  void markLarge(const Side& side);
  void markLarge(uint32_t id);
  void matchSide(const Side& side);
  void addSurfaceEdges(const BlockCells& cells, const Side& side);
  void write(const LevelFace& face);
  void writePlain(const LevelFace& face, FaceList& to);
  void writePart(const LevelFace& face, FaceList& to);
  std::array<uint32_t, 4> cornersOf(const Side& side);
  const std::vector<uint32_t>& plainLoop(const LevelFace& face);

  const OctreeCells& leaves_;
  const Parts& parts_;
  SharedIds& ids_;
  const std::array<std::vector<double>, 3>& planes_;
  operators::OctreeIndex index_;
  std::vector<std::vector<int32_t>> cellIds_;  // per part and cut-cell: its id, or -1
  std::vector<LevelFace> faces_;               // of the current level
  std::vector<Side> sides_;                    // of the current level, that smaller blocks are beside
  std::vector<Beside> besides_, nextBesides_;  // of the level before, and of the current one
  std::vector<uint8_t> isLarge_;               // per vertex: whether faces of the current level have it
  std::vector<uint32_t> large_;                // these
  Chains extras_;                              // vertices on the edges of blocks of the current level, where these are untouched
  std::optional<Chains> chains_;               // those of smaller cells
  SideMatcher matcher_;
  std::vector<uint32_t> loop_;
  Assembled result_;
};

}  // namespace mandoline::refining

// The faces of the leaves: level by level, from the smallest blocks on, so that faces of smaller cells are known where larger ones meet
// them.
#pragma once

#include "operators/cell_complex/octree_index.h"
#include "operators/refine/level_faces.h"
#include "operators/refine/side_matcher.h"

namespace mandoline::refining {

/// What the leaves' cells and faces are.
struct Assembled {
  static constexpr uint32_t kNone = ~0u;

  /// The cut-cells of a leaf.
  struct LeafCells {
    uint32_t part = kNone;  ///< kNone if it is untouched
    uint32_t begin = 0, end = 0;
  };
  std::vector<LeafCells> leafCells;
  std::vector<uint32_t> firstCells;  ///< per leaf: its only or first cell
  uint32_t cutCells = 0, cells = 0;
  std::vector<LevelFaces> levels;

  BlockCells cellsOf(const Parts& parts, size_t leaf) const {
    const LeafCells& cells = leafCells[leaf];
    if (cells.part == kNone) return {};
    return {&parts[cells.part], cells.part, {cells.begin, cells.end}};
  }
};

class Assembly {
 public:
  Assembly(const Sources& sources, detail::Monitor& monitor);
  Assembled run();

 private:
  static constexpr int32_t kPending = -2;  // a larger block's cell that is found later
  static constexpr uint32_t kNone = SharedIds::kNone;

  /// What some leaves have.
  struct Found {
    std::vector<LevelFace> faces;
    std::vector<Side> sides;  // that smaller blocks are beside
  };
  /// What some sides that smaller blocks are beside have.
  struct Matched {
    ChainList chains;
    SideMatcher matcher;
    std::vector<size_t> besides;  // faces of smaller blocks on the current side
  };

  void numberCells();
  void addLevel(int level, std::span<const uint32_t> leaves);
  void addExtras(int level, Chains& extras) const;
  void addExtras(size_t part, ChainList& extras) const;
  void addInnerFaces(uint32_t leaf, Found& found) const;
  void addSide(const Side& side, Found& found) const;
  int32_t cellAcross(const LevelFace& face, const BlockCells& own, const BlockCells& other) const;
  int32_t cellOf(const BlockCells& cells, int32_t cell) const;
  BlockCells cellsOf(size_t leaf) const { return result_.cellsOf(parts_, leaf); }
  Block neighbour(const Side& side) const;
  int64_t leafAt(const Block& at) const;
  BlockCells blockAt(const Block& at, int level) const;

  // Where blocks meet smaller ones.
  void matchLevel(const std::vector<Side>& sides);
  std::vector<uint8_t> largeVertices(const std::vector<Side>& sides) const;
  void matchSide(const Side& side, const std::vector<uint8_t>& isLarge, Matched& matched);
  void addSmallFaces(const Side& side, Matched& matched) const;
  void addLargeFaces(const Side& side, Matched& matched) const;
  void addSurfaceEdges(const BlockCells& cells, const Side& side, SideMatcher& matcher) const;

  const Sources& sources_;
  const OctreeCells& leaves_;
  const Parts& parts_;
  const SharedIds& ids_;
  detail::Monitor& monitor_;
  operators::OctreeIndex index_;
  std::vector<std::vector<int32_t>> cellIds_;  // per part and cut-cell: its id, or -1
  Assembled result_;
};

}  // namespace mandoline::refining

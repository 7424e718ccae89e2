// Cells that clusters give to others, where faces between them are bad: too far from perpendicular to the line between the centroids, or
// too near to one of these.
#pragma once

#include "operators/merge/clusters.h"

namespace mandoline::merging {

class Exchanges {
 public:
  /// Keeps references.
  Exchanges(const CellComplex& cells, Clusters& clusters);

  /// Gives cells to other clusters as long as faces get better. Clusters that are large enough stay so, and in one piece: cells that
  /// would be cut off from theirs go along.
  void run(detail::Monitor& monitor);

 private:
  /// What is tried: a cell that moves, two one after the other, or all of a cluster.
  enum class Kind { single, pairs, whole };
  struct Move {
    uint32_t cell = 0;
    uint32_t to = 0;       ///< a cell of the cluster that gets it: what stands for clusters may change
    bool isWhole = false;  ///< whether all of the cell's cluster goes
    auto operator<=>(const Move&) const = default;
  };

  uint32_t across(uint32_t halfFace) const;
  uint32_t clusterAcross(uint32_t halfFace) const;
  double badness(uint32_t halfFace, const Vector& from, const Vector& to) const;
  bool sweep(Kind kind, detail::Monitor& monitor);
  bool improveFace(uint32_t face, Kind kind);
  bool improve(uint32_t cell, Kind kind);
  bool improveTwice(uint32_t cell);
  void findBest(double& most, Move& best);
  void make(const Move& move);
  void findMoves(uint32_t cluster, Kind kind);
  double gain(const Move& move);
  void divide(const Move& move, uint32_t from);
  bool isSeparated(uint32_t from, uint32_t to) const;
  bool stays(uint32_t cell) const { return seen_[cell] == now_; }
  double badnessOf(uint32_t from, uint32_t to, const Cluster (&both)[2], bool isAfter) const;

  static constexpr uint32_t kNone = ~0u;
  static constexpr double kNotPossible = -1e300;
  const CellComplex& cells_;
  Clusters& clusters_;
  std::vector<Move> moves_;
  std::vector<uint32_t> seen_;        // per cell: the last stamp at which it stayed in the cluster that gives
  std::vector<uint32_t> stack_;       // of cells
  std::vector<uint32_t> members_[2];  // of the cluster that gives, and of the other, after a move
  uint32_t now_ = 0;
};

}  // namespace mandoline::merging

// Which cells of a complex become one: the decisions of mergeSmallCells().
#pragma once

#include <algorithm>

#include "base/parallel.h"
#include "mandoline/merge.h"

namespace mandoline::merging {

using Vector = std::array<double, 3>;

/// Faces whose normals are at most 60 degrees from the line between centroids are all fine.
inline constexpr double kFineCosine = 0.5;

/// Cells that become one.
struct Cluster {
  double volume;
  double unit;    ///< volume of its base's grid cell or octree cell
  uint32_t base;  ///< see mergeSmallCells()
  Vector centroid;
  std::array<int32_t, 3> low, past;  ///< the box of the grid cells of all members
};

class Clusters {
 public:
  Clusters(const CutMesh& cutMesh, const CellComplex& cells, double fraction);

  /// Joins small clusters with others until none is small, or none of those can join another.
  void join(detail::Monitor& monitor);
  /// Joins these, whatever they are like, in the place of that.
  void join(std::span<const std::array<uint32_t, 2>> pairs);

  uint32_t clusterOf(uint32_t cell) const { return clusterOf_[cell]; }
  const Cluster& operator[](uint32_t cluster) const { return clusters_[cluster]; }
  bool isSmall(double volume, double unit) const { return volume < fraction_ * unit; }
  bool isSmall(const Cluster& cluster) const { return isSmall(cluster.volume, cluster.unit); }
  bool hasRoom(const Cluster& cluster) const { return cluster.volume <= most_ * cluster.unit; }
  /// What a cluster may have that has the base of one of two.
  double mostVolume(const Cluster& a, const Cluster& b) const { return most_ * std::max(a.unit, b.unit); }
  bool isOctreeCell(uint32_t cell) const { return cell >= cells_.cutCells; }
  /// What the cluster of both would be.
  Cluster joined(const Cluster& a, const Cluster& b) const;
  /// What the cluster of some cells would be. Sorts them.
  Cluster madeOf(std::span<uint32_t> members) const;
  /// Makes a cluster of each, of cells that were in two others. Sorts them.
  void divide(std::span<uint32_t> a, std::span<uint32_t> b);

  template <class Visit>
  void forEachMember(uint32_t cluster, const Visit& visit) const {
    for (uint32_t c = cluster;;) {
      visit(c);
      c = next_[c];
      if (c == cluster) return;
    }
  }

 private:
  /// A face through which a cluster could join another.
  struct Way {
    uint32_t halfFace, cluster;
  };
  /// A cluster that the current one could join.
  struct Choice {
    uint32_t cluster;
    bool isSmall;
    double area;
    bool isCompact;  ///< whether no member would be farther from the base than the next grid cell
    double cosine;   ///< of the largest angle that counts
  };

  double gridCellVolume(uint32_t cell) const;
  Cluster singleCell(uint32_t cell) const;
  int32_t endOf(uint32_t cell, size_t axis) const { return cells_.cellCorner[3 * size_t(cell) + axis] + (1 << cells_.cellLevel[cell]); }
  bool isCompact(const Cluster& cluster) const;
  bool isBetterBase(uint32_t a, uint32_t b) const;
  void joinFilms();
  uint32_t chooseLarge(uint32_t cluster);
  void findWays(uint32_t cluster);
  bool canJoin(uint32_t a, uint32_t b) const;
  double cosineAfter(uint32_t cluster, uint32_t other) const;
  static bool isBetter(const Choice& a, const Choice& b);
  bool joinSmall(bool onlyLarge, detail::Monitor& monitor);
  uint32_t choose(uint32_t cluster, bool onlyLarge);
  uint32_t unite(uint32_t a, uint32_t b);

  static constexpr uint32_t kNone = ~0u;
  const CutMesh& cutMesh_;
  const CellComplex& cells_;
  const double fraction_, most_;
  std::vector<uint32_t> clusterOf_;  // per cell: a cell of its cluster, which stands for it
  std::vector<uint32_t> next_;       // per cell: another of its cluster, in a ring
  std::vector<uint32_t> size_;       // per cluster
  std::vector<Cluster> clusters_;
  std::vector<Way> ways_;            // of the current cluster
  std::vector<Choice> choices_;      // the same
  std::vector<uint32_t> place_;      // per cluster: place of its choice, if it has the current stamp
  std::vector<uint32_t> stamp_;      // per cluster
  std::vector<uint32_t> separated_;  // per cluster: the last stamp at which a triangle was between it and the current one
  uint32_t now_ = 0;
};

}  // namespace mandoline::merging

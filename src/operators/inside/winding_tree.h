// Generalized winding numbers (Jacobson, Kavan, Sorkine-Hornung 2013): sums of solid angles, in less than linear time and as exact as the
// plain sum.
//
// Seen from far enough, triangles may be replaced by any others with the same boundary: each node of a tree of boxes knows the directed
// edges that are left of its triangles' boundaries, and stands for them by a fan over these.
#pragma once

#include <span>
#include <vector>

#include "base/box_tree.h"
#include "mandoline/mesh.h"

namespace mandoline::operators {

class TurnSum;

class WindingTree {
 public:
  /// Of some triangles of a mesh, which must have its vertices. Coordinates are taken as they are.
  WindingTree(const MeshView& mesh, std::span<const uint32_t> triangles);

  /// The sum of the signed solid angles of the triangles, seen from p, in whole spheres: 1 inside of what is closed and oriented outwards.
  /// A triangle with p on it counts as 0, the mean of its sides; so do those that are left out.
  double at(const detail::Point& p, std::span<const uint32_t> leftOut = {}) const;

  /// How many edges bound the triangles.
  size_t rimSize() const { return rim_.size(); }
  /// How much at() differs at most between two points of a box, but for a whole number: that of the triangles on the line between them.
  /// Infinite if an edge that bounds the triangles may lie in the box. Takes time in proportion to these edges.
  double variation(const detail::Box& box) const;
  /// How at() changes on the way from one point to another, in a box without edges that bound the triangles, if no triangle is on the way.
  /// Takes time in proportion to these edges.
  double change(const detail::Point& from, const detail::Point& to) const;

 private:
  /// A directed edge that bounds a node's triangles so often, or against its direction if that is negative.
  struct Edge {
    uint32_t low, high;
    int32_t count;
  };
  /// One that bounds all triangles.
  struct RimEdge {
    Edge edge;
    detail::Box box;
    double weight;  ///< its length times how often it bounds them
  };
  struct Triangle {
    std::array<uint32_t, 3> corners;
    uint32_t id;
  };
  /// In depth-first order, so that past a node comes what is not below it.
  struct Node {
    detail::Box box;
    uint32_t begin, end, past;
    uint32_t firstEdge = 0, endEdge = 0;
    bool hasFan = false;  ///< its edges are fewer than its triangles, and stored
  };

  void addTriangles(const MeshView& mesh, std::span<const uint32_t> triangles);
  std::vector<Edge> addNode(uint32_t begin, uint32_t end);
  std::vector<Edge> edgesOf(const Node& leaf) const;
  void addRim(const std::vector<Edge>& edges);
  detail::Point scaled(const detail::Point& p) const { return {p[0] * scale_, p[1] * scale_, p[2] * scale_}; }
  bool isFar(const Node& node, const detail::Point& p) const;
  void addFan(const Node& node, const detail::Point& p, TurnSum& sum) const;

  double scale_ = 1;  ///< a power of two that brings coordinates to at most 1
  std::vector<detail::Point> points_;
  std::vector<Triangle> triangles_;  // along a space-filling curve
  std::vector<Node> nodes_;
  std::vector<Edge> edges_;
  std::vector<RimEdge> rim_;
};

}  // namespace mandoline::operators

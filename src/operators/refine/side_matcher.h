// A side of a block that smaller blocks are beside: which of its cells is behind each of their faces, and which vertices they have on
// the edges of its faces. No coordinates: both are cuts of the same plane, so edges of faces of the larger cells are chains of edges of
// smaller faces.
#pragma once

#include "base/disjoint_sets.h"
#include "operators/refine/chains.h"

namespace mandoline::refining {

class SideMatcher {
 public:
  void clear();

  // What is on the side. Faces have the edges from .. to on their left; `parents`: the triangles that they are pieces of.
  /// Begins a face of smaller cells. Gives its place.
  size_t addFace(std::span<const uint32_t> parents);
  /// Of the last one.
  void addEdge(uint32_t from, uint32_t to) { edges_.push_back({from, to, uint32_t(classes_.size() - 1)}); }
  /// An edge of a face of the larger block, if that is cut, and the face's cell.
  void addLargeEdge(uint32_t from, uint32_t to, std::span<const uint32_t> parents, int32_t cell);
  /// An edge of a triangle that ends here or passes through.
  void addSurfaceEdge(uint32_t a, uint32_t b) { surface_.push_back({std::min(a, b), std::max(a, b)}); }

  /// `isLarge`: per vertex whether it is one of larger cells. Adds chains between those.
  void run(const std::vector<uint8_t>& isLarge, ChainList& chains);
  /// The larger block's cell behind a face of smaller ones; -1 if there is no edge of the larger block's faces around it.
  int32_t cellBehind(size_t face) { return cells_[sets_.find(uint32_t(face))]; }

 private:
  struct Edge {
    uint32_t from, to, face;
    bool operator<(const Edge& e) const { return from != e.from ? from < e.from : to != e.to ? to < e.to : face < e.face; }
  };
  struct LargeEdge {
    uint32_t from, to, kind;
    int32_t cell;
    bool operator<(const LargeEdge& e) const { return from != e.from ? from < e.from : to != e.to ? to < e.to : kind < e.kind; }
  };
  using Pair = std::array<uint32_t, 2>;

  uint32_t kindOf(std::span<const uint32_t> parents);
  void joinFaces();
  bool joinAcross(const Edge& edge);
  std::span<const Pair> linksOf(uint32_t vertex) const;
  void trace(uint32_t from, uint32_t next, const std::vector<uint8_t>& isLarge, ChainList& chains);
  void match(uint32_t from, uint32_t next, uint32_t to);

  std::vector<Edge> edges_;
  std::vector<LargeEdge> largeEdges_;
  std::vector<Pair> surface_;      // lower vertex first
  std::vector<Pair> links_;        // edges that are, or may be, parts of edges of the larger block's faces: both ways
  std::vector<uint32_t> classes_;  // per face: the number of its parents
  detail::Csr<uint32_t> kinds_;    // the parents of each number
  detail::DisjointSets sets_;      // of faces in one of the larger block's
  std::vector<int32_t> cells_;     // per set
  std::vector<uint32_t> chain_;    // the current one
};

}  // namespace mandoline::refining

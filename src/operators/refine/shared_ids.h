// Vertices of several cuts that are the same, by what they come from.
#pragma once

#include "base/disjoint_sets.h"
#include "base/ranked_set.h"
#include "operators/refine/parts.h"

namespace mandoline::refining {

class SharedIds {
 public:
  static constexpr uint32_t kNone = ~0u;

  /// The parts have to outlive this. Grid vertices are those of the parts and the corners of leaves.
  SharedIds(const MeshView& mesh, const Parts& parts, const OctreeCells& leaves, detail::Monitor& monitor);

  uint32_t of(size_t part, uint32_t vertex) const { return ids_[firstVertices_[part] + vertex]; }
  uint32_t ofGridVertex(const Block& at) const { return gridIds_[gridVertices_.rankOf(numberOf(at))]; }
  size_t size() const { return sources_.size() + numbers_.size(); }

  /// Where a vertex is described: in the part of the smallest blocks that has it, or a grid vertex.
  struct Source {
    uint32_t part;  ///< kNone if it is no cut-vertex
    uint32_t vertex;
    Block at;
  };
  Source sourceOf(uint32_t id) const;

 private:
  struct CutVertex {
    uint32_t part, vertex;
  };
  uint64_t numberOf(const Block& at) const;
  void unite(const MeshView& mesh, const Parts& parts, detail::Monitor& monitor);
  void numberGridVertices(const Parts& parts, const OctreeCells& leaves);

  const std::array<int32_t, 3> gridCells_;
  std::vector<size_t> firstVertices_;  // per part
  std::vector<uint32_t> ids_;          // per vertex of each part
  std::vector<CutVertex> sources_;     // per id of a cut-vertex
  detail::RankedSet gridVertices_;     // by their numbers
  std::vector<uint32_t> gridIds_;      // by their ranks
  std::vector<uint64_t> numbers_;      // of the grid vertices that have the ids after those of cut-vertices
};

}  // namespace mandoline::refining

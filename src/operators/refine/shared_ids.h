// Vertices of several cuts that are the same, by what they come from.
#pragma once

#include "base/disjoint_sets.h"
#include "base/key_numbers.h"
#include "operators/refine/parts.h"

namespace mandoline::refining {

class SharedIds {
 public:
  static constexpr uint32_t kNone = ~0u;

  /// The parts have to outlive this.
  SharedIds(const MeshView& mesh, const Parts& parts, const std::array<int32_t, 3>& gridCells);

  uint32_t of(size_t part, uint32_t vertex) const { return ids_[firstVertices_[part] + vertex]; }
  /// That of a grid vertex, a new one if no part has it.
  uint32_t ofGridVertex(const Block& at);
  size_t size() const { return sources_.size(); }

  /// Where a vertex is described: in the part of the smallest blocks that has it, or a grid vertex.
  struct Source {
    uint32_t part;  ///< kNone if it is no cut-vertex
    uint32_t vertex;
    Block at;
  };
  const Source& sourceOf(uint32_t id) const { return sources_[id]; }

 private:
  uint64_t numberOf(const Block& at) const;

  const std::array<int32_t, 3> gridCells_;
  std::vector<size_t> firstVertices_;  // per part
  std::vector<uint32_t> ids_;          // per vertex of each part
  std::vector<Source> sources_;        // per id
  detail::KeyNumbers gridVertices_;
  std::vector<uint32_t> gridIds_;  // by their numbers there
};

}  // namespace mandoline::refining

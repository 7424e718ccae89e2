// Faces between the same cells that become one: faces grow, one after the other, by those beside them, and keep one simple loop.
#pragma once

#include "base/csr.h"
#include "base/function_ref.h"
#include "base/parallel.h"
#include "mandoline/cell_complex.h"

namespace mandoline::merging {

/// What is to become of a face.
enum class Fate : uint8_t {
  goes,   ///< vanishes
  stays,  ///< as it is
  joins   ///< may join others
};

/// The new faces, in the order of their first members.
struct JoinedFaces {
  detail::Csr<uint32_t> members;  ///< per new face, ascending
  detail::Csr<uint32_t> loops;    ///< per new face of several members: its loop; else empty
};

/// Keeps a reference to the cells.
class FaceJoiner {
 public:
  FaceJoiner(const CellComplex& cells, const std::vector<Fate>& fates);

  /// Edges inside a new face have no other faces. `fates`: the same as before, but faces that may join others may have become ones that
  /// stay. `mayJoin(first, face)`: whether the new face that begins with `first` may have `face`.
  JoinedFaces join(const std::vector<Fate>& fates, detail::FunctionRef<bool(uint32_t, uint32_t)> mayJoin);

 private:
  struct Edge {
    uint32_t high, face;
    uint32_t corner;  ///< where it begins in the loop
    bool ascends;
  };

  std::span<const uint32_t> loop(uint32_t face) const { return cells_.loops(face)[0]; }

  /// Calls visit(from, to, corner) for each edge of a face's loops.
  template <class Visit>
  void forEachEdge(uint32_t face, const Visit& visit) const {
    for (uint32_t l = cells_.faceLoopOffsets[face]; l < cells_.faceLoopOffsets[face + 1]; ++l) {
      const uint32_t begin = cells_.loopOffsets[l], end = cells_.loopOffsets[l + 1];
      for (uint32_t i = begin; i < end; ++i) visit(cells_.loopVertices[i], cells_.loopVertices[i + 1 < end ? i + 1 : begin], i);
    }
  }

  bool isSimple(uint32_t face, std::vector<uint32_t>& lastFace) const;
  void findMates(const std::vector<Fate>& fates, const std::vector<uint8_t>& isNear);
  void pair(const Edge& a, const Edge& b);
  void grow(uint32_t first, detail::FunctionRef<bool(uint32_t, uint32_t)> mayJoin);
  void addToBoundary(uint32_t from, uint32_t to, uint32_t first);
  bool take(uint32_t face, uint32_t first);
  void addLoop(uint32_t first, std::vector<uint32_t>& loops) const;

  static constexpr uint32_t kNone = ~0u;
  const CellComplex& cells_;
  std::vector<uint8_t> joins_;        // per face
  std::vector<uint32_t> mates_;       // per corner of a loop: the only other face at the edge that begins there, if both may join others
  std::vector<uint32_t> first_;       // per face: the first member of its new face, once it has one
  std::vector<uint32_t> members_;     // of the new face that grows
  std::vector<uint32_t> boundaryOf_;  // per vertex: the first member of the new face that grew last with the vertex on its boundary
  std::vector<uint32_t> next_;        // per vertex: the one after it on that boundary
  size_t boundarySize_ = 0;
};

/// Fills in the new faces. Their cells are those that the first members had.
void replaceFaces(const CellComplex& cells, const JoinedFaces& faces, CellComplex& result, detail::Monitor& monitor);

}  // namespace mandoline::merging

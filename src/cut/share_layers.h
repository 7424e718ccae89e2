// Which layers of the grid each of several processes cuts: they are to be alike in work, as far as that is known from where the triangles
// lie, before anything is cut.
#pragma once

#include "cut/stages/output_part.h"

namespace mandoline::detail {

struct SlabRange {
  int32_t least, greatest;
};
/// The slabs of a triangle's corners along an axis.
SlabRange slabsOf(const Input& input, TriangleId t, size_t axis);

/// About how much work triangles are, per layer of grid cells along z: as many faces as they may have part in, and more where others reach
/// into them. For most meshes it foretells within about 8 % how much more instructions the busiest share takes than the average.
class LayerWork {
 public:
  /// Of the input its planes.
  explicit LayerWork(const Input& input);
  /// A triangle by the slabs of its corners. `inner`: what others have in its inside, vertices and edges, if they reach into it.
  void add(const Slab& a, const Slab& b, const Slab& c, std::optional<size_t> inner = {});
  std::vector<uint64_t> perLayer() const;

 private:
  std::array<int32_t, 3> cells_;
  std::vector<int64_t> changes_;  // of the work from a layer to the next
};
/// That of every triangle, or every so many: the same in all processes.
std::vector<uint64_t> workOfLayers(const Input& input, uint32_t every = 1);

/// The layers of `count` shares: as even in work as whole layers can be.
class ShareLayers {
 public:
  /// `work`: that of workOfLayers(input), of which its planes are enough here.
  ShareLayers(const Input& input, const std::vector<uint64_t>& work, uint32_t count);

  /// Of bricks, as a BrickGrid has them: small enough for several threads of each process.
  const std::array<int, 3>& shifts() const { return shifts_; }
  /// The first layers of all shares, and where the last ends: with each of them bricks begin anew.
  const std::vector<int32_t>& borders() const { return first_; }
  /// The first layer of grid cells of a share, where those of the share before end.
  int32_t first(uint32_t share) const { return first_[share]; }
  CellLayers of(uint32_t share) const { return {first_[share], first_[share + 1]}; }

 private:
  std::array<int, 3> shifts_;
  std::vector<int32_t> first_;  // per share, and where the last ends
};

/// Whether a kept triangle reaches into layers, or to their boundary.
bool isInLayers(const Input& input, TriangleId t, const CellLayers& layers);

/// Leaves to a state that has its input, and whose layers are known, only what lies in these.
void takeSurface(CutState& state);

}  // namespace mandoline::detail

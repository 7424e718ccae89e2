// Patches of a mesh: triangles that hang together through edges with two triangles, turned so that they agree.
#pragma once

#include "base/csr.h"
#include "mesh/edge_uses.h"

namespace mandoline::detail {

struct Patches {
  std::vector<int32_t> patchOf;     ///< per triangle; -1 without three different vertices. In the order of their first triangles
  std::vector<uint8_t> turned;      ///< per triangle: whether it is turned to agree with the first one of its patch
  std::vector<uint8_t> orientable;  ///< per patch; of those that are not, no triangle is turned

  size_t count() const { return orientable.size(); }
  bool has(uint32_t triangle) const { return patchOf[triangle] >= 0; }
  uint32_t of(uint32_t triangle) const { return uint32_t(patchOf[triangle]); }
};

Patches findPatches(const std::vector<Corners>& triangles, std::span<EdgeUse> uses);

/// The triangles of each patch.
Csr<uint32_t> trianglesOf(const Patches& patches);

/// Patches that bound a volume.
struct Shells {
  std::vector<int32_t> shellOf;   ///< per patch; -1 if it is open
  std::vector<uint8_t> isSingle;  ///< per shell: whether it is one patch, which closes every edge by itself; else several do so together

  size_t count() const { return isSingle.size(); }
};

/// First, each orientable patch whose directed edges cancel. Then, sets of the other orientable patches that hang together through edges,
/// if at each edge the set has an even number of triangles.
Shells findShells(const Patches& patches, std::span<EdgeUse> uses);

}  // namespace mandoline::detail

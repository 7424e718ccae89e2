#include "mesh/orient/patches.h"

#include "base/disjoint_sets.h"

namespace mandoline::detail {
namespace {

constexpr uint32_t kNone = ~0u;

/// Per side the one that lies at it, where an edge has two; else kNone.
struct Neighbours {
  std::vector<uint32_t> sideAt;
  std::vector<uint8_t> disagrees;  ///< per side: whether both lead the same way

  Neighbours(size_t triangles, std::span<EdgeUse> uses) : sideAt(3 * triangles, kNone), disagrees(3 * triangles, 0) {
    forEachEdge(uses, [&](std::span<const EdgeUse> edge) {
      if (edge.size() != 2) return;
      for (size_t i = 0; i < 2; ++i) {
        sideAt[edge[i].side] = edge[1 - i].side;
        disagrees[edge[i].side] = edge[0].upwards == edge[1].upwards;
      }
    });
  }
};

/// Gathers the triangles that hang together with the first; false if they can't agree.
bool gather(uint32_t first, const Neighbours& neighbours, Patches& patches, std::vector<uint32_t>& gathered) {
  const int32_t patch = int32_t(patches.count());
  bool agrees = true;
  gathered.assign(1, first);
  patches.patchOf[first] = patch;
  for (size_t i = 0; i < gathered.size(); ++i) {
    const uint32_t t = gathered[i];
    for (uint32_t side = 3 * t; side < 3 * t + 3; ++side) {
      if (neighbours.sideAt[side] == kNone) continue;
      const uint32_t other = neighbours.sideAt[side] / 3;
      const uint8_t turned = patches.turned[t] ^ neighbours.disagrees[side];
      if (patches.patchOf[other] < 0) {
        patches.patchOf[other] = patch;
        patches.turned[other] = turned;
        gathered.push_back(other);
      } else if (patches.turned[other] != turned) {
        agrees = false;
      }
    }
  }
  return agrees;
}

/// Whether the directed edges of each patch cancel.
std::vector<uint8_t> closedPatches(const Patches& patches, std::span<EdgeUse> uses) {
  std::vector<uint8_t> closed = patches.orientable;
  std::vector<int> net(patches.count(), 0);
  forEachEdge(uses, [&](std::span<const EdgeUse> edge) {
    const auto patchOf = [&](const EdgeUse& use) { return patches.of(use.triangle()); };
    for (const EdgeUse& use : edge) net[patchOf(use)] += use.upwards == (patches.turned[use.triangle()] != 0) ? 1 : -1;
    for (const EdgeUse& use : edge) {
      if (net[patchOf(use)] != 0) closed[patchOf(use)] = 0;
    }
    for (const EdgeUse& use : edge) net[patchOf(use)] = 0;
  });
  return closed;
}

}  // namespace

Patches findPatches(const std::vector<Corners>& triangles, std::span<EdgeUse> uses) {
  const Neighbours neighbours(triangles.size(), uses);
  Patches patches;
  patches.patchOf.assign(triangles.size(), -1);
  patches.turned.assign(triangles.size(), 0);
  std::vector<uint32_t> gathered;
  for (uint32_t t = 0; t < triangles.size(); ++t) {
    if (patches.has(t) || !hasThreeVertices(triangles[t])) continue;
    const bool agrees = gather(t, neighbours, patches, gathered);
    patches.orientable.push_back(agrees);
    for (size_t i = 0; i < gathered.size() && !agrees; ++i) patches.turned[gathered[i]] = 0;
  }
  return patches;
}

Csr<uint32_t> trianglesOf(const Patches& patches) {
  std::vector<uint32_t> inPatches;
  for (uint32_t t = 0; t < patches.patchOf.size(); ++t) {
    if (patches.has(t)) inPatches.push_back(t);
  }
  return groupBy<uint32_t>(
      patches.count(), inPatches.size(), [&](size_t i) { return size_t(patches.of(inPatches[i])); },
      [&](size_t i) { return inPatches[i]; });
}

Shells findShells(const Patches& patches, std::span<EdgeUse> uses) {
  const std::vector<uint8_t> closed = closedPatches(patches, uses);
  DisjointSets sets(patches.count());
  std::vector<uint8_t> isOpen(patches.count(), 0);
  for (size_t p = 0; p < patches.count(); ++p) isOpen[p] = !patches.orientable[p];
  std::vector<uint32_t> left;  // patches at an edge that are not closed by themselves
  forEachEdge(uses, [&](std::span<const EdgeUse> edge) {
    left.clear();
    for (const EdgeUse& use : edge) {
      const uint32_t patch = patches.of(use.triangle());
      if (!closed[patch]) left.push_back(patch);
    }
    for (const uint32_t patch : left) {
      sets.unite(patch, left[0]);
      if (left.size() % 2 != 0) isOpen[patch] = 1;
    }
  });
  std::vector<uint8_t> isOpenSet(patches.count(), 0);
  for (uint32_t p = 0; p < patches.count(); ++p) isOpenSet[sets.find(p)] |= isOpen[p];
  Shells shells;
  shells.shellOf.assign(patches.count(), -1);
  for (uint32_t p = 0; p < patches.count(); ++p) {
    const uint32_t root = sets.find(p);
    if (isOpenSet[root]) continue;
    if (root == p) {
      shells.shellOf[p] = int32_t(shells.count());
      shells.isSingle.push_back(closed[p]);
    } else {
      shells.shellOf[p] = shells.shellOf[root];
    }
  }
  return shells;
}

}  // namespace mandoline::detail

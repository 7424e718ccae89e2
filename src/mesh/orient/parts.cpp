#include "mesh/orient/parts.h"

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
bool gather(uint32_t first, const Neighbours& neighbours, Parts& parts, std::vector<uint32_t>& gathered) {
  const int32_t part = int32_t(parts.count());
  bool agrees = true;
  gathered.assign(1, first);
  parts.partOf[first] = part;
  for (size_t i = 0; i < gathered.size(); ++i) {
    const uint32_t t = gathered[i];
    for (uint32_t side = 3 * t; side < 3 * t + 3; ++side) {
      if (neighbours.sideAt[side] == kNone) continue;
      const uint32_t other = neighbours.sideAt[side] / 3;
      const uint8_t turned = parts.turned[t] ^ neighbours.disagrees[side];
      if (parts.partOf[other] < 0) {
        parts.partOf[other] = part;
        parts.turned[other] = turned;
        gathered.push_back(other);
      } else if (parts.turned[other] != turned) {
        agrees = false;
      }
    }
  }
  return agrees;
}

/// Whether the directed edges of each part cancel.
std::vector<uint8_t> closedParts(const Parts& parts, std::span<EdgeUse> uses) {
  std::vector<uint8_t> closed = parts.orientable;
  std::vector<int> net(parts.count(), 0);
  forEachEdge(uses, [&](std::span<const EdgeUse> edge) {
    const auto partOf = [&](const EdgeUse& use) { return parts.of(use.triangle()); };
    for (const EdgeUse& use : edge) net[partOf(use)] += use.upwards == (parts.turned[use.triangle()] != 0) ? 1 : -1;
    for (const EdgeUse& use : edge) {
      if (net[partOf(use)] != 0) closed[partOf(use)] = 0;
    }
    for (const EdgeUse& use : edge) net[partOf(use)] = 0;
  });
  return closed;
}

}  // namespace

Parts findParts(const std::vector<Corners>& triangles, std::span<EdgeUse> uses) {
  const Neighbours neighbours(triangles.size(), uses);
  Parts parts;
  parts.partOf.assign(triangles.size(), -1);
  parts.turned.assign(triangles.size(), 0);
  std::vector<uint32_t> gathered;
  for (uint32_t t = 0; t < triangles.size(); ++t) {
    if (parts.has(t) || !hasThreeVertices(triangles[t])) continue;
    const bool agrees = gather(t, neighbours, parts, gathered);
    parts.orientable.push_back(agrees);
    for (size_t i = 0; i < gathered.size() && !agrees; ++i) parts.turned[gathered[i]] = 0;
  }
  return parts;
}

Csr<uint32_t> trianglesOf(const Parts& parts) {
  std::vector<uint32_t> inParts;
  for (uint32_t t = 0; t < parts.partOf.size(); ++t) {
    if (parts.has(t)) inParts.push_back(t);
  }
  return groupBy<uint32_t>(
      parts.count(), inParts.size(), [&](size_t i) { return size_t(parts.of(inParts[i])); }, [&](size_t i) { return inParts[i]; });
}

Shells findShells(const Parts& parts, std::span<EdgeUse> uses) {
  const std::vector<uint8_t> closed = closedParts(parts, uses);
  DisjointSets sets(parts.count());
  std::vector<uint8_t> isOpen(parts.count(), 0);
  for (size_t p = 0; p < parts.count(); ++p) isOpen[p] = !parts.orientable[p];
  std::vector<uint32_t> left;  // parts at an edge that are not closed by themselves
  forEachEdge(uses, [&](std::span<const EdgeUse> edge) {
    left.clear();
    for (const EdgeUse& use : edge) {
      const uint32_t part = parts.of(use.triangle());
      if (!closed[part]) left.push_back(part);
    }
    for (const uint32_t part : left) {
      sets.unite(part, left[0]);
      if (left.size() % 2 != 0) isOpen[part] = 1;
    }
  });
  std::vector<uint8_t> isOpenSet(parts.count(), 0);
  for (uint32_t p = 0; p < parts.count(); ++p) isOpenSet[sets.find(p)] |= isOpen[p];
  Shells shells;
  shells.shellOf.assign(parts.count(), -1);
  for (uint32_t p = 0; p < parts.count(); ++p) {
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

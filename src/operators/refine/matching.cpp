// The part of the assembly where blocks meet smaller ones.
#include <algorithm>

#include "mesh/failure.h"
#include "operators/refine/assembly.h"

namespace mandoline::refining {

void Assembly::markLarge(uint32_t id) {
  if (id >= isLarge_.size()) isLarge_.resize(ids_.size());
  if (!isLarge_[id]) large_.push_back(id);
  isLarge_[id] = 1;
}

void Assembly::markLarge(const Side& side) {
  for (const uint32_t v : cornersOf(side)) markLarge(v);
  const BlockCells& own = result_.leafCells[side.leaf];
  forFacesOn(own, side.axis, side.side, [&](uint32_t f, uint32_t, int32_t) {
    for (const auto loop : own.part->cutMesh().loops(f)) {
      for (const uint32_t v : loop) markLarge(ids_.of(own.number, v));
    }
  });
}

/// The faces of smaller blocks on a side: their cells behind it, and chains on the edges of its faces.
void Assembly::matchSide(const Side& side) {
  const BlockCells& own = result_.leafCells[side.leaf];
  const int level = leaves_.cellLevel[side.leaf] - 1;
  const Block low = neighbour(side), corner = leaves_.corner(side.leaf);
  std::vector<Beside> besides;
  matcher_.clear();
  for (int quarter = 0; quarter < 4; ++quarter) {
    Block at = low, behind = corner;
    const size_t u = (side.axis + 1) % 3, v = (side.axis + 2) % 3;
    at[u] += (quarter & 1) << level;
    at[v] += (quarter >> 1) << level;
    behind[u] = at[u];
    behind[v] = at[v];
    if (side.side) behind[side.axis] = leaves_.end(side.leaf)[side.axis] - 1;
    const int64_t leaf = leafAt(at);
    if (leaf < 0) continue;
    const Side facing{size_t(leaf), side.axis, 1 - side.side};
    const auto range = std::equal_range(besides_.begin(), besides_.end(), Beside{facing.key(), 0, false});
    besides.insert(besides.end(), range.first, range.second);
    if (!own.isCut()) continue;
    addSurfaceEdges(result_.leafCells[size_t(leaf)], facing);
    addSurfaceEdges(blockAt(behind, level), {size_t(leaf), side.axis, side.side});
  }
  for (const Beside& beside : besides) {
    const FaceList& list = beside.isPlain ? result_.plain : result_.cut;
    matcher_.addFace(list.parents(beside.face));
    forEdges(list.loops(beside.face), [&](uint32_t a, uint32_t b) { matcher_.addEdge(a, b); });
  }
  forFacesOn(own, side.axis, side.side, [&](uint32_t f, uint32_t, int32_t c) {
    const CutMesh& cutMesh = own.part->cutMesh();
    std::vector<uint32_t> parents;
    for (uint32_t i = cutMesh.faceParentOffsets[f]; i < cutMesh.faceParentOffsets[f + 1]; ++i)
      parents.push_back(own.part->triangle(int32_t(cutMesh.faceParents[i])));
    forEdges(cutMesh.loops(f), [&](uint32_t a, uint32_t b) {
      matcher_.addLargeEdge(ids_.of(own.number, a), ids_.of(own.number, b), parents, cellOf(own, c));
    });
  });
  isLarge_.resize(std::max(isLarge_.size(), ids_.size()));
  matcher_.run(isLarge_, *chains_);
  for (size_t i = 0; i < besides.size(); ++i) {
    FaceList& list = besides[i].isPlain ? result_.plain : result_.cut;
    for (const size_t s : {size_t(0), size_t(1)}) {
      int32_t& cell = list.faceCells[2 * size_t(besides[i].face) + s];
      if (cell != kPending) continue;
      cell = matcher_.cellBehind(i);
      if (cell < 0) throw detail::Failure{{Status::internalError, -1, -1, "A face of a smaller cell has no larger one behind it."}};
    }
  }
}

/// The edges of triangles that lie in a side of a block of the level below, but for triangles that lie there themselves.
void Assembly::addSurfaceEdges(const BlockCells& cells, const Side& side) {
  if (!cells.isCut()) return;
  const CutMesh& cutMesh = cells.part->cutMesh();
  const size_t d = side.axis;
  const int32_t plane = cutMesh.cellGridCell[3 * cells.cells.begin + d] + side.side;
  const auto isOn = [&](uint32_t v) { return (cutMesh.vertexMask[v] >> d & 1) && cutMesh.vertexCell[3 * size_t(v) + d] == plane; };
  for (size_t c = cells.cells.begin; c < cells.cells.end; ++c) {
    for (const uint32_t h : cutMesh.halfFaces(c)) {
      const size_t f = h / 2;
      if (cutMesh.faceTriangle[f] < 0 || (size_t(cutMesh.faceAxis[f]) == d && cutMesh.facePlane[f] == plane)) continue;
      forEdges(cutMesh.loops(f), [&](uint32_t a, uint32_t b) {
        if (isOn(a) && isOn(b)) matcher_.addSurfaceEdge(ids_.of(cells.number, a), ids_.of(cells.number, b));
      });
    }
  }
}

}  // namespace mandoline::refining

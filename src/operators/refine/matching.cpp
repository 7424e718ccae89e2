// The part of the assembly where blocks meet smaller ones.
#include "mesh/failure.h"
#include "operators/refine/assembly.h"

namespace mandoline::refining {

/// Sides of the last level that was added, with the faces of the level before.
void Assembly::matchLevel(const std::vector<Side>& sides) {
  const std::vector<uint8_t> isLarge = largeVertices(sides);
  constexpr size_t kBlock = 64;
  const auto match = [&](Matched& matched, size_t begin, size_t end) {
    for (size_t i = begin; i < end; ++i) matchSide(sides[i], isLarge, matched);
  };
  for (const Matched& matched : detail::forChunks<Matched>(sides.size(), monitor_, match, kBlock))
    result_.levels.back().chains.add(matched.chains);
}

/// Per vertex: whether faces of the last level have it, or sides that smaller blocks are beside.
std::vector<uint8_t> Assembly::largeVertices(const std::vector<Side>& sides) const {
  std::vector<uint8_t> isLarge(ids_.size());
  LoopMaker loops(sources_, result_.levels.back());
  for (const LevelFace& face : result_.levels.back().faces) {
    loops.forLargeLoops(face, [&](std::span<const uint32_t> loop) {
      for (const uint32_t v : loop) isLarge[v] = 1;
    });
  }
  for (const Side& side : sides) {
    for (const uint32_t v : cornersOf(sources_, side)) isLarge[v] = 1;
    const BlockCells own = cellsOf(side.leaf);
    forFacesOn(own, side.axis, side.side, [&](uint32_t f, uint32_t, int32_t) {
      for (const auto loop : own.part->cutMesh().loops(f)) {
        for (const uint32_t v : loop) isLarge[ids_.of(own.number, v)] = 1;
      }
    });
  }
  return isLarge;
}

/// The faces of smaller blocks on a side: their cells behind it, and chains on the edges of its faces.
void Assembly::matchSide(const Side& side, const std::vector<uint8_t>& isLarge, Matched& matched) {
  matched.matcher.clear();
  matched.besides.clear();
  addSmallFaces(side, matched);
  addLargeFaces(side, matched);
  matched.matcher.run(isLarge, matched.chains);
  std::vector<LevelFace>& faces = result_.levels[result_.levels.size() - 2].faces;
  for (size_t i = 0; i < matched.besides.size(); ++i) {
    for (int32_t& cell : faces[matched.besides[i]].cells) {
      if (cell != kPending) continue;
      cell = matched.matcher.cellBehind(i);
      if (cell < 0) throw detail::Failure{{Status::internalError, -1, -1, "A face of a smaller cell has no larger one behind it."}};
    }
  }
}

void Assembly::addSmallFaces(const Side& side, Matched& matched) const {
  const LevelFaces& small = result_.levels[result_.levels.size() - 2];
  const bool isCut = cellsOf(side.leaf).isCut();
  const int level = leaves_.cellLevel[side.leaf] - 1;
  const Block low = neighbour(side), corner = leaves_.corner(side.leaf);
  for (int quarter = 0; quarter < 4; ++quarter) {
    Block at = low, behind = corner;
    const size_t u = (side.axis + 1u) % 3, v = (side.axis + 2u) % 3;
    at[u] += (quarter & 1) << level;
    at[v] += (quarter >> 1) << level;
    behind[u] = at[u];
    behind[v] = at[v];
    if (side.side) behind[side.axis] = leaves_.end(side.leaf)[side.axis] - 1;
    const int64_t leaf = leafAt(at);
    if (leaf < 0) continue;
    const Side facing{uint32_t(leaf), side.axis, uint8_t(1 - side.side)};
    const auto [begin, end] = small.on(facing);
    for (size_t f = begin; f < end; ++f) {
      if (small.faces[f].isBesideLarger) matched.besides.push_back(f);
    }
    if (!isCut) continue;
    addSurfaceEdges(cellsOf(size_t(leaf)), facing, matched.matcher);
    addSurfaceEdges(blockAt(behind, level), {uint32_t(leaf), side.axis, side.side}, matched.matcher);
  }
  LoopMaker loops(sources_, small);
  std::vector<uint32_t> parents;
  for (const size_t f : matched.besides) {
    const LevelFace& face = small.faces[f];
    parents.clear();
    if (!face.isWhole()) parts_[face.part].appendParents(face.face, parents);
    matched.matcher.addFace(parents);
    loops.forLoops(face, [&](std::span<const uint32_t> loop) {
      forEdges(std::span(&loop, 1), [&](uint32_t a, uint32_t b) { matched.matcher.addEdge(a, b); });
    });
  }
}

void Assembly::addLargeFaces(const Side& side, Matched& matched) const {
  const BlockCells own = cellsOf(side.leaf);
  std::vector<uint32_t> parents;
  forFacesOn(own, side.axis, side.side, [&](uint32_t f, uint32_t, int32_t c) {
    parents.clear();
    own.part->appendParents(f, parents);
    forEdges(own.part->cutMesh().loops(f), [&](uint32_t a, uint32_t b) {
      matched.matcher.addLargeEdge(ids_.of(own.number, a), ids_.of(own.number, b), parents, cellOf(own, c));
    });
  });
}

/// The edges of triangles that lie in a side of a block of the level below, but for triangles that lie there themselves.
void Assembly::addSurfaceEdges(const BlockCells& cells, const Side& side, SideMatcher& matcher) const {
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
        if (isOn(a) && isOn(b)) matcher.addSurfaceEdge(ids_.of(cells.number, a), ids_.of(cells.number, b));
      });
    }
  }
}

}  // namespace mandoline::refining

#include "operators/refine/assembly.h"

#include <bit>

#include "base/large_array.h"
#include "mesh/failure.h"

namespace mandoline::refining {

Assembly::Assembly(const Sources& sources, detail::Monitor& monitor)
    : sources_(sources), leaves_(sources.leaves), parts_(sources.parts), ids_(sources.ids), monitor_(monitor), index_(leaves_) {}

Assembled Assembly::run() {
  numberCells();
  size_t top = 0;
  for (const uint8_t level : leaves_.cellLevel) top = std::max(top, size_t(level));
  const auto leaves = detail::groupBy<uint32_t>(
      top + 1, leaves_.cellCount(), [&](size_t leaf) { return size_t(leaves_.cellLevel[leaf]); },
      [](size_t leaf) { return uint32_t(leaf); });
  for (size_t level = 0; level <= top; ++level) addLevel(int(level), leaves[level]);
  return std::move(result_);
}

void Assembly::numberCells() {
  result_.leafCells.resize(leaves_.cellCount());
  result_.firstCells.resize(leaves_.cellCount());
  struct Nothing {};
  detail::forChunks<Nothing>(leaves_.cellCount(), monitor_, [&](Nothing&, size_t begin, size_t end) {
    for (size_t leaf = begin; leaf < end; ++leaf) {
      const BlockCells cells = parts_.at(leaves_.cellLevel[leaf], operators::blockOf(leaves_, leaf));
      if (cells.isCut()) result_.leafCells[leaf] = {uint32_t(cells.number), uint32_t(cells.cells.begin), uint32_t(cells.cells.end)};
    }
  });
  cellIds_.resize(parts_.size());
  for (size_t p = 0; p < parts_.size(); ++p) cellIds_[p].assign(parts_[p].cutMesh().cellCount(), -1);
  for (size_t leaf = 0; leaf < leaves_.cellCount(); ++leaf) {
    result_.firstCells[leaf] = result_.cutCells;
    const Assembled::LeafCells& cells = result_.leafCells[leaf];
    for (uint32_t c = cells.begin; c < cells.end; ++c) cellIds_[cells.part][c] = int32_t(result_.cutCells++);
  }
  result_.cells = result_.cutCells;
  for (size_t leaf = 0; leaf < leaves_.cellCount(); ++leaf) {
    if (result_.leafCells[leaf].part == kNone) result_.firstCells[leaf] = result_.cells++;
  }
}

void Assembly::addLevel(int level, std::span<const uint32_t> leaves) {
  LevelFaces& added = result_.levels.emplace_back();
  addExtras(level, added.extras);
  std::vector<Found> found = detail::forChunks<Found>(leaves.size(), monitor_, [&](Found& chunk, size_t begin, size_t end) {
    for (const uint32_t leaf : leaves.subspan(begin, end - begin)) {
      addInnerFaces(leaf, chunk);
      for (uint8_t axis = 0; axis < 3; ++axis) {
        for (uint8_t side = 0; side < 2; ++side) addSide({leaf, axis, side}, chunk);
      }
    }
  });
  size_t count = 0;
  for (const Found& chunk : found) count += chunk.faces.size();
  detail::reserveLarge(added.faces, count);
  std::vector<Side> sides;
  for (Found& chunk : found) {
    added.faces.insert(added.faces.end(), chunk.faces.begin(), chunk.faces.end());
    sides.insert(sides.end(), chunk.sides.begin(), chunk.sides.end());
    chunk = {};
  }
  if (!sides.empty()) matchLevel(sides);
}

/// Vertices between grid vertices: a surface may touch an edge of a block, and not all four blocks around it.
void Assembly::addExtras(int level, Chains& extras) const {
  std::vector<size_t> parts;
  for (size_t p = 0; p < parts_.size(); ++p) {
    if (parts_[p].level == level) parts.push_back(p);
  }
  const auto found = [&](ChainList& chunk, size_t begin, size_t end) {
    for (size_t p = begin; p < end; ++p) addExtras(parts[p], chunk);
  };
  for (const ChainList& chunk : detail::forChunks<ChainList>(parts.size(), monitor_, found, 1)) extras.add(chunk);
}

void Assembly::addExtras(size_t part, ChainList& extras) const {
  const CutMesh& cutMesh = parts_[part].cutMesh();
  std::vector<std::array<uint32_t, 2>> links;
  const auto onLine = [&](uint32_t v) { return std::popcount(cutMesh.vertexMask[v]) == 2; };
  for (size_t f = 0; f < cutMesh.faceCount(); ++f) {
    forEdges(cutMesh.loops(f), [&](uint32_t a, uint32_t b) {
      if ((onLine(a) || onLine(b)) && std::popcount(cutMesh.commonPlanes(a, b)) == 2) links.insert(links.end(), {{a, b}, {b, a}});
    });
  }
  detail::sortUnique(links);
  const auto nextOf = [&](uint32_t at, uint32_t before) {
    auto link = std::lower_bound(links.begin(), links.end(), std::array<uint32_t, 2>{at, 0});
    for (; link != links.end() && (*link)[0] == at; ++link) {
      if ((*link)[1] != before) return (*link)[1];
    }
    return kNone;
  };
  for (const auto& [from, first] : links) {
    if (onLine(from)) continue;
    const size_t begin = extras.items.size();
    extras.items.push_back(ids_.of(part, from));
    uint32_t before = from, at = first;
    while (at != kNone && onLine(at)) {
      extras.items.push_back(ids_.of(part, at));
      before = std::exchange(at, nextOf(at, before));
    }
    if (at == kNone || extras.items.size() == begin + 1) {
      extras.items.resize(begin);
    } else {
      extras.items.push_back(ids_.of(part, at));
      extras.endGroup();
    }
  }
}

int32_t Assembly::cellOf(const BlockCells& cells, int32_t cell) const { return cell < 0 ? -1 : cellIds_[cells.number][size_t(cell)]; }

/// Pieces of triangles that lie in no side of the block.
void Assembly::addInnerFaces(uint32_t leaf, Found& found) const {
  const BlockCells cells = cellsOf(leaf);
  if (!cells.isCut()) return;
  const CutMesh& cutMesh = cells.part->cutMesh();
  for (size_t c = cells.cells.begin; c < cells.cells.end; ++c) {
    for (const uint32_t h : cutMesh.halfFaces(c)) {
      if (h % 2 != 0 || cutMesh.faceAxis[h / 2] >= 0) continue;
      const int32_t other = cells.part->owners[h ^ 1];
      found.faces.push_back({uint32_t(cells.number), h / 2, {leaf, 0, 0}, false, {cellOf(cells, int32_t(c)), cellOf(cells, other)}});
    }
  }
}

/// The smallest cell behind the lowest corner of a side.
Block Assembly::neighbour(const Side& side) const {
  Block at = leaves_.corner(side.leaf);
  at[side.axis] = side.side ? leaves_.end(side.leaf)[side.axis] : at[side.axis] - 1;
  return at;
}

int64_t Assembly::leafAt(const Block& at) const {
  for (size_t d = 0; d < 3; ++d) {
    if (at[d] < 0 || at[d] >= leaves_.gridCells[d]) return -1;
  }
  return index_.find(at, 0);
}

BlockCells Assembly::blockAt(const Block& at, int level) const {
  return parts_.at(level, {at[0] >> level, at[1] >> level, at[2] >> level});
}

/// The faces on a side, unless smaller blocks are beside it, or one of the same size that has them.
void Assembly::addSide(const Side& side, Found& found) const {
  const Block at = neighbour(side);
  const int64_t other = leafAt(at);
  const int level = leaves_.cellLevel[side.leaf];
  if (other >= 0) {
    const int otherLevel = leaves_.cellLevel[size_t(other)];
    if (otherLevel < level) return found.sides.push_back(side);
    if (otherLevel == level && side.side == 0) return;
  }
  const BlockCells own = cellsOf(side.leaf);
  const bool isLarger = other >= 0 && leaves_.cellLevel[size_t(other)] > level;
  const BlockCells ofOther = other < 0 ? BlockCells() : cellsOf(size_t(other)), across = isLarger ? blockAt(at, level) : ofOther;
  const bool isOwn = own.isCut();
  const int32_t otherWhole = other < 0 ? -1 : ofOther.isCut() ? kPending : int32_t(result_.firstCells[size_t(other)]);
  const size_t before = found.faces.size();
  forFacesOn(isOwn ? own : across, side.axis, isOwn ? side.side : 1 - side.side, [&](uint32_t f, uint32_t s, int32_t c) {
    LevelFace face{uint32_t((isOwn ? own : across).number), f, side, isLarger, {}};
    const size_t mine = isOwn ? s : 1 - s;
    face.cells[mine] = isOwn ? cellOf(own, c) : int32_t(result_.firstCells[side.leaf]);
    face.cells[1 - mine] = isOwn || isLarger ? otherWhole : cellOf(across, c);
    if (isOwn && !isLarger && otherWhole == kPending)
      face.cells[1 - mine] = own.part == across.part ? cellOf(across, own.part->owners[2 * f + 1 - mine]) : cellAcross(face, own, across);
    found.faces.push_back(face);
  });
  if (found.faces.size() > before) return;
  LevelFace face{kNone, 0, side, isLarger, {}};
  face.cells[size_t(1 - side.side)] = int32_t(result_.firstCells[side.leaf]);
  face.cells[size_t(side.side)] = otherWhole;
  found.faces.push_back(face);
}

/// The cell of a block of the same size, in another part, that has the same face.
int32_t Assembly::cellAcross(const LevelFace& face, const BlockCells& own, const BlockCells& other) const {
  const Part &part = *own.part, &otherPart = *other.part;
  const CutMesh &cutMesh = part.cutMesh(), &otherMesh = otherPart.cutMesh();
  const auto triangleOf = [](const Part& p, const CutMesh& m, uint32_t f) {
    return m.faceTriangle[f] < 0 ? int64_t(-1) : int64_t(p.triangle(m.faceTriangle[f]));
  };
  const auto first = cutMesh.loop(cutMesh.faceLoopOffsets[face.face]);
  const uint32_t from = ids_.of(own.number, first[0]), to = ids_.of(own.number, first[1]);
  const int64_t triangle = triangleOf(part, cutMesh, face.face);
  int32_t found = -1;
  forFacesOn(other, face.side.axis, 1 - face.side.side, [&](uint32_t f, uint32_t, int32_t c) {
    if (found >= 0 || triangleOf(otherPart, otherMesh, f) != triangle) return;
    forEdges(otherMesh.loops(f), [&](uint32_t a, uint32_t b) {
      if (ids_.of(other.number, a) == from && ids_.of(other.number, b) == to) found = cellOf(other, c);
    });
  });
  if (found < 0) throw detail::Failure{{Status::internalError, -1, -1, "Two parts of the grid have different faces between them."}};
  return found;
}

}  // namespace mandoline::refining

#include "operators/refine/assembly.h"

#include <algorithm>
#include <bit>

#include "mesh/failure.h"

namespace mandoline::refining {

Assembly::Assembly(const OctreeCells& leaves, const Parts& parts, SharedIds& ids, const std::array<std::vector<double>, 3>& planes)
    : leaves_(leaves), parts_(parts), ids_(ids), planes_(planes), index_(leaves) {}

Assembled Assembly::run(detail::Monitor& monitor) {
  numberCells();
  int top = 0;
  for (const uint8_t level : leaves_.cellLevel) top = std::max(top, int(level));
  for (int level = 0; level <= top; ++level) {
    monitor.report(size_t(level), size_t(top) + 1);
    addLevel(level);
  }
  return std::move(result_);
}

void Assembly::numberCells() {
  cellIds_.resize(parts_.size());
  for (size_t p = 0; p < parts_.size(); ++p) cellIds_[p].assign(parts_[p].cutMesh().cellCount(), -1);
  for (size_t leaf = 0; leaf < leaves_.cellCount(); ++leaf) {
    result_.leafCells.push_back(parts_.at(leaves_.cellLevel[leaf], operators::blockOf(leaves_, leaf)));
    const BlockCells& cells = result_.leafCells.back();
    result_.firstCells.push_back(result_.cutCells);
    for (size_t c = cells.cells.begin; c < cells.cells.end; ++c) cellIds_[cells.number][c] = int32_t(result_.cutCells++);
  }
  result_.cells = result_.cutCells;
  for (size_t leaf = 0; leaf < leaves_.cellCount(); ++leaf) {
    if (!result_.leafCells[leaf].isCut()) result_.firstCells[leaf] = result_.cells++;
  }
}

void Assembly::addLevel(int level) {
  faces_.clear();
  sides_.clear();
  extras_ = {};
  chains_.emplace();
  std::swap(besides_, nextBesides_);
  nextBesides_.clear();
  addExtras(level);
  for (size_t leaf = 0; leaf < leaves_.cellCount(); ++leaf) {
    if (leaves_.cellLevel[leaf] != level) continue;
    addInnerFaces(leaf);
    for (size_t axis = 0; axis < 3; ++axis) {
      for (const int side : {0, 1}) addSide({leaf, axis, side});
    }
  }
  isLarge_.resize(ids_.size());
  for (const LevelFace& face : faces_) {
    if (!face.part) {
      for (const uint32_t v : plainLoop(face)) markLarge(v);
    } else {
      for (const auto loop : face.part->cutMesh().loops(face.face)) {
        for (const uint32_t v : loop) markLarge(ids_.of(face.number, v));
      }
    }
  }
  for (const Side& side : sides_) markLarge(side);
  for (const Side& side : sides_) matchSide(side);
  for (const LevelFace& face : faces_) write(face);
  for (const uint32_t v : large_) isLarge_[v] = 0;
  large_.clear();
}

/// Vertices between grid vertices: a surface may touch an edge of a block, and not all four blocks around it.
void Assembly::addExtras(int level) {
  for (size_t p = 0; p < parts_.size(); ++p) {
    if (parts_[p].level != level) continue;
    const CutMesh& cutMesh = parts_[p].cutMesh();
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
      loop_.clear();
      uint32_t before = from, at = first;
      while (at != kNone && onLine(at)) {
        loop_.push_back(ids_.of(p, at));
        before = std::exchange(at, nextOf(at, before));
      }
      if (at != kNone && !loop_.empty()) extras_.add(ids_.of(p, from), ids_.of(p, at), loop_);
    }
  }
}

int32_t Assembly::cellOf(const BlockCells& cells, int32_t cell) const { return cell < 0 ? -1 : cellIds_[cells.number][size_t(cell)]; }

/// Pieces of triangles that lie in no side of the block.
void Assembly::addInnerFaces(size_t leaf) {
  const BlockCells& cells = result_.leafCells[leaf];
  if (!cells.isCut()) return;
  const CutMesh& cutMesh = cells.part->cutMesh();
  for (size_t c = cells.cells.begin; c < cells.cells.end; ++c) {
    for (const uint32_t h : cutMesh.halfFaces(c)) {
      if (h % 2 != 0 || cutMesh.faceAxis[h / 2] >= 0) continue;
      const int32_t other = cells.part->owners[h ^ 1];
      faces_.push_back(
          {cells.part, uint32_t(cells.number), h / 2, {leaf, 0, 0}, {cellOf(cells, int32_t(c)), cellOf(cells, other)}, false, {}});
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
void Assembly::addSide(const Side& side) {
  const Block at = neighbour(side);
  const int64_t other = leafAt(at);
  const int level = leaves_.cellLevel[side.leaf];
  if (other >= 0) {
    const int otherLevel = leaves_.cellLevel[size_t(other)];
    if (otherLevel < level) return sides_.push_back(side);
    if (otherLevel == level && side.side == 0) return;
  }
  const BlockCells& own = result_.leafCells[side.leaf];
  const bool isLarger = other >= 0 && leaves_.cellLevel[size_t(other)] > level;
  const BlockCells across = other < 0 ? BlockCells() : isLarger ? blockAt(at, level) : result_.leafCells[size_t(other)];
  const bool isOwn = own.isCut();
  const int32_t otherWhole = other < 0                                  ? -1
                             : result_.leafCells[size_t(other)].isCut() ? kPending
                                                                        : int32_t(result_.firstCells[size_t(other)]);
  const size_t before = faces_.size();
  forFacesOn(isOwn ? own : across, side.axis, isOwn ? side.side : 1 - side.side, [&](uint32_t f, uint32_t s, int32_t c) {
    const BlockCells& from = isOwn ? own : across;
    LevelFace face{from.part, uint32_t(from.number), f, side, {}, isLarger, {}};
    const size_t mine = isOwn ? s : 1 - s;
    face.cells[mine] = isOwn ? cellOf(own, c) : int32_t(result_.firstCells[side.leaf]);
    face.cells[1 - mine] = isOwn || isLarger ? otherWhole : cellOf(across, c);
    if (isOwn && !isLarger && otherWhole == kPending)
      face.cells[1 - mine] = own.part == across.part ? cellOf(across, own.part->owners[2 * f + 1 - mine]) : cellAcross(face, own, across);
    faces_.push_back(face);
  });
  if (faces_.size() > before) return;
  LevelFace face{nullptr, kNone, 0, side, {}, isLarger, cornersOf(side)};
  face.cells[size_t(1 - side.side)] = int32_t(result_.firstCells[side.leaf]);
  face.cells[size_t(side.side)] = otherWhole;
  faces_.push_back(face);
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

std::array<uint32_t, 4> Assembly::cornersOf(const Side& side) {
  const Block low = leaves_.corner(side.leaf), high = leaves_.end(side.leaf);
  const size_t u = (side.axis + 1) % 3, v = (side.axis + 2) % 3;
  Block at = low;
  at[side.axis] = (side.side ? high : low)[side.axis];
  std::array<uint32_t, 4> corners;
  for (size_t i = 0; i < 4; ++i) {
    at[u] = (i == 1 || i == 2 ? high : low)[u];
    at[v] = (i >= 2 ? high : low)[v];
    corners[i] = ids_.ofGridVertex(at);
  }
  return corners;
}

const std::vector<uint32_t>& Assembly::plainLoop(const LevelFace& face) {
  loop_.clear();
  extras_.append(face.corners, loop_);
  return loop_;
}

void Assembly::write(const LevelFace& face) {
  const auto isCut = [&](int32_t cell) { return cell == kPending || (cell >= 0 && uint32_t(cell) < result_.cutCells); };
  const bool isPlain = !isCut(face.cells[0]) && !isCut(face.cells[1]);
  FaceList& list = isPlain ? result_.plain : result_.cut;
  if (face.isBesideLarger) nextBesides_.push_back({face.side.key(), list.size(), isPlain});
  list.faceCells.insert(list.faceCells.end(), face.cells.begin(), face.cells.end());
  if (face.part)
    writePart(face, list);
  else
    writePlain(face, list);
  list.endFace();
  if (list.loopVertices.size() >> 31 != 0) throw detail::Failure{{Status::meshTooLarge, -1, -1, "The faces have more than 2^31 corners."}};
}

void Assembly::writePlain(const LevelFace& face, FaceList& to) {
  const size_t axis = face.side.axis;
  const Block low = leaves_.corner(face.side.leaf), high = leaves_.end(face.side.leaf);
  const int32_t plane = (face.side.side ? high : low)[axis];
  chains_->append(plainLoop(face), to.loopVertices);
  to.endLoop();
  double area = 1;
  for (size_t d = 0; d < 3; ++d) {
    const std::vector<double>& planes = planes_[d];
    to.faceNormal.push_back(d == axis);
    to.faceCentroid.push_back(d == axis ? planes[size_t(plane)] : planes[size_t(low[d])] / 2 + planes[size_t(high[d])] / 2);
    if (d != axis) area *= planes[size_t(high[d])] - planes[size_t(low[d])];
  }
  to.faceArea.push_back(area);
  const bool isSide = face.cells[0] == -1 || face.cells[1] == -1;
  to.faceTag.push_back(isSide ? FaceTag(2 * int(axis) + face.side.side) : FaceTag::inner);
  to.faceTriangle.push_back(-1);
  to.faceAxis.push_back(int8_t(axis));
  to.facePlane.push_back(plane);
}

void Assembly::writePart(const LevelFace& face, FaceList& to) {
  const Part& part = *face.part;
  const CutMesh& cutMesh = part.cutMesh();
  const size_t f = face.face;
  for (const auto loop : cutMesh.loops(f)) {
    loop_.clear();
    for (const uint32_t v : loop) loop_.push_back(ids_.of(face.number, v));
    chains_->append(loop_, to.loopVertices);
    to.endLoop();
  }
  to.faceArea.push_back(part.measures.faceArea[f]);
  for (size_t d = 0; d < 3; ++d) {
    to.faceNormal.push_back(part.measures.faceNormal[3 * f + d]);
    to.faceCentroid.push_back(part.measures.faceCentroid[3 * f + d]);
  }
  const int axis = cutMesh.faceAxis[f];
  const bool isSurface = cutMesh.faceTriangle[f] >= 0, isSide = face.cells[0] == -1 || face.cells[1] == -1;
  to.faceTag.push_back(isSurface ? FaceTag::surface : isSide ? FaceTag(2 * axis + (face.cells[0] == -1 ? 0 : 1)) : FaceTag::inner);
  to.faceTriangle.push_back(isSurface ? int32_t(part.triangle(cutMesh.faceTriangle[f])) : -1);
  to.faceAxis.push_back(int8_t(axis));
  to.facePlane.push_back(axis < 0 ? 0 : (cutMesh.facePlane[f] + part.first[size_t(axis)]) << part.level);
  for (uint32_t i = cutMesh.faceParentOffsets[f]; i < cutMesh.faceParentOffsets[f + 1]; ++i) {
    to.faceParents.push_back(part.triangle(int32_t(cutMesh.faceParents[i])));
    to.faceParentSigns.push_back(cutMesh.faceParentSigns[i]);
  }
}

}  // namespace mandoline::refining

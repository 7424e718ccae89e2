#include "operators/merge/face_joiner.h"

#include <algorithm>

#include "base/large_array.h"
#include "base/run_tasks.h"
#include "operators/measure/vector.h"

namespace mandoline::merging {

FaceJoiner::FaceJoiner(const CellComplex& cells, const std::vector<Fate>& fates) : cells_(cells) {
  std::vector<uint32_t> lastFace;                    // per vertex
  std::vector<uint8_t> isNear(cells.vertexCount());  // per vertex: whether a face that may join others has it
  detail::makeLarge(lastFace, cells.vertexCount(), kNone);
  detail::makeLarge(joins_, cells.faceCount());
  for (uint32_t f = 0; f < cells.faceCount(); ++f) {
    joins_[f] = fates[f] == Fate::joins && isSimple(f, lastFace);
    if (!joins_[f]) continue;
    for (const uint32_t v : loop(f)) isNear[v] = 1;
  }
  findMates(fates, isNear);
  detail::makeLarge(first_, cells.faceCount());
  detail::makeLarge(next_, cells.vertexCount());
  detail::makeLarge(boundaryOf_, cells.vertexCount());
}

JoinedFaces FaceJoiner::join(const std::vector<Fate>& fates, detail::FunctionRef<bool(uint32_t, uint32_t)> mayJoin) {
  for (size_t f = 0; f < joins_.size(); ++f) joins_[f] &= fates[f] == Fate::joins;
  std::fill(first_.begin(), first_.end(), kNone);
  std::fill(boundaryOf_.begin(), boundaryOf_.end(), kNone);
  JoinedFaces result;
  detail::reserveLarge(result.members.items, cells_.faceCount());
  for (auto* offsets : {&result.members.offsets, &result.loops.offsets}) detail::reserveLarge(*offsets, cells_.faceCount() + 1);
  for (uint32_t f = 0; f < cells_.faceCount(); ++f) {
    if (fates[f] == Fate::goes || first_[f] != kNone) continue;
    members_.assign(1, f);
    if (joins_[f]) grow(f, mayJoin);
    detail::sortItems(members_);
    result.members.items.insert(result.members.items.end(), members_.begin(), members_.end());
    result.members.endGroup();
    if (members_.size() > 1) addLoop(f, result.loops.items);
    result.loops.endGroup();
  }
  return result;
}

bool FaceJoiner::isSimple(uint32_t face, std::vector<uint32_t>& lastFace) const {
  if (cells_.loops(face).size() != 1) return false;
  for (const uint32_t v : loop(face)) {
    if (lastFace[v] == face) return false;
    lastFace[v] = face;
  }
  return true;
}

void FaceJoiner::findMates(const std::vector<Fate>& fates, const std::vector<uint8_t>& isNear) {
  detail::makeLarge(mates_, cells_.loopVertices.size(), kNone);
  const auto forNearEdges = [&](const auto& visit) {
    for (uint32_t f = 0; f < cells_.faceCount(); ++f) {
      if (fates[f] == Fate::goes) continue;
      forEachEdge(f, [&](uint32_t from, uint32_t to, uint32_t corner) {
        if (isNear[from] && isNear[to]) visit(std::min(from, to), Edge{std::max(from, to), f, corner, from < to});
      });
    }
  };
  size_t count = 0;
  forNearEdges([&](uint32_t, const Edge&) { ++count; });
  std::vector<uint32_t> lows;
  std::vector<Edge> all;
  detail::reserveLarge(lows, count);
  detail::reserveLarge(all, count);
  forNearEdges([&](uint32_t low, const Edge& edge) {
    lows.push_back(low);
    all.push_back(edge);
  });
  auto edges = detail::groupBy<Edge>(
      cells_.vertexCount(), all.size(), [&](size_t i) { return size_t(lows[i]); }, [&](size_t i) { return all[i]; });
  for (size_t low = 0; low < edges.size(); ++low) {
    const std::span<Edge> group = edges[low];
    detail::sortItems(group, [](const Edge& a, const Edge& b) { return a.high < b.high; });
    for (size_t i = 0, end; i < group.size(); i = end) {
      for (end = i + 1; end < group.size() && group[end].high == group[i].high;) ++end;
      if (end == i + 2) pair(group[i], group[i + 1]);
    }
  }
}

/// The only two at an edge.
void FaceJoiner::pair(const Edge& a, const Edge& b) {
  if (!joins_[a.face] || !joins_[b.face] || a.face == b.face || a.ascends == b.ascends) return;
  mates_[a.corner] = b.face;
  mates_[b.corner] = a.face;
}

void FaceJoiner::grow(uint32_t first, detail::FunctionRef<bool(uint32_t, uint32_t)> mayJoin) {
  first_[first] = first;
  boundarySize_ = 0;
  forEachEdge(first, [&](uint32_t from, uint32_t to, uint32_t) { addToBoundary(from, to, first); });
  boundarySize_ = loop(first).size();
  for (size_t before = 0; before != members_.size();) {  // what could not join at first may once others have
    before = members_.size();
    for (size_t m = 0; m < members_.size(); ++m) {
      forEachEdge(members_[m], [&](uint32_t, uint32_t, uint32_t corner) {
        const uint32_t mate = mates_[corner];
        if (mate == kNone || !joins_[mate] || first_[mate] != kNone || !mayJoin(first, mate) || !take(mate, first)) return;
        first_[mate] = first;
        members_.push_back(mate);
      });
    }
  }
}

void FaceJoiner::addToBoundary(uint32_t from, uint32_t to, uint32_t first) {
  boundaryOf_[from] = first;
  next_[from] = to;
}

/// Takes a face if the two have one path of edges in common, and no other vertices.
bool FaceJoiner::take(uint32_t face, uint32_t first) {
  size_t edges = 0, vertices = 0;
  const auto isShared = [&](uint32_t corner) { return mates_[corner] != kNone && first_[mates_[corner]] == first; };
  forEachEdge(face, [&](uint32_t from, uint32_t, uint32_t corner) {
    edges += isShared(corner);
    vertices += boundaryOf_[from] == first;
  });
  const size_t size = boundarySize_ + loop(face).size() - 2 * edges;
  if (vertices != edges + 1 || edges == loop(face).size() || size < 3) return false;
  bool afterShared = isShared(uint32_t(&loop(face).back() - cells_.loopVertices.data()));
  forEachEdge(face, [&](uint32_t from, uint32_t to, uint32_t corner) {
    if (!isShared(corner))
      addToBoundary(from, to, first);
    else if (afterShared)
      boundaryOf_[from] = kNone;
    afterShared = isShared(corner);
  });
  boundarySize_ = size;
  return true;
}

void FaceJoiner::addLoop(uint32_t first, std::vector<uint32_t>& loops) const {
  uint32_t start = kNone;
  for (const uint32_t m : members_) {
    for (const uint32_t v : loop(m)) {
      if (start == kNone && boundaryOf_[v] == first) start = v;
    }
  }
  uint32_t v = start;
  do {
    loops.push_back(v);
    v = next_[v];
  } while (v != start);
}

namespace {

/// Area, normal and centroid of a new face. The centroid is moved along the normal to where area times height is that of all members.
void setMeasures(const CellComplex& cells, std::span<const uint32_t> members, size_t face, CellComplex& result) {
  const size_t first = members[0];
  measuring::Vector<double> sum{}, offset{};
  double area = 0;
  for (const size_t f : members) {
    area += cells.faceArea[f];
    for (size_t d = 0; d < 3; ++d) {
      sum[d] += cells.faceArea[f] * cells.faceNormal[3 * f + d];
      offset[d] += cells.faceArea[f] * (cells.faceCentroid[3 * f + d] - cells.faceCentroid[3 * first + d]);
    }
  }
  const double length = measuring::length(sum);
  const bool isOne = members.size() == 1 || !(length > 0);
  result.faceArea[face] = isOne ? area : length;
  double shift = 0;
  for (size_t d = 0; d < 3 && !isOne; ++d) {
    offset[d] /= area;
    for (const size_t f : members) {
      shift += cells.faceArea[f] * cells.faceNormal[3 * f + d] *
               (cells.faceCentroid[3 * f + d] - cells.faceCentroid[3 * first + d] - offset[d]) / length;
    }
  }
  for (size_t d = 0; d < 3; ++d) {
    const double normal = isOne ? cells.faceNormal[3 * first + d] : sum[d] / length;
    result.faceNormal[3 * face + d] = normal;
    result.faceCentroid[3 * face + d] = cells.faceCentroid[3 * first + d] + (isOne ? 0 : offset[d] + shift * normal);
  }
}

/// Fills in the offsets of new faces, and how many are of the cut-mesh.
void placeFaces(const CellComplex& cells, const JoinedFaces& faces, CellComplex& result) {
  const size_t count = faces.members.size();
  detail::makeLarge(result.faceLoopOffsets, count + 1);
  detail::makeLarge(result.faceMemberOffsets, count + 1);
  detail::reserveLarge(result.loopOffsets, cells.loopOffsets.size());
  result.loopOffsets.push_back(0);
  for (size_t f = 0; f < count; ++f) {
    const auto members = faces.members[f];
    const auto endLoop = [&](size_t size) { result.loopOffsets.push_back(result.loopOffsets.back() + uint32_t(size)); };
    if (faces.loops[f].empty()) {
      for (const auto loop : cells.loops(members[0])) endLoop(loop.size());
    } else {
      endLoop(faces.loops[f].size());
    }
    result.faceLoopOffsets[f + 1] = uint32_t(result.loopOffsets.size()) - 1;
    uint32_t parts = 0;
    for (const uint32_t m : members) parts += uint32_t(cells.membersOfFace(m).size());
    result.faceMemberOffsets[f + 1] = result.faceMemberOffsets[f] + parts;
    result.cutFaces += members[0] < cells.cutFaces;
  }
}

/// Fills in the rest of a new face.
void fillFace(const CellComplex& cells, const JoinedFaces& faces, size_t f, CellComplex& result) {
  const auto members = faces.members[f];
  const size_t first = members[0];
  uint32_t* corner = result.loopVertices.data() + result.loopOffsets[result.faceLoopOffsets[f]];
  std::copy(faces.loops[f].begin(), faces.loops[f].end(), corner);
  if (faces.loops[f].empty()) {
    for (const auto loop : cells.loops(first)) corner = std::copy(loop.begin(), loop.end(), corner);
  }
  for (size_t side = 0; side < 2; ++side) result.faceCells[2 * f + side] = cells.faceCells[2 * first + side];
  result.faceTag[f] = cells.faceTag[first];
  setMeasures(cells, members, f, result);
  uint32_t* part = result.faceMembers.data() + result.faceMemberOffsets[f];
  for (const uint32_t m : members) {
    for (const uint32_t p : cells.membersOfFace(m)) *part++ = p;
  }
  std::sort(result.faceMembers.data() + result.faceMemberOffsets[f], part);
}

}  // namespace

void replaceFaces(const CellComplex& cells, const JoinedFaces& faces, CellComplex& result, detail::Monitor& monitor) {
  constexpr size_t kBlock = 2048;
  using detail::makeLarge;
  placeFaces(cells, faces, result);
  const size_t count = faces.members.size();
  const std::function<void()> rooms[] = {
      [&] { makeLarge(result.faceNormal, 3 * count); },
      [&] { makeLarge(result.faceCentroid, 3 * count); },
      [&] { makeLarge(result.loopVertices, result.loopOffsets.back()); },
      [&] { makeLarge(result.faceArea, count); },
      [&] { makeLarge(result.faceCells, 2 * count); },
      [&] { makeLarge(result.faceMembers, result.faceMemberOffsets.back()); },
      [&] { makeLarge(result.faceTag, count); },
  };
  detail::runTasks(rooms, monitor);
  detail::runChunks(
      count, detail::chunkCount(count, monitor, kBlock), monitor,
      [&](size_t, size_t begin, size_t end) {
        for (size_t f = begin; f < end; ++f) fillFace(cells, faces, f, result);
      },
      kBlock);
}

}  // namespace mandoline::merging

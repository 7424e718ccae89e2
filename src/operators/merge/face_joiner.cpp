#include "operators/merge/face_joiner.h"

#include <algorithm>

#include "operators/measure/vector.h"

namespace mandoline::merging {
namespace {

constexpr uint32_t kNone = ~0u;

class FaceJoiner {
 public:
  FaceJoiner(const CellComplex& cells, const std::vector<Fate>& fates) : cells_(cells), joins_(cells.faceCount()) {
    std::vector<uint32_t> lastFace(cells.vertexCount(), kNone);  // per vertex
    std::vector<uint8_t> isNear(cells.vertexCount());            // per vertex: whether a face that may join others has it
    for (uint32_t f = 0; f < cells.faceCount(); ++f) {
      joins_[f] = fates[f] == Fate::joins && isSimple(f, lastFace);
      if (!joins_[f]) continue;
      for (const uint32_t v : loop(f)) isNear[v] = 1;
    }
    findMates(fates, isNear);
  }

  JoinedFaces run(const std::vector<Fate>& fates, detail::FunctionRef<bool(uint32_t, uint32_t)> mayJoin) {
    first_.assign(cells_.faceCount(), kNone);
    next_.resize(cells_.vertexCount());
    boundaryOf_.assign(cells_.vertexCount(), kNone);
    JoinedFaces result;
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

 private:
  struct Edge {
    uint32_t high, face;
    uint32_t corner;  ///< where it begins in the loop
    bool ascends;
  };

  std::span<const uint32_t> loop(uint32_t face) const { return cells_.loops(face)[0]; }

  bool isSimple(uint32_t face, std::vector<uint32_t>& lastFace) const {
    if (cells_.loops(face).size() != 1) return false;
    for (const uint32_t v : loop(face)) {
      if (lastFace[v] == face) return false;
      lastFace[v] = face;
    }
    return true;
  }

  /// Calls visit(from, to, corner) for each edge of a face's loops.
  template <class Visit>
  void forEachEdge(uint32_t face, const Visit& visit) const {
    for (uint32_t l = cells_.faceLoopOffsets[face]; l < cells_.faceLoopOffsets[face + 1]; ++l) {
      const uint32_t begin = cells_.loopOffsets[l], end = cells_.loopOffsets[l + 1];
      for (uint32_t i = begin; i < end; ++i) visit(cells_.loopVertices[i], cells_.loopVertices[i + 1 < end ? i + 1 : begin], i);
    }
  }

  void findMates(const std::vector<Fate>& fates, const std::vector<uint8_t>& isNear) {
    mates_.assign(cells_.loopVertices.size(), kNone);
    std::vector<Edge> all;
    std::vector<uint32_t> lows;
    for (uint32_t f = 0; f < cells_.faceCount(); ++f) {
      if (fates[f] == Fate::goes) continue;
      forEachEdge(f, [&](uint32_t from, uint32_t to, uint32_t corner) {
        if (!isNear[from] || !isNear[to]) return;
        lows.push_back(std::min(from, to));
        all.push_back({std::max(from, to), f, corner, from < to});
      });
    }
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
  void pair(const Edge& a, const Edge& b) {
    if (!joins_[a.face] || !joins_[b.face] || a.face == b.face || a.ascends == b.ascends) return;
    mates_[a.corner] = b.face;
    mates_[b.corner] = a.face;
  }

  void grow(uint32_t first, detail::FunctionRef<bool(uint32_t, uint32_t)> mayJoin) {
    first_[first] = first;
    boundarySize_ = 0;
    forEachEdge(first, [&](uint32_t from, uint32_t to, uint32_t) { addToBoundary(from, to, first); });
    boundarySize_ = loop(first).size();
    for (size_t before = 0; before != members_.size();) {  // what could not join at first may once others have
      before = members_.size();
      for (size_t m = 0; m < members_.size(); ++m) {
        forEachEdge(members_[m], [&](uint32_t, uint32_t, uint32_t corner) {
          const uint32_t mate = mates_[corner];
          if (mate == kNone || first_[mate] != kNone || !mayJoin(first, mate) || !take(mate, first)) return;
          first_[mate] = first;
          members_.push_back(mate);
        });
      }
    }
  }

  void addToBoundary(uint32_t from, uint32_t to, uint32_t first) {
    boundaryOf_[from] = first;
    next_[from] = to;
  }

  /// Takes a face if the two have one path of edges in common, and no other vertices.
  bool take(uint32_t face, uint32_t first) {
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

  void addLoop(uint32_t first, std::vector<uint32_t>& loops) const {
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

  const CellComplex& cells_;
  std::vector<uint8_t> joins_;        // per face
  std::vector<uint32_t> mates_;       // per corner of a loop: the only other face at the edge that begins there, if both may join others
  std::vector<uint32_t> first_;       // per face: the first member of its new face, once it has one
  std::vector<uint32_t> members_;     // of the new face that grows
  std::vector<uint32_t> boundaryOf_;  // per vertex: the first member of the new face that grew last with the vertex on its boundary
  std::vector<uint32_t> next_;        // per vertex: the one after it on that boundary
  size_t boundarySize_ = 0;
};

/// Area, normal and centroid of a new face. The centroid is moved along the normal to where area times height is that of all members.
void addMeasures(const CellComplex& cells, std::span<const uint32_t> members, CellComplex& result) {
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
  result.faceArea.push_back(isOne ? area : length);
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
    result.faceNormal.push_back(normal);
    result.faceCentroid.push_back(cells.faceCentroid[3 * first + d] + (isOne ? 0 : offset[d] + shift * normal));
  }
}

}  // namespace

JoinedFaces joinFaces(const CellComplex& cells, const std::vector<Fate>& fates, detail::FunctionRef<bool(uint32_t, uint32_t)> mayJoin) {
  return FaceJoiner(cells, fates).run(fates, mayJoin);
}

void replaceFaces(const CellComplex& cells, const JoinedFaces& faces, CellComplex& result) {
  result.loopOffsets = result.faceLoopOffsets = result.faceMemberOffsets = {0};
  const auto addLoop = [&](std::span<const uint32_t> loop) {
    result.loopVertices.insert(result.loopVertices.end(), loop.begin(), loop.end());
    result.loopOffsets.push_back(uint32_t(result.loopVertices.size()));
  };
  for (size_t f = 0; f < faces.members.size(); ++f) {
    const auto members = faces.members[f];
    const uint32_t first = members[0];
    if (faces.loops[f].empty()) {
      for (const auto loop : cells.loops(first)) addLoop(loop);
    } else {
      addLoop(faces.loops[f]);
    }
    result.faceLoopOffsets.push_back(uint32_t(result.loopOffsets.size()) - 1);
    for (size_t side = 0; side < 2; ++side) result.faceCells.push_back(cells.faceCells[2 * size_t(first) + side]);
    result.faceTag.push_back(cells.faceTag[first]);
    addMeasures(cells, members, result);
    for (const uint32_t m : members) {
      for (const uint32_t part : cells.membersOfFace(m)) result.faceMembers.push_back(part);
    }
    std::sort(result.faceMembers.begin() + result.faceMemberOffsets.back(), result.faceMembers.end());
    result.faceMemberOffsets.push_back(uint32_t(result.faceMembers.size()));
    result.cutFaces += first < cells.cutFaces;
  }
}

}  // namespace mandoline::merging

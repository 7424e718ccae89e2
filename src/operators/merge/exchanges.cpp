#include "operators/merge/exchanges.h"

#include <algorithm>

#include "base/large_array.h"
#include "operators/measure/vector.h"

namespace mandoline::merging {

namespace {

/// Faces that are at least so far from both centroids, in lengths of the line between them, are fine.
constexpr double kFineShare = 0.1;

/// What other moves are tried for than single ones: about 66 degrees.
constexpr double kVeryBad = 0.2;

/// More are not tried two at once.
constexpr size_t kMostFirstMoves = 64;

/// How much worse the first of two moves may make faces.
constexpr double kMostWorse = 4;

constexpr int kSweeps = 8, kMovesForFace = 32;

}  // namespace

Exchanges::Exchanges(const CellComplex& cells, Clusters& clusters) : cells_(cells), clusters_(clusters) {
  detail::makeLarge(seen_, cells.cellCount());
}

void Exchanges::run(detail::Monitor& monitor) {
  for (const Kind kind : {Kind::single, Kind::pairs, Kind::whole}) {
    if (kind != Kind::single && !sweep(kind, monitor)) continue;
    for (int i = 0; i < kSweeps && sweep(Kind::single, monitor); ++i) {
    }
  }
}

/// Goes through all faces. Whether there were any moves.
bool Exchanges::sweep(Kind kind, detail::Monitor& monitor) {
  bool any = false;
  for (uint32_t f = 0; f < cells_.faceCount(); ++f) {
    if (f % 4096 == 0) monitor.report(f, cells_.faceCount());
    any |= improveFace(f, kind);
  }
  return any;
}

/// The cell on the other side, unless it is the outside or beyond a triangle.
uint32_t Exchanges::across(uint32_t halfFace) const {
  const int32_t other = cells_.faceCells[halfFace ^ 1];
  return other < 0 || cells_.faceTag[halfFace / 2] == FaceTag::surface ? kNone : uint32_t(other);
}

uint32_t Exchanges::clusterAcross(uint32_t halfFace) const {
  const uint32_t other = across(halfFace);
  return other == kNone ? kNone : clusters_.clusterOf(other);
}

/// How far a face is from fine, where the centroid of its half-face's cell is `from` and that on the other side `to`.
double Exchanges::badness(uint32_t halfFace, const Vector& from, const Vector& to) const {
  const size_t f = halfFace / 2;
  double before = 0, after = 0;
  for (size_t d = 0; d < 3; ++d) {
    const double normal = (halfFace % 2 ? -1 : 1) * cells_.faceNormal[3 * f + d];
    before += normal * (cells_.faceCentroid[3 * f + d] - from[d]);
    after += normal * (to[d] - cells_.faceCentroid[3 * f + d]);
  }
  const double length = measuring::length(measuring::difference(to, from));
  if (!(length > 0)) return 2;
  const double slant = std::max(0.0, 1 - (before + after) / length / kFineCosine);
  const double share = std::max(0.0, 1 - std::min(before, after) / length / kFineShare);
  return slant + share;
}

bool Exchanges::improveFace(uint32_t face, Kind kind) {
  bool any = false;
  for (int i = 0; i < kMovesForFace; ++i) {
    const uint32_t a = clusterAcross(2 * face + 1), b = clusterAcross(2 * face);
    if (a == kNone || b == kNone || a == b) return any;
    const double bad = badness(2 * face, clusters_[a].centroid, clusters_[b].centroid);
    if (!(bad > (kind == Kind::single ? 0 : kVeryBad))) return any;
    const auto change = [&](uint32_t cell) { return kind == Kind::pairs ? improveTwice(cell) : improve(cell, kind); };
    const bool isMoved = change(a) || change(b);
    if (!isMoved) return any;
    any = true;
  }
  return any;
}

/// Makes the best of the moves that change the cluster, if one makes faces better.
bool Exchanges::improve(uint32_t cell, Kind kind) {
  Move best;
  double most = 0;
  findMoves(clusters_.clusterOf(cell), kind);
  findBest(most, best);
  if (!(most > 0)) return false;
  make(best);
  return true;
}

/// Makes a move that makes faces worse and the best one after it, if both together make them better.
bool Exchanges::improveTwice(uint32_t cell) {
  findMoves(clusters_.clusterOf(cell), Kind::single);
  const std::vector<Move> firsts = moves_;
  if (firsts.size() > kMostFirstMoves) return false;
  for (const Move& first : firsts) {
    const uint32_t from = clusters_.clusterOf(first.cell);
    const double gained = gain(first);
    if (gained < -kMostWorse) continue;
    std::vector<uint32_t> before[2] = {members_[0], {}};
    for (const uint32_t c : members_[1]) before[clusters_.clusterOf(c) == from ? 0 : 1].push_back(c);
    clusters_.divide(members_[0], members_[1]);
    Move second;
    double most = std::max(0.0, -gained);
    const double least = most;
    for (const uint32_t end : {before[0][0], before[1][0]}) {
      findMoves(clusters_.clusterOf(end), Kind::single);
      findBest(most, second);
    }
    if (most > least) {
      make(second);
      return true;
    }
    clusters_.divide(before[0], before[1]);
  }
  return false;
}

/// Of the moves, one by which faces gain more than `most`.
void Exchanges::findBest(double& most, Move& best) {
  for (const Move& move : moves_) {
    const double gained = gain(move);
    if (gained > most) most = gained, best = move;
  }
}

void Exchanges::make(const Move& move) {
  divide(move, clusters_.clusterOf(move.cell));
  clusters_.divide(members_[0], members_[1]);
}

/// Cells that the cluster could give to others, or take from them; or itself as a whole.
void Exchanges::findMoves(uint32_t cluster, Kind kind) {
  moves_.clear();
  clusters_.forEachMember(cluster, [&](uint32_t c) {
    for (const uint32_t h : cells_.halfFaces(c)) {
      const uint32_t other = clusterAcross(h);
      if (other == kNone || other == cluster) continue;
      if (kind == Kind::whole) {
        moves_.push_back({cluster, other, true});
      } else {
        moves_.push_back({c, other});
        moves_.push_back({across(h), cluster});
      }
    }
  });
  std::sort(moves_.begin(), moves_.end());
  moves_.erase(std::unique(moves_.begin(), moves_.end()), moves_.end());
}

/// By how much all faces of both clusters get better; less than 0 where they get worse, kNotPossible where the move is not.
double Exchanges::gain(const Move& move) {
  const uint32_t from = clusters_.clusterOf(move.cell), to = clusters_.clusterOf(move.to);
  const Cluster before[] = {clusters_[from], clusters_[to]};
  if (clusters_.isOctreeCell(move.isWhole ? before[0].base : move.cell) ||
      cells_.cellRegion[move.cell] != cells_.cellRegion[before[1].base])
    return kNotPossible;
  if (from == to || before[1].volume + cells_.cellVolume[move.cell] > clusters_.mostVolume(before[0], before[1])) return kNotPossible;
  divide(move, from);
  const bool isOfMerged = !move.isWhole || members_[1].size() > 2;
  if (members_[0].empty() != move.isWhole || !isOfMerged || isSeparated(from, to)) return kNotPossible;
  const Cluster after[] = {move.isWhole ? before[0] : clusters_.madeOf(members_[0]), clusters_.madeOf(members_[1])};
  if (!clusters_.hasRoom(after[1])) return kNotPossible;
  if (!move.isWhole && (clusters_.isSmall(after[0]) || !clusters_.hasRoom(after[0]))) return kNotPossible;
  return badnessOf(from, to, before, false) - badnessOf(from, to, after, true);
}

/// Which members both clusters would have: what hangs together with the base of the one that gives stays in it.
void Exchanges::divide(const Move& move, uint32_t from) {
  for (std::vector<uint32_t>& members : members_) members.clear();
  clusters_.forEachMember(from, [&](uint32_t c) {
    if (c != move.cell && !move.isWhole) members_[0].push_back(c);
    if (c != move.cell && move.isWhole) members_[1].push_back(c);
  });
  ++now_;
  if (!members_[0].empty()) stack_.assign(1, clusters_.madeOf(members_[0]).base);
  for (const uint32_t c : stack_) seen_[c] = now_;
  while (!stack_.empty()) {
    const uint32_t c = stack_.back();
    stack_.pop_back();
    for (const uint32_t h : cells_.halfFaces(c)) {
      const uint32_t other = across(h);
      if (other == kNone || other == move.cell || stays(other) || clusters_.clusterOf(other) != from) continue;
      seen_[other] = now_;
      stack_.push_back(other);
    }
  }
  const auto isCutOff = [&](uint32_t c) { return !stays(c); };
  members_[1].push_back(move.cell);
  std::copy_if(members_[0].begin(), members_[0].end(), std::back_inserter(members_[1]), isCutOff);
  std::erase_if(members_[0], isCutOff);
  clusters_.forEachMember(clusters_.clusterOf(move.to), [&](uint32_t c) { members_[1].push_back(c); });
}

/// Whether a triangle is between what would go and the other cluster.
bool Exchanges::isSeparated(uint32_t from, uint32_t to) const {
  for (const uint32_t c : members_[1]) {
    if (clusters_.clusterOf(c) != from) continue;
    for (const uint32_t h : cells_.halfFaces(c)) {
      const int32_t other = cells_.faceCells[h ^ 1];
      if (cells_.faceTag[h / 2] == FaceTag::surface && other >= 0 && clusters_.clusterOf(uint32_t(other)) == to) return true;
    }
  }
  return false;
}

/// That of all faces of two clusters, before or after the move.
double Exchanges::badnessOf(uint32_t from, uint32_t to, const Cluster (&both)[2], bool isAfter) const {
  const auto ownerOf = [&](uint32_t cell) {
    const uint32_t cluster = clusters_.clusterOf(cell);
    return isAfter && cluster == from && !stays(cell) ? to : cluster;
  };
  const auto centroidOf = [&](uint32_t cluster) -> const Vector& {
    return (cluster == from ? both[0] : cluster == to ? both[1] : clusters_[cluster]).centroid;
  };
  double sum = 0;
  for (const std::vector<uint32_t>& members : members_) {
    for (const uint32_t c : members) {
      const uint32_t mine = ownerOf(c);
      for (const uint32_t h : cells_.halfFaces(c)) {
        const uint32_t beyond = across(h);
        if (beyond == kNone) continue;
        const uint32_t other = ownerOf(beyond);
        if (other == mine || (mine == to && other == from)) continue;  // which is counted from the other side
        sum += badness(h, centroidOf(mine), centroidOf(other));
      }
    }
  }
  return sum;
}

}  // namespace mandoline::merging

#include "operators/merge/clusters.h"

#include <algorithm>
#include <numeric>
#include <queue>

#include "base/large_array.h"
#include "operators/measure/vector.h"
#include "operators/merge/exchanges.h"

namespace mandoline::merging {

namespace {

/// Of small clusters joining large ones alone. More make no difference, unless almost all cells are small.
constexpr int kRounds = 4;

/// How much larger than a grid cell a merged cell may be, in fractions.
constexpr double kRoom = 2.5;

/// Cells below it are films, in fractions of a grid cell.
constexpr double kFilm = 0.001;

/// A small cluster that waits for its turn.
struct Waiting {
  double volume;  ///< by its unit
  uint32_t cluster;
  bool operator<(const Waiting& other) const {  // the smallest is the first of the queue
    return volume != other.volume ? volume > other.volume : cluster > other.cluster;
  }
};

}  // namespace

Clusters::Clusters(const CutMesh& cutMesh, const CellComplex& cells, double fraction)
    : cutMesh_(cutMesh), cells_(cells), fraction_(fraction), most_(1 + kRoom * fraction) {
  const size_t count = cells.cellCount();
  detail::reserveLarge(clusters_, count);
  for (auto* array : {&clusterOf_, &size_, &place_, &stamp_, &separated_}) detail::makeLarge(*array, count);
  std::fill(size_.begin(), size_.end(), 1u);
  std::iota(clusterOf_.begin(), clusterOf_.end(), 0u);
  detail::copyLarge(clusterOf_, next_);
  for (uint32_t c = 0; c < count; ++c) clusters_.push_back(singleCell(c));
}

Cluster Clusters::singleCell(uint32_t cell) const {
  const double volume = cells_.cellVolume[cell];
  Cluster cluster{volume, isOctreeCell(cell) ? volume : gridCellVolume(cell), cell, {}, {}, {}};
  for (size_t d = 0; d < 3; ++d) {
    cluster.centroid[d] = cells_.cellCentroid[3 * size_t(cell) + d];
    cluster.low[d] = cells_.cellCorner[3 * size_t(cell) + d];
    cluster.past[d] = endOf(cell, d);
  }
  return cluster;
}

Cluster Clusters::madeOf(std::span<uint32_t> members) const {
  std::sort(members.begin(), members.end());
  Cluster cluster = singleCell(members[0]);
  for (const uint32_t c : members.subspan(1)) cluster = joined(cluster, singleCell(c));
  return cluster;
}

double Clusters::gridCellVolume(uint32_t cell) const {
  double volume = 1;
  for (size_t d = 0; d < 3; ++d) {
    const std::vector<double>& planes = cutMesh_.grid.planes[d];
    const size_t first = size_t(cells_.cellCorner[3 * size_t(cell) + d]), past = std::min(size_t(endOf(cell, d)), planes.size() - 1);
    volume *= planes[past] - planes[first];
  }
  return volume;
}

bool Clusters::isBetterBase(uint32_t a, uint32_t b) const {
  if (isOctreeCell(a) != isOctreeCell(b)) return isOctreeCell(a);
  return cells_.cellVolume[a] != cells_.cellVolume[b] ? cells_.cellVolume[a] > cells_.cellVolume[b] : a < b;
}

Cluster Clusters::joined(const Cluster& a, const Cluster& b) const {
  Cluster result = isBetterBase(a.base, b.base) ? a : b;
  result.volume = a.volume + b.volume;
  for (size_t d = 0; d < 3 && result.volume > 0; ++d)
    result.centroid[d] = (a.volume * a.centroid[d] + b.volume * b.centroid[d]) / result.volume;
  for (size_t d = 0; d < 3; ++d) {
    result.low[d] = std::min(a.low[d], b.low[d]);
    result.past[d] = std::max(a.past[d], b.past[d]);
  }
  return result;
}

bool Clusters::isCompact(const Cluster& cluster) const {
  for (size_t d = 0; d < 3; ++d) {
    if (cluster.low[d] < cells_.cellCorner[3 * size_t(cluster.base) + d] - 1 || cluster.past[d] > endOf(cluster.base, d) + 1) return false;
  }
  return true;
}

void Clusters::join(detail::Monitor& monitor) {
  for (int round = 0; round < kRounds && joinSmall(true, monitor); ++round) {
  }
  joinFilms();
  joinSmall(false, monitor);
  Exchanges(cells_, *this).run(monitor);
  joinSmall(false, monitor);
}

void Clusters::join(std::span<const std::array<uint32_t, 2>> pairs) {
  for (const auto& [a, b] : pairs) {
    if (clusterOf_[a] != clusterOf_[b]) unite(clusterOf_[a], clusterOf_[b]);
  }
}

/// One round, the smallest first: with large clusters beside their bases alone, or with any. Whether some have joined.
bool Clusters::joinSmall(bool onlyLarge, detail::Monitor& monitor) {
  std::priority_queue<Waiting> queue;
  bool any = false;
  for (uint32_t c = 0; c < clusters_.size(); ++c) {
    if (clusterOf_[c] == c && isSmall(clusters_[c])) queue.push({clusters_[c].volume / clusters_[c].unit, c});
  }
  const size_t all = queue.size();
  for (size_t done = 0; !queue.empty(); ++done) {
    if (done % 1024 == 0) monitor.report(std::min(done, all), all);
    const auto [volume, cluster] = queue.top();
    queue.pop();
    const bool isCurrent = clusterOf_[cluster] == cluster && volume == clusters_[cluster].volume / clusters_[cluster].unit;
    if (!isCurrent) continue;
    const uint32_t other = choose(cluster, onlyLarge);
    if (other == kNone) continue;
    any = true;
    const uint32_t both = unite(cluster, other);
    if (isSmall(clusters_[both])) queue.push({clusters_[both].volume / clusters_[both].unit, both});
  }
  return any;
}

/// Cells that are next to nothing join large clusters beside them, however far their bases are, round after round: what is between two
/// of these, as in gaps between triangles that almost meet, is divided in the middle.
void Clusters::joinFilms() {
  std::vector<uint32_t> films;
  for (uint32_t c = 0; c < clusters_.size(); ++c) {
    if (clusterOf_[c] == c && size_[c] == 1 && isSmall(clusters_[c]) && clusters_[c].volume < kFilm * clusters_[c].unit) films.push_back(c);
  }
  std::vector<std::pair<uint32_t, uint32_t>> chosen;
  do {
    chosen.clear();
    for (const uint32_t c : films) {
      const uint32_t other = chooseLarge(c);
      if (other != kNone) chosen.push_back({c, other});
    }
    for (const auto& [c, other] : chosen) {
      findWays(c);
      if (canJoin(c, clusterOf_[other])) unite(c, clusterOf_[other]);
    }
    std::erase_if(films, [&](uint32_t c) { return size_[clusterOf_[c]] > 1; });
  } while (!chosen.empty());
}

/// Of the large clusters that this one can join, the best.
uint32_t Clusters::chooseLarge(uint32_t cluster) {
  findWays(cluster);
  const Choice* best = nullptr;
  for (Choice& choice : choices_) {
    if (choice.isSmall || !canJoin(cluster, choice.cluster)) continue;
    choice.cosine = cosineAfter(cluster, choice.cluster);
    if (!best || isBetter(choice, *best)) best = &choice;
  }
  return best ? best->cluster : kNone;
}

/// Fills in the ways from a cluster to others, and the choices, and stamps those that a triangle separates from it.
void Clusters::findWays(uint32_t cluster) {
  ways_.clear();
  choices_.clear();
  ++now_;
  forEachMember(cluster, [&](uint32_t c) {
    for (const uint32_t h : cells_.halfFaces(c)) {
      const int32_t across = cells_.faceCells[h ^ 1];
      const uint32_t other = across < 0 ? cluster : clusterOf_[size_t(across)];
      if (other == cluster) continue;
      if (cells_.faceTag[h / 2] == FaceTag::surface) {
        separated_[other] = now_;
      } else {
        ways_.push_back({h, other});
        if (stamp_[other] != now_)
          stamp_[other] = now_, place_[other] = uint32_t(choices_.size()),
          choices_.push_back({other, isSmall(clusters_[other]), 0, false, 0});
        choices_[place_[other]].area += cells_.faceArea[h / 2];
      }
    }
  });
}

/// Whether both may be one cell, where a is the current cluster. It has no octree cell, since those are never small.
bool Clusters::canJoin(uint32_t a, uint32_t b) const {
  const Cluster &one = clusters_[a], &other = clusters_[b];
  if (separated_[b] == now_ || cells_.cellRegion[one.base] != cells_.cellRegion[other.base]) return false;
  return hasRoom(joined(one, other));
}

/// The cosine of the largest angle between the normal of a face that the cluster would keep and the line between centroids, if it joined
/// the other one. Small neighbours don't count: they will join others.
double Clusters::cosineAfter(uint32_t cluster, uint32_t other) const {
  const Cluster both = joined(clusters_[cluster], clusters_[other]);
  double worst = 1;
  for (const Way& way : ways_) {
    if (way.cluster == other || isSmall(clusters_[way.cluster])) continue;
    Vector line;
    double along = 0;
    for (size_t d = 0; d < 3; ++d) {
      line[d] = clusters_[way.cluster].centroid[d] - both.centroid[d];
      along += (way.halfFace % 2 ? -1 : 1) * cells_.faceNormal[3 * size_t(way.halfFace / 2) + d] * line[d];
    }
    const double length = measuring::length(line);
    worst = std::min(worst, length > 0 ? along / length : 0);
  }
  return worst;
}

bool Clusters::isBetter(const Choice& a, const Choice& b) {
  if (a.isCompact != b.isCompact) return a.isCompact;
  const double angles[] = {std::min(a.cosine, kFineCosine), std::min(b.cosine, kFineCosine)};
  if (angles[0] != angles[1]) return angles[0] > angles[1];
  if (a.isSmall != b.isSmall) return b.isSmall;
  return a.area != b.area ? a.area > b.area : a.cluster < b.cluster;
}

/// The cluster that this one joins, if there is one.
uint32_t Clusters::choose(uint32_t cluster, bool onlyLarge) {
  findWays(cluster);
  const Choice* best = nullptr;
  for (Choice& choice : choices_) {
    if (!canJoin(cluster, choice.cluster)) continue;
    choice.isCompact = isCompact(joined(clusters_[cluster], clusters_[choice.cluster]));
    if (onlyLarge && (choice.isSmall || !choice.isCompact)) continue;
    choice.cosine = cosineAfter(cluster, choice.cluster);
    if (onlyLarge && choice.cosine < kFineCosine) continue;
    if (!best || isBetter(choice, *best)) best = &choice;
  }
  return best ? best->cluster : kNone;
}

/// Makes one cluster of two; gives it.
uint32_t Clusters::unite(uint32_t a, uint32_t b) {
  const Cluster both = joined(clusters_[a], clusters_[b]);
  if (size_[a] < size_[b]) std::swap(a, b);
  forEachMember(b, [&](uint32_t c) { clusterOf_[c] = a; });
  std::swap(next_[a], next_[b]);
  size_[a] += size_[b];
  clusters_[a] = both;
  return a;
}

void Clusters::divide(std::span<uint32_t> a, std::span<uint32_t> b) {
  for (const std::span<uint32_t> members : {a, b}) {
    if (members.empty()) continue;
    const Cluster cluster = madeOf(members);
    const uint32_t id = members[0];
    for (size_t i = 0; i < members.size(); ++i) {
      clusterOf_[members[i]] = id;
      next_[members[i]] = members[(i + 1) % members.size()];
    }
    size_[id] = uint32_t(members.size());
    clusters_[id] = cluster;
  }
}

}  // namespace mandoline::merging

// Cut-edges: in each cell they cancel, and around each of them the faces leave no cell out (paper, 3.5 and 4.4).
#include <algorithm>

#include "base/sort.h"
#include "operators/validate/grid_cell_checks.h"

namespace mandoline::validation {
namespace {

// Turning from the lower vertex to the higher one as a right-handed screw, a face that runs forward has its normal's side next.
int sideAfter(bool forward) { return forward ? 1 : 0; }
int sideBefore(bool forward) { return forward ? 0 : 1; }

/// Grows with the angle of (x, y), from -2 to 2.
double pseudoAngle(double x, double y) {
  const double p = x / (std::fabs(x) + std::fabs(y));
  return y < 0 ? p - 1 : 1 - p;
}

}  // namespace

void EdgeCheck::collectUses(const GridCell& cell) {
  uses_.clear();
  for (uint32_t f = 0; f < cell.faces.size(); ++f) {
    for (uint32_t i = cell.faces[f].firstCorner; i < cell.faces[f].lastCorner; ++i) {
      const uint32_t u = cell.cornerVertex[i], v = cell.cornerVertex[cell.cornerNext[i]];
      uses_.push_back({{std::min(u, v), std::max(u, v)}, f, u < v});
    }
  }
  std::sort(uses_.begin(), uses_.end(), [](const Use& a, const Use& b) { return a.key() < b.key(); });
}

const CellEdges& EdgeCheck::run(const GridCell& cell) {
  collectUses(cell);
  shells_.reset(2 * cell.faces.size());
  found_.edges.clear();
  for (size_t begin = 0, end = 0; begin < uses_.size(); begin = end) {
    while (end < uses_.size() && uses_[end].edge == uses_[begin].edge) ++end;
    const std::span<Use> uses(uses_.data() + begin, end - begin);
    found_.edges.push_back(uses[0].edge);
    checkCancel(cell, uses);
    if (uses.size() < 3 || sortByAngle(cell, uses)) {
      for (size_t i = 0; i < uses.size(); ++i) join(cell, uses[i], uses[(i + 1) % uses.size()]);
    } else {
      joinLoosely(cell, uses);
    }
  }
  found_.shell.resize(2 * cell.faces.size());
  for (uint32_t h = 0; h < found_.shell.size(); ++h) found_.shell[h] = shells_.find(h);
  return found_;
}

void EdgeCheck::checkCancel(const GridCell& cell, std::span<const Use> uses) {
  directions_.clear();
  for (const Use& use : uses) {
    const int32_t* owner = cell.faces[use.face].owner;
    if (owner[0] == owner[1]) continue;
    const int32_t direction = use.forward ? 1 : -1;
    if (owner[0] >= 0) directions_.push_back({owner[0], direction});
    if (owner[1] >= 0) directions_.push_back({owner[1], -direction});
  }
  detail::sortItems(directions_);
  for (size_t begin = 0, end = 0; begin < directions_.size(); begin = end) {
    int32_t sum = 0;
    for (; end < directions_.size() && directions_[end].first == directions_[begin].first; ++end) sum += directions_[end].second;
    if (sum != 0)
      closed_.violate("cell", directions_[begin].first,
                      "has an edge that its half-faces do not run through equally often in both directions");
  }
}

void EdgeCheck::join(const GridCell& cell, const Use& use, const Use& next) {
  const int after = sideAfter(use.forward), before = sideBefore(next.forward);
  const int32_t here = cell.faces[use.face].owner[after], there = cell.faces[next.face].owner[before];
  if (here != there) {
    facing_.violate("face", cell.faces[next.face].id, "belongs to another cut-cell than the face that it faces at one of its edges");
  } else if (here >= 0) {
    shells_.unite(2 * use.face + after, 2 * next.face + before);
  }
}

/// False if rounding leaves the order open. Faces contain the edge, so their order about it is that of their normals (those of faces
/// that run backward reversed), and may be seen along the axis that is closest to the edge.
bool EdgeCheck::sortByAngle(const GridCell& cell, std::span<Use> uses) {
  const Context& x = cell.context;
  const Vec3 from = x.vertex(uses[0].edge[0]), to = x.vertex(uses[0].edge[1]), along = to - from;
  constexpr double kLongEnough = 16 * kTolerance;  // in roundings: then the direction is known well enough to choose the axis by
  if (length(x.inRoundings(to, from)) < kLongEnough) return ++unjudged_, false;
  const int axis = dominantAxis(along), e = (axis + 1) % 3, f = (axis + 2) % 3;
  double noise = 0;
  angles_.clear();
  for (const Use& use : uses) {
    const uint32_t id = cell.faces[use.face].id;
    const int plane = x.cut.faceAxis[id];
    Normal normal;
    if (plane >= 0) {
      normal.n[plane] = x.axialSide(id);
    } else {
      normal = x.triangleNormal(size_t(x.cut.faceTriangle[id]));
    }
    const double sign = use.forward ? 1 : -1, size = std::fabs(normal.n[e]) + std::fabs(normal.n[f]);
    if (!(size > 0)) return ++unjudged_, false;
    noise = std::max(noise, (normal.error[e] + normal.error[f]) / size + 4 * kRounding);
    angles_.push_back({pseudoAngle(sign * normal.n[e], (along[axis] > 0 ? sign : -sign) * normal.n[f]), use});
  }
  detail::sortItems(angles_, [](const auto& a, const auto& b) { return a.first < b.first; });
  // The error of a normal turns its pseudo-angle by at most twice its relative size.
  const double apart = 4 * noise;
  for (size_t i = 0; i < angles_.size(); ++i) {
    const double gap = i + 1 < angles_.size() ? angles_[i + 1].first - angles_[i].first : angles_[0].first + 4 - angles_[i].first;
    if (!(gap > apart)) return ++unjudged_, false;
    uses[i] = angles_[i].second;
  }
  return true;
}

void EdgeCheck::joinLoosely(const GridCell& cell, std::span<const Use> uses) {
  std::vector<std::pair<int32_t, uint32_t>> halfFaces;
  for (const Use& use : uses) {
    for (uint32_t side = 0; side < 2; ++side) halfFaces.push_back({cell.faces[use.face].owner[side], 2 * use.face + side});
  }
  detail::sortItems(halfFaces);
  for (size_t i = 1; i < halfFaces.size(); ++i) {
    if (halfFaces[i].first == halfFaces[i - 1].first && halfFaces[i].first >= 0)
      shells_.unite(halfFaces[i].second, halfFaces[i - 1].second);
  }
}

void EdgeCheck::merge(const EdgeCheck& next) {
  closed_.merge(next.closed_);
  facing_.merge(next.facing_);
  unjudged_ += next.unjudged_;
}

Check EdgeCheck::facingFaces() const {
  return facing_.finish(unjudged_ == 0 ? ""
                                       : "The order of the faces around " + counted(unjudged_, "edge") +
                                             " was left open: too short, or the faces too close.");
}

}  // namespace mandoline::validation

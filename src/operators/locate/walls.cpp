#include "operators/locate/walls.h"

#include <algorithm>
#include <cmath>

#include "base/sort.h"

namespace mandoline::operators {
namespace {

constexpr int kRight = 0, kUp = 1, kRay = 2;  // axes: the ray's, and those of the plane that it is seen in as a point

/// A point and the signs of its moves.
struct MovedPoint {
  ScaledPoint at;
  std::array<int, 3> move;
};

/// How often the triangle winds around the point, seen along the ray: 1 or -1 if the point lies inside, as the triangle turns.
int windingInView(const Wall& wall, const MovedPoint& p, detail::Predicates& predicates) {
  const auto isAbove = [&](const ScaledPoint& q) { return q[kUp] > p.at[kUp] || (q[kUp] == p.at[kUp] && p.move[kUp] < 0); };
  int winding = 0;
  for (int i = 0; i < 3; ++i) {
    const ScaledPoint &a = wall.corners[i], &b = wall.corners[(i + 1) % 3];
    const int direction = int(isAbove(b)) - int(isAbove(a));
    if (direction == 0) continue;
    int side = predicates.orient2d({a[kRight], a[kUp]}, {b[kRight], b[kUp]}, {p.at[kRight], p.at[kUp]});
    if (side == 0) side = -direction * p.move[kRight];  // to the right of an edge that goes up
    if (side == direction) winding += direction;
  }
  return winding;
}

/// What the triangle adds to the winding number of the cell on its side 0.
int windingOf(const Wall& wall, const MovedPoint& p, detail::Predicates& predicates) {
  const auto& [a, b, c] = wall.corners;
  const double x = p.at[kRight], y = p.at[kUp];
  if (std::max({a[kRight], b[kRight], c[kRight]}) < x || std::min({a[kRight], b[kRight], c[kRight]}) > x) return 0;
  if (std::max({a[kUp], b[kUp], c[kUp]}) < y || std::min({a[kUp], b[kUp], c[kUp]}) > y) return 0;
  if (std::max({a[kRay], b[kRay], c[kRay]}) < p.at[kRay]) return 0;
  const int winding = windingInView(wall, p, predicates);
  if (winding == 0) return 0;
  int side = winding * predicates.orient3d(a.data(), b.data(), c.data(), p.at.data());
  if (side == 0) side = p.move[kRay];
  return side < 0 ? winding : 0;
}

}  // namespace

void Walls::load(const IdRange& cells, int32_t blockSize, const std::vector<ScaledPoint>& points) {
  const int32_t* gridCell = &cutMesh_.cellGridCell[3 * cells.begin];
  for (size_t d = 0; d < 3; ++d) {
    block_.low[d] = space_.scaled(cutMesh_.grid.planes[d][size_t(gridCell[d])]);
    block_.high[d] = space_.scaled(cutMesh_.grid.planes[d][size_t(gridCell[d] + blockSize)]);
  }
  points_ = {points[0], points[0]};
  for (const ScaledPoint& p : points) {
    for (size_t d = 0; d < 3; ++d) {
      points_.low[d] = std::min(points_.low[d], p[d]);
      points_.high[d] = std::max(points_.high[d], p[d]);
    }
  }
  gatherFaces(cells);
  winding_.assign(cells.size(), 0);
  makeBins(points.size());
}

uint32_t Walls::cellAt(const ScaledPoint& point) {
  MovedPoint p = {point, {}};
  for (size_t d = 0; d < 3; ++d) p.move[d] = p.at[d] == block_.high[d] ? -1 : 1;
  for (const uint32_t w : bins_[binOf(p.at, kRight) + size_t(binCount_) * binOf(p.at, kUp)]) {
    const int winding = windingOf(walls_[w], p, predicates_);
    if (winding == 0) continue;
    add(walls_[w].places[0], winding);
    add(walls_[w].places[1], -winding);
  }
  uint32_t found = kNone;
  for (const uint32_t place : met_) {
    if (winding_[place] > 0) found = std::min(found, place);
    winding_[place] = 0;
  }
  met_.clear();
  return found;
}

void Walls::add(uint32_t place, int winding) {
  if (place == kNone) return;
  winding_[place] += winding;
  met_.push_back(place);
}

void Walls::gatherFaces(const IdRange& cells) {
  halfFaces_.clear();
  walls_.clear();
  for (size_t c = cells.begin; c < cells.end; ++c) {
    for (const uint32_t h : cutMesh_.halfFaces(c)) {
      if (mayBeMet(h / 2)) halfFaces_.push_back({h, uint32_t(c - cells.begin)});
    }
  }
  detail::sortItems(halfFaces_, [](const HalfFace& a, const HalfFace& b) { return a.halfFace < b.halfFace; });
  for (size_t i = 0; i < halfFaces_.size(); ++i) {
    const uint32_t face = halfFaces_[i].halfFace / 2;
    std::array<uint32_t, 2> places = {kNone, kNone};
    places[halfFaces_[i].halfFace % 2] = halfFaces_[i].place;
    if (i + 1 < halfFaces_.size() && halfFaces_[i + 1].halfFace / 2 == face) places[1] = halfFaces_[++i].place;
    if (places[0] != places[1]) addWalls(face, places);
  }
}

/// Whether the face's box reaches those of the points' rays.
bool Walls::mayBeMet(uint32_t face) const {
  std::array<bool, 3> below = {true, true, true}, above = below;  // the face lies wholly beside the points' box
  for (const std::span<const uint32_t> loop : cutMesh_.loops(face)) {
    for (const uint32_t v : loop) {
      const ScaledPoint p = space_.scaled(&cutMesh_.positions[3 * size_t(v)]);
      for (size_t d = 0; d < 3; ++d) {
        below[d] = below[d] && p[d] < points_.low[d];
        above[d] = above[d] && p[d] > points_.high[d];
      }
    }
  }
  return !below[kRight] && !below[kUp] && !below[kRay] && !above[kRight] && !above[kUp];
}

void Walls::addWalls(uint32_t face, const std::array<uint32_t, 2>& places) {
  triangles_.clear();
  triangulator_.run(cutMesh_.face(face), triangles_);
  for (size_t t = 0; t < triangles_.size(); t += 3) {
    Wall& wall = walls_.emplace_back();
    for (size_t i = 0; i < 3; ++i) wall.corners[i] = space_.scaled(&cutMesh_.positions[3 * size_t(triangles_[t + i])]);
    wall.places = places;
  }
}

uint32_t Walls::binOf(const ScaledPoint& p, int axis) const {
  const double low = block_.low[size_t(axis)], high = block_.high[size_t(axis)];
  return uint32_t(std::clamp((p[size_t(axis)] - low) / (high - low) * binCount_, 0.0, binCount_ - 1.0));
}

/// f(bin) for the bins of a triangle's bounding box.
template <class F>
void Walls::forBins(const Wall& wall, const F& f) const {
  const auto range = [&](int axis) {
    const uint32_t a = binOf(wall.corners[0], axis), b = binOf(wall.corners[1], axis), c = binOf(wall.corners[2], axis);
    return std::pair(std::min({a, b, c}), std::max({a, b, c}));
  };
  const std::pair<uint32_t, uint32_t> x = range(kRight), y = range(kUp);
  for (uint32_t j = y.first; j <= y.second; ++j) {
    for (uint32_t i = x.first; i <= x.second; ++i) f(i + size_t(binCount_) * j);
  }
}

size_t Walls::binEntries() const {
  size_t count = 0;
  for (const Wall& wall : walls_) forBins(wall, [&](size_t) { ++count; });
  return count;
}

/// As many bins as there are triangles or points, but fewer if triangles would lie in many.
void Walls::makeBins(size_t points) {
  constexpr size_t kEntriesPerTriangle = 8;
  binCount_ = uint32_t(std::clamp(std::sqrt(double(std::min(points, walls_.size()))), 1.0, 1024.0));
  while (binCount_ > 1 && binEntries() > kEntriesPerTriangle * walls_.size()) binCount_ /= 2;
  std::vector<detail::KeyedItem> entries;
  for (uint32_t w = 0; w < walls_.size(); ++w) {
    forBins(walls_[w], [&](size_t bin) { entries.push_back({bin, w}); });
  }
  bins_ = detail::groupBy<uint32_t>(
      size_t(binCount_) * binCount_, entries.size(), [&](size_t i) { return size_t(entries[i].key); },
      [&](size_t i) { return entries[i].item; });
}

}  // namespace mandoline::operators

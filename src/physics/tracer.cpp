#include "physics/tracer.h"

#include <algorithm>
#include <cmath>

#include "operators/measure/vector.h"

namespace mandoline::physics {
namespace {

using measuring::length;

constexpr double kRest = 1e-9;  // relative to the wind

Point combined(const Point& p, double s, const Point& v) { return {p[0] + s * v[0], p[1] + s * v[1], p[2] + s * v[2]}; }
Point difference(const Point& p, const Point& q) { return combined(p, -1, q); }

}  // namespace

Tracer::Tracer(const FlowField& field, const FieldMembers& members, const Obstacles& obstacles, const StreamlineOptions& options)
    : field_(field),
      members_(members),
      obstacles_(obstacles),
      options_(options),
      space_(field.cutMesh.grid),
      walls_(field.cutMesh, space_),
      slowest_(kRest * length(field.flow.wind)) {}

void Tracer::trace(const Point& seed, size_t member, Streamlines& lines) {
  lines_ = &lines;
  enter(member);
  at_ = seed;
  time_ = length_ = 0;
  mark_ = seed, markLength_ = 0, sinceMark_ = 0;
  crossed_ = held_ = {};
  lines.offsets.push_back(uint32_t(lines.speeds.size()));
  push(seed);
  while (goOn()) {
  }
  lines.ends.push_back(end_);
}

void Tracer::enter(size_t member) {
  member_ = member;
  cell_ = members_.cellOf(member);
  corner_ = members_.cornerOf(member), past_ = members_.endOf(member);
  size_ = 0;
  for (size_t d = 0; d < 3; ++d) {
    low_[d] = field_.cutMesh.grid.planes[d][size_t(corner_[d])];
    high_[d] = field_.cutMesh.grid.planes[d][size_t(past_[d])];
    size_ = std::max(size_, high_[d] - low_[d]);
  }
}

void Tracer::push(const Point& p) {
  lines_->points.insert(lines_->points.end(), p.begin(), p.end());
  lines_->speeds.push_back(length(velocityIn(field_.cells, field_.flow, cell_, p.data())));
}

/// Without the components across sides that the line slides along.
Point Tracer::velocity(const Point& p) const {
  Point v = velocityIn(field_.cells, field_.flow, cell_, p.data());
  for (size_t d = 0; d < 3; ++d) v[d] = held_[d] ? 0 : options_.upstream ? -v[d] : v[d];
  return v;
}

/// Crosses a side or makes a step; false at the line's end.
bool Tracer::goOn() {
  const Point v = velocity(at_);
  if (!(length(v) > slowest_)) return end(StreamlineEnd::rest);
  for (size_t d = 0; d < 3; ++d) {
    if (isOutward(d, v)) return meetSide(d, v);
  }
  if (lines_->speeds.size() - lines_->offsets.back() >= options_.maxPoints) return end(StreamlineEnd::maxPoints);
  return move(v);
}

bool Tracer::isOutward(size_t axis, const Point& v) const {
  return (v[axis] > 0 && at_[axis] == high_[axis]) || (v[axis] < 0 && at_[axis] == low_[axis]);
}

/// At a side that the velocity points out of: crosses it, unless the line has just come across that axis.
bool Tracer::meetSide(size_t axis, const Point& v) {
  if (crossed_[axis]) {
    held_[axis] = true;
    return true;
  }
  crossed_[axis] = true;
  held_ = {};
  return cross({axis, v[axis] > 0});
}

bool Tracer::cross(const Side& side) {
  operators::GridCell at;
  for (size_t d = 0; d < 3; ++d) {
    const std::vector<double>& planes = field_.cutMesh.grid.planes[d];
    const auto next = std::upper_bound(planes.begin() + corner_[d] + 1, planes.begin() + past_[d], at_[d]);
    at[d] = int32_t(next - planes.begin()) - 1;
  }
  at[side.axis] = side.upper ? past_[side.axis] : corner_[side.axis] - 1;
  if (at[side.axis] < 0 || at[side.axis] >= field_.cutMesh.grid.cells(int(side.axis))) return end(StreamlineEnd::side);
  const int64_t next = memberAcross(side, at);
  if (next < 0) return end(StreamlineEnd::surface);
  enter(size_t(next));
  return true;
}

/// The member in a grid cell across a side that the current one is joined with at this point; -1 if triangles lie between, by rounding.
int64_t Tracer::memberAcross(const Side& side, const operators::GridCell& at) {
  const IdRange range = members_.in(at);
  if (range.size() == 0) return -1;
  if (!members_.isCut(range.begin)) return int64_t(range.begin);
  const std::vector<size_t> joined = joinedAcross(side, range);
  if (joined.empty()) return -1;
  if (joined.size() == 1) return int64_t(joined[0]);
  Point p = at_;
  p[side.axis] = field_.cutMesh.grid.planes[side.axis][size_t(side.upper ? at[side.axis] : at[side.axis] + 1)];
  const operators::ScaledPoint scaled = space_.scaled(p.data());
  walls_.load(range, members_.blockSize(range.begin), {scaled});
  const uint32_t place = walls_.cellAt(scaled);
  if (place == operators::Walls::kNone || std::find(joined.begin(), joined.end(), range.begin + place) == joined.end()) return -1;
  return int64_t(range.begin + place);
}

/// Those of the cut-cells in a grid cell across a side that have a piece of a grid-face there in common with the current member.
std::vector<size_t> Tracer::joinedAcross(const Side& side, const IdRange& range) const {
  const CutMesh& cutMesh = field_.cutMesh;
  const int32_t plane = side.upper ? past_[side.axis] : corner_[side.axis];
  const auto isThere = [&](uint32_t h) {
    return cutMesh.faceTriangle[h / 2] < 0 && size_t(cutMesh.faceAxis[h / 2]) == side.axis && cutMesh.facePlane[h / 2] == plane;
  };
  std::vector<uint32_t> own;  // half-faces seen from across
  if (members_.isCut(member_)) {
    for (const uint32_t h : cutMesh.halfFaces(member_)) {
      if (isThere(h)) own.push_back(h ^ 1);
    }
  }
  const auto isJoined = [&](uint32_t h) {
    return isThere(h) && (!members_.isCut(member_) || std::find(own.begin(), own.end(), h) != own.end());
  };
  std::vector<size_t> joined;
  for (size_t c = range.begin; c < range.end; ++c) {
    const auto halfFaces = cutMesh.halfFaces(c);
    if (std::any_of(halfFaces.begin(), halfFaces.end(), isJoined)) joined.push_back(c);
  }
  return joined;
}

/// The Runge-Kutta step of Bogacki and Shampine.
Tracer::Step Tracer::stepOf(double time) const {
  const Point k1 = velocity(at_), k2 = velocity(combined(at_, time / 2, k1)), k3 = velocity(combined(at_, 3 * time / 4, k2));
  Point to, error;
  for (size_t d = 0; d < 3; ++d) to[d] = at_[d] + time * (2 * k1[d] + 3 * k2[d] + 4 * k3[d]) / 9;
  const Point k4 = velocity(to);
  for (size_t d = 0; d < 3; ++d) error[d] = time * (-5 * k1[d] / 72 + k2[d] / 12 + k3[d] / 9 - k4[d] / 8);
  return {to, std::max(length(error), time * length(difference(k4, k1)) / 8)};
}

/// Makes a step, to a side of the box at most.
bool Tracer::move(const Point& v) {
  const double longest = size_ / length(v), allowed = options_.tolerance * size_;
  if (time_ == 0) time_ = longest / 4;
  time_ = std::min(time_, longest);
  Step step = stepOf(time_);
  for (int i = 0; step.error > allowed && i < 100; ++i) {
    time_ *= std::clamp(0.9 * std::sqrt(allowed / step.error), 0.1, 0.9);
    step = stepOf(time_);
  }
  const double next = time_ * std::clamp(0.9 * std::sqrt(allowed / std::max(step.error, 1e-300)), 0.2, 4.0);
  size_t axis = 3;
  double share = shareInside(step.to, axis);
  for (double time = time_; share < 1 && share > 0.01;) {  // nearer to where the curve itself meets the side
    time *= share;
    size_t sameAxis = 3;
    const Step shorter = stepOf(time);
    const double rest = shareInside(shorter.to, sameAxis);
    if (sameAxis != axis) break;
    step = shorter, share = rest;
    if (share > 0.9) break;
  }
  time_ = next;
  Point to = step.to;
  if (share < 1) {
    to = combined(at_, share, difference(step.to, at_));
    to[axis] = step.to[axis] > at_[axis] ? high_[axis] : low_[axis];
  }
  for (size_t d = 0; d < 3; ++d) to[d] = std::clamp(to[d], low_[d], high_[d]);
  if (!(std::isfinite(to[0]) && std::isfinite(to[1]) && std::isfinite(to[2]))) return end(StreamlineEnd::rest);
  if (to != at_) return advance(to);
  return share < 1 ? meetSide(axis, difference(step.to, at_)) : end(StreamlineEnd::rest);
}

/// How much of the way to a point lies in the box, and the axis that it leaves it across; 1 if all of it.
double Tracer::shareInside(const Point& to, size_t& axis) const {
  double share = 1;
  for (size_t d = 0; d < 3; ++d) {
    const double bound = to[d] > at_[d] ? high_[d] : low_[d];
    if (to[d] >= low_[d] && to[d] <= high_[d]) continue;
    const double mine = (bound - at_[d]) / (to[d] - at_[d]);
    if (mine < share) share = mine, axis = d;
  }
  return share;
}

/// Moves to a point of the box, or to where the surface or the length ends the line.
bool Tracer::advance(Point to) {
  const double way = length(difference(to, at_));
  const bool isLast = length_ + way >= options_.maxLength;
  if (isLast) {
    to = combined(at_, (options_.maxLength - length_) / way, difference(to, at_));
    for (size_t d = 0; d < 3; ++d) to[d] = std::clamp(to[d], low_[d], high_[d]);
  }
  const Segment segment{at_, to};
  const bool isFree = obstacles_.isFree(segment, predicates_);
  if (!isFree) to = obstacles_.reached(segment, predicates_);
  if (to != at_) push(to);
  if (!isFree) return end(StreamlineEnd::surface);
  if (isLast) return end(StreamlineEnd::maxLength);
  at_ = to;
  length_ += way;
  crossed_ = held_ = {};
  return getsNowhere() ? end(StreamlineEnd::rest) : true;
}

/// Potential flows have no closed lines, but where the velocities of cells contradict each other beside the surface, lines may go to and
/// fro between them.
bool Tracer::getsNowhere() {
  constexpr int kSteps = 64;
  constexpr double kLeast = 0.125;  // of the way
  if (++sinceMark_ < kSteps) return false;
  const bool nowhere = length(difference(at_, mark_)) < kLeast * (length_ - markLength_);
  mark_ = at_, markLength_ = length_, sinceMark_ = 0;
  return nowhere;
}

}  // namespace mandoline::physics

// Every point lies in exactly one cut-cell: lines through each grid cell, at least one through each of its tri-faces, pass from cut-cell to
// cut-cell only through half-faces of the one and then the other. This sees what edges can't: cells that overlap because triangles
// intersect inside a grid cell, and shells in the wrong cell.
#include <algorithm>

#include "base/sort.h"
#include "operators/validate/grid_cell_checks.h"

namespace mandoline::validation {
LineCheck::LineCheck(const Context& context) {
  constexpr uint64_t kSamples = 400;
  stride_ = 1 + (context.cut.faceCount() + 3 * context.groups.count()) / kSamples;
}

void LineCheck::run(const GridCell& cell) {
  random_ = Random(cell.cells[0]);
  for (int axis = 0; axis < 3; ++axis) {
    work_ = 0;
    tryLine(cell, axis, nullptr);
    for (const GridCell::Face& face : cell.faces) {
      if (face.side >= 0 || dominantAxis(face.area) != axis) continue;
      // Keeps the time linear where many lines meet faces of many edges, and spreads those left out.
      if (work_ > 1000 + 32 * uint64_t(face.lastCorner)) {
        ++skipped_;
      } else {
        tryLine(cell, axis, &face);
      }
    }
  }
}

void LineCheck::tryLine(const GridCell& cell, int axis, const GridCell::Face* through) {
  for (int attempt = 0; attempt < 3; ++attempt) {
    Vec3 point{{random_.between(0, 1), random_.between(0, 1), random_.between(0, 1)}};
    if (through && !pointOn(cell, *through, axis, point)) continue;
    const Verdict verdict = shoot(cell, axis, point);
    if (verdict == Verdict::unjudged) continue;
    if (verdict == Verdict::fine && random_.next() % stride_ == 0) sample(cell, axis, point);
    ++lines_;
    return;
  }
  ++unjudged_;
}

/// A point inside a face, seen along the axis: in the widest part of the face on a random line across it. False if there is none.
bool LineCheck::pointOn(const GridCell& cell, const GridCell::Face& face, int axis, Vec3& point) {
  const int d = (axis + 1) % 3, e = (axis + 2) % 3;
  point[e] = random_.between(face.low[e], face.high[e]);
  cuts_.clear();
  for (uint32_t i = face.firstCorner; i < face.lastCorner; ++i) {
    const Vec3 &a = cell.corners[i], &b = cell.corners[cell.cornerNext[i]];
    if ((a[e] > point[e]) != (b[e] > point[e])) cuts_.push_back(a[d] + (point[e] - a[e]) / (b[e] - a[e]) * (b[d] - a[d]));
  }
  detail::sortItems(cuts_);
  double widest = 0;
  for (size_t i = 1; i < cuts_.size(); i += 2) {
    const double width = cuts_[i] - cuts_[i - 1];
    if (width > widest) widest = width, point[d] = cuts_[i - 1] + random_.between(0.05, 0.95) * width;
  }
  return widest > 0;
}

LineCheck::Verdict LineCheck::shoot(const GridCell& cell, int axis, const Vec3& point) {
  hits_.clear();
  for (const int d : {(axis + 1) % 3, (axis + 2) % 3}) {
    if (!(point[d] > kTolerance * cell.noise[d] && point[d] < 1 - kTolerance * cell.noise[d])) return Verdict::unjudged;
  }
  const Vec3 margin = kTolerance * cell.noise;
  Vec3 low = point - margin, high = point + margin;
  low[axis] = -INFINITY, high[axis] = INFINITY;
  bool certain = true;
  cell.faceTree.forOverlapping(boxOf(low, high), [&](uint32_t f) { certain = certain && addHit(cell, axis, point, cell.faces[f]); });
  if (!certain) return Verdict::unjudged;
  return follow(cell, axis);
}

/// Adds the face if the line through the point hits it; false if rounding leaves that open.
bool LineCheck::addHit(const GridCell& cell, int axis, const Vec3& point, const GridCell::Face& face) {
  if (face.side >= 0 && face.side / 2 != axis) return true;  // parallel to the line
  work_ += face.lastCorner - face.firstCorner;
  const Place place = placeOn(cell, face, axis, point, kTolerance * cell.noise);
  if (place != Place::inside) return place == Place::outside;

  Hit hit{0, 0, face.owner[0], face.owner[1], &face};
  if (!placeHit(cell, axis, point, hit)) return false;
  hits_.push_back(hit);
  return true;
}

/// Fills in where on the line the hit is, and turns it to the line's direction.
bool LineCheck::placeHit(const GridCell& cell, int axis, const Vec3& point, Hit& hit) const {
  const int e = (axis + 1) % 3, f = (axis + 2) % 3;
  const GridCell::Face& face = *hit.face;
  bool up = true;
  if (face.side >= 0) {
    hit.low = hit.high = face.side % 2;
    up = cell.context.axialSide(face.id) > 0;
  } else {
    Normal normal = cell.context.triangleNormal(size_t(cell.context.cut.faceTriangle[face.id]));
    for (int d = 0; d < 3; ++d) normal.n[d] *= cell.size[d], normal.error[d] *= cell.size[d];
    const double steep = std::fabs(normal.n[axis]) - normal.error[axis];
    if (!(steep > 0)) return false;
    const Vec3 delta = point - cell.corners[face.firstCorner];
    const double rise = -(normal.n[e] * delta[e] + normal.n[f] * delta[f]) / normal.n[axis];
    const double tilted =
        (normal.error[e] * std::fabs(delta[e]) + normal.error[f] * std::fabs(delta[f]) + normal.error[axis] * std::fabs(rise)) / steep;
    const double slope = (std::fabs(normal.n[e]) * cell.noise[e] + std::fabs(normal.n[f]) * cell.noise[f]) / steep;
    const double error = tilted + kTolerance * (cell.noise[axis] + slope);
    const double depth = cell.corners[face.firstCorner][axis] + rise, margin = kTolerance * cell.noise[axis];
    hit.low = std::max(depth - error, face.low[axis] - margin);
    hit.high = std::min(depth + error, face.high[axis] + margin);
    if (!(hit.low <= hit.high)) return false;
    up = normal.n[axis] > 0;
  }
  if (!up) std::swap(hit.below, hit.above);
  return true;
}

LineCheck::Verdict LineCheck::follow(const GridCell& cell, int axis) {
  detail::sortItems(hits_, [](const Hit& a, const Hit& b) { return a.low != b.low ? a.low < b.low : a.high < b.high; });
  for (size_t i = 1; i < hits_.size(); ++i) {
    if (hits_[i - 1].high < hits_[i].low) continue;
    const int32_t s = cell.context.cut.faceTriangle[hits_[i - 1].face->id], t = cell.context.cut.faceTriangle[hits_[i].face->id];
    if (s < 0 || t < 0 || !cell.context.haveOnePlane(size_t(s), size_t(t))) return Verdict::unjudged;
    partition_.violate("face", hits_[i].face->id, "lies partly on another one");
    return Verdict::broken;
  }
  if (hits_.size() < 2 || hits_.front().face->side != 2 * axis || hits_.back().face->side != 2 * axis + 1) {
    partition_.violate("cell", cell.cells[0], "and the others of its grid cell do not reach from side to side of it");
    return Verdict::broken;
  }
  for (size_t i = 1; i < hits_.size(); ++i) {
    if (hits_[i - 1].above == hits_[i].below && hits_[i].below >= 0) continue;
    partition_.violate("cell", std::max(hits_[i - 1].above, hits_[i].below), "overlaps another cell, or leaves a gap to it");
    return Verdict::broken;
  }
  return Verdict::fine;
}

/// A point in the middle between two hits.
void LineCheck::sample(const GridCell& cell, int axis, Vec3 point) {
  const size_t i = 1 + size_t(random_.next() % (hits_.size() - 1));
  point[axis] = (hits_[i - 1].high + hits_[i].low) / 2;
  Vec3 position;
  for (int d = 0; d < 3; ++d) position[d] = cell.low[d] + cell.size[d] * point[d];
  const int32_t owner = hits_[i].below;
  samples_.push_back({position, cell.context.cut.cellRegion[owner], "cell", owner});
}

void LineCheck::merge(const LineCheck& next) {
  partition_.merge(next.partition_);
  lines_ += next.lines_;
  unjudged_ += next.unjudged_;
  skipped_ += next.skipped_;
  samples_.insert(samples_.end(), next.samples_.begin(), next.samples_.end());
}

Check LineCheck::partition() const {
  if (unjudged_ + skipped_ == 0) return partition_.finish();
  return partition_.finish("Of " + counted(lines_ + unjudged_ + skipped_, "line") + ", " + std::to_string(unjudged_) +
                           " passed too close to an edge to judge and " + std::to_string(skipped_) + " were left out to save time.");
}

}  // namespace mandoline::validation

#include "physics/far_field.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "operators/measure/vector.h"
#include "physics/dual_edges.h"
#include "physics/face_box.h"

namespace mandoline::physics {
namespace {

/// At most so many blocks along an axis.
constexpr size_t kMaxBlocks = 16;

void include(detail::Box& box, const Point& point) { box.include({point, point}); }

void forVerticesOf(const CellComplex& cells, size_t face, const auto& visit) {
  const Loops loops = cells.loops(face);
  for (size_t l = 0; l < loops.size(); ++l) {
    for (const uint32_t v : loops[l]) visit(v);
  }
}

/// From one point to another, in a unit of length.
Point stepBetween(const Point& from, const Point& to, double unit) {
  return {(to[0] - from[0]) / unit, (to[1] - from[1]) / unit, (to[2] - from[2]) / unit};
}

/// How many whole edges fit from low to x, if less than `count`.
size_t rowOf(double x, double low, double edge, size_t count) {
  const double row = (x - low) / edge;
  return row >= 1 ? size_t(std::min(row, double(count - 1))) : 0;
}

/// That around those of all processes.
void uniteBoxes(const FarFieldShare& share, detail::Box& box) {
  if (!share.least) return;
  std::vector<double> bounds(6);
  for (size_t d = 0; d < 3; ++d) bounds[2 * d] = box.low[d], bounds[2 * d + 1] = -box.high[d];
  share.least(bounds);
  for (size_t d = 0; d < 3; ++d) box.low[d] = bounds[2 * d], box.high[d] = -bounds[2 * d + 1];
}

bool isEmpty(const detail::Box& box) { return !(box.low[0] <= box.high[0]); }

}  // namespace

std::optional<uint32_t> wallOnSide(const CellComplex& cells, const Boundary& boundary, const FarFieldShare& share) {
  std::vector<char> isOnSide(cells.vertexCount());
  for (const uint32_t h : boundary.halfFaces) {
    if (cells.faceTag[h / 2] < FaceTag::inner) forVerticesOf(cells, h / 2, [&](uint32_t v) { isOnSide[v] = 1; });
  }
  for (const uint32_t h : boundary.halfFaces) {
    if (cells.faceTag[h / 2] < FaceTag::inner || !share.owns(size_t(cells.faceCells[h]))) continue;
    bool reaches = cells.faceCells[h ^ 1] < 0;  // it is in the side: where the surface is all of the box, no face is a side
    forVerticesOf(cells, h / 2, [&](uint32_t v) { reaches |= isOnSide[v] != 0; });
    if (reaches) return h / 2;
  }
  return std::nullopt;
}

FarField::FarField(const CellComplex& cells, const Boundary& boundary, const FarFieldShare& share)
    : cells_(cells), share_(share), boundarySize_(boundary.halfFaces.size()) {
  std::vector<uint32_t> walls;
  detail::Box box = detail::Box::empty(), wallBox = box;
  for (size_t b = 0; b < boundarySize_; ++b) {
    const uint32_t h = boundary.halfFaces[b], f = h / 2;
    const auto cell = size_t(cells.faceCells[h]);
    const bool isSide = cells.faceTag[f] < FaceTag::inner, isOwn = share.owns(cell);
    if (isOwn) forVerticesOf(cells, f, [&](uint32_t v) { include(isSide ? box : wallBox, pointAt(cells.positions, v)); });
    if (!isSide) {
      if (isOwn) walls.push_back(h);
      continue;
    }
    Point normal = pointAt(cells.faceNormal, f);
    for (double& x : normal) x = h % 2 == 0 ? x : -x;
    sides_.push_back({uint32_t(b), f, share.parts.cellComponent[cell], isOwn, normal});
  }
  for (detail::Box* of : {&box, &wallBox}) uniteBoxes(share, *of);
  if (isEmpty(box) || isEmpty(wallBox)) return;
  placeBlocks(box, wallBox);
  placeDipoles(walls);
}

/// From a block's own size on, its dipoles and the one in their middle hardly differ: it is half as large as the distance to the sides.
void FarField::placeBlocks(const detail::Box& box, const detail::Box& wallBox) {
  double distance = HUGE_VAL;
  for (size_t d = 0; d < 3; ++d) {
    const double length = wallBox.high[d] - wallBox.low[d];
    size_ = std::max(size_, length);
    middle_[d] = wallBox.low[d] + length / 2;
    distance = std::min({distance, wallBox.low[d] - box.low[d], box.high[d] - wallBox.high[d]});
  }
  low_ = wallBox.low;
  edge_ = std::max(distance / 2, size_ / double(kMaxBlocks));
  for (size_t d = 0; d < 3; ++d) blockCounts_[d] = 1 + rowOf(wallBox.high[d], low_[d], edge_, kMaxBlocks);
}

/// The one that its centre is in, or is nearest to.
size_t FarField::blockOf(size_t cell) const {
  size_t block = 0;
  for (size_t d = 0; d < 3; ++d) block = block * blockCounts_[d] + rowOf(cells_.cellCentre[3 * cell + d], low_[d], edge_, blockCounts_[d]);
  return block;
}

void FarField::placeDipoles(const std::vector<uint32_t>& walls) {
  const size_t blocks = blockCounts_[0] * blockCounts_[1] * blockCounts_[2];
  std::vector<double> area(blocks), sums(3 * blocks);
  for (const uint32_t h : walls) {
    const size_t block = blockOf(size_t(cells_.faceCells[h]));
    area[block] += cells_.faceArea[h / 2];
    for (size_t d = 0; d < 3; ++d) sums[3 * block + d] += cells_.faceArea[h / 2] * (cells_.faceCentroid[3 * (h / 2) + d] - middle_[d]);
  }
  overAll(share_.sum, area);
  overAll(share_.sum, sums);
  std::vector<int32_t> dipole(blocks, -1);
  for (size_t block = 0; block < blocks; ++block) {
    if (!(area[block] > 0)) continue;
    dipole[block] = int32_t(centres_.size() / 3);
    for (size_t d = 0; d < 3; ++d) centres_.push_back(middle_[d] + sums[3 * block + d] / area[block]);
  }
  for (size_t c = 0; c < cells_.cellCount(); ++c) cellDipole_.push_back(dipole[blockOf(c)]);
}

std::vector<double> FarField::sideWeights() const {
  std::vector<double> weights(boundarySize_);
  double own = 0;
  for (const Side& side : sides_) own += side.isOwn ? cells_.faceArea[side.face] : 0;
  const double all = sum(own);
  for (const Side& side : sides_) weights[side.at] = side.isOwn && all > 0 ? cells_.faceArea[side.face] / all : 0;
  return weights;
}

double FarField::sum(double number) const {
  std::vector<double> one{number};
  overAll(share_.sum, one);
  return one[0];
}

/// 3 per dipole, over 4 pi and the cube of `size_`. The integral of phi * normal over the walls of a block is that of phi * normal - x *
/// (dphi / dn) over its other faces, of either normal: there phi is known better than in cells as thin as cut ones are.
std::vector<double> FarField::moments(const Flow& flow) const {
  std::vector<double> sums(centres_.size());
  for (size_t f = 0; f < cells_.faceCount(); ++f) {
    if (cells_.faceTag[f] >= FaceTag::inner && !isInner(cells_, f)) continue;
    const size_t counts = 2 * f + (cells_.faceCells[2 * f] < 0 ? 1 : 0);  // a face counts in the process of its first cell
    if (cells_.faceCells[counts] < 0 || !share_.owns(size_t(cells_.faceCells[counts]))) continue;
    const Point normal = pointAt(cells_.faceNormal, f), at = pointAt(cells_.faceCentroid, f);
    std::array<int32_t, 2> dipoles = {-1, -1};
    double phi = 0, cellCount = 0;
    for (size_t side = 0; side < 2; ++side) {
      const int32_t c = cells_.faceCells[2 * f + side];
      if (c < 0) continue;
      dipoles[side] = cellDipole_[size_t(c)];
      phi +=
          flow.phi[size_t(c)] / size_ + flow.faceVelocity[f] * dot(stepBetween(pointAt(cells_.cellCentre, size_t(c)), at, size_), normal);
      ++cellCount;
    }
    if (dipoles[0] == dipoles[1]) continue;
    const Point x = stepBetween(middle_, at, size_);
    const double share = cells_.faceArea[f] / size_ / size_ / (4 * std::numbers::pi);
    for (size_t d = 0; d < 3; ++d) {
      const double part = share * (phi / cellCount * normal[d] - x[d] * flow.faceVelocity[f]);
      if (dipoles[0] >= 0) sums[3 * size_t(dipoles[0]) + d] += part;
      if (dipoles[1] >= 0) sums[3 * size_t(dipoles[1]) + d] -= part;
    }
  }
  overAll(share_.sum, sums);
  return sums;
}

/// Points of equal weight: Gauss' on the rectangles of octree cells, which may be large, the centroid of others.
std::vector<Point> FarField::quadratureOn(size_t face) const {
  Point at = pointAt(cells_.faceCentroid, face);
  if (face < cells_.cutFaces) return {at};
  const FaceBox box = faceBox(cells_, face);
  const size_t normal = cells_.faceNormal[3 * face] != 0 ? 0 : cells_.faceNormal[3 * face + 1] != 0 ? 1 : 2;
  const size_t across[] = {(normal + 1) % 3, (normal + 2) % 3};
  const double shares[] = {(1 - 1 / std::sqrt(3.0)) / 2, (1 + 1 / std::sqrt(3.0)) / 2};
  std::vector<Point> points;
  for (size_t i = 0; i < 4; ++i) {
    for (size_t j = 0; j < 2; ++j) {
      const size_t d = across[j];
      at[d] = box.low[d] + shares[i >> j & 1] * (box.high[d] - box.low[d]);
    }
    points.push_back(at);
  }
  return points;
}

std::vector<double> FarField::outflowOfDipoles(const Flow& flow) const {
  const std::vector<double> moment = moments(flow);
  const double nearest = edge_ / size_ / 2;  // what is nearer is inside the block, where one dipole would flow far too fast
  std::vector<double> outflow(boundarySize_);
  for (const Side& side : sides_) {
    const std::vector<Point> points = quadratureOn(side.face);
    for (size_t i = 0; i < points.size() * (centres_.size() / 3); ++i) {
      const size_t k = i / points.size();
      const Point step = stepBetween(pointAt(centres_, k), points[i % points.size()], size_), m = pointAt(moment, k);
      const double r = std::max(measuring::length(step), nearest);
      const double flow = (dot(m, side.normal) - 3 * (dot(m, step) / r) * (dot(step, side.normal) / r)) / (r * r * r);
      outflow[side.at] += flow / double(points.size());
    }
  }
  takeExcess(outflow);
  return outflow;
}

/// Evenly by area: sums over faces are not quite the integrals, which are 0.
void FarField::takeExcess(std::vector<double>& outflow) const {
  constexpr int kPasses = 2;  // the second takes what the first has rounded
  for (int pass = 0; pass < kPasses; ++pass) {
    std::vector<double> excess(share_.parts.count), area(excess.size());
    for (const Side& side : sides_) {
      if (!side.isOwn) continue;
      excess[side.part] += cells_.faceArea[side.face] * outflow[side.at];
      area[side.part] += cells_.faceArea[side.face];
    }
    overAll(share_.sum, excess);
    overAll(share_.sum, area);
    for (const Side& side : sides_) outflow[side.at] -= area[side.part] > 0 ? excess[side.part] / area[side.part] : 0;
  }
}

FarFieldPasses::FarFieldPasses(const FarField& farField, std::vector<double> ofWind)
    : farField_(farField),
      ofWind_(std::move(ofWind)),
      ofDipoles_(ofWind_.size()),
      secants_(farField.sideWeights(), [&farField](double number) { return farField.sum(number); }) {}

FarFieldPasses::Next FarFieldPasses::add(const Flow& flow, std::vector<double>& outflow) {
  const double missing = secants_.add(ofDipoles_, farField_.outflowOfDipoles(flow));
  if (pass_ > 0 && missing <= kEnough) return Next::done;
  if (++pass_ == kMaxPasses) return Next::limit;
  ofDipoles_ = secants_.next();
  for (size_t b = 0; b < ofWind_.size(); ++b) outflow[b] = ofWind_[b] + ofDipoles_[b];
  return Next::pass;
}

}  // namespace mandoline::physics

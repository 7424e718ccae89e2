#include "physics/derivatives.h"

#include <algorithm>

#include "base/sort.h"
#include "physics/face_box.h"

namespace mandoline::physics {
namespace {

/// What a cell's polynomial says of a face: how much phi differs between two points, and its derivative along the normal.
struct Said {
  double difference = 0, derivative = 0;
};

struct Places {
  Point from, to, centroid, normal;
};

Said saidOf(const CellComplex& cells, const CellFits& fits, size_t cell, const Places& at) {
  Point middle, step;
  for (size_t d = 0; d < 3; ++d) middle[d] = (at.from[d] + at.to[d]) / 2, step[d] = at.to[d] - at.from[d];
  return {dot(fits.gradientAt(cells, cell, middle), step), dot(fits.gradientAt(cells, cell, at.centroid), at.normal)};
}

/// How much more than at its centroid a function is in the mean on a rectangle, per second derivative along each axis.
Point spreadOf(const CellComplex& cells, size_t f) {
  const FaceBox box = faceBox(cells, f);
  Point spread;
  for (size_t d = 0; d < 3; ++d) spread[d] = (box.high[d] - box.low[d]) * (box.high[d] - box.low[d]) / 24;
  return spread;
}

}  // namespace

Differentiator::Differentiator(const CellComplex& cells, const DualEdges& dual, const PoissonProblem& problem,
                               const std::vector<BoundaryTerm>& terms)
    : cells_(cells), dual_(dual), problem_(problem), terms_(terms), coefficients_(cellCoefficients(cells, dual, problem.boundary)) {
  for (size_t e = 0; e < dual.edges.size(); ++e) {
    if (isCorrected(e)) edges_.push_back(uint32_t(e));
  }
}

CellFitter Differentiator::fitter(detail::Monitor& monitor) const {
  std::vector<uint32_t> fitted;
  for (const uint32_t e : edges_) {
    fitted.push_back(dual_.edges[e].cell);
    for (const uint32_t f : dual_.faces[e]) fitted.push_back(otherCell(cells_, dual_.edges[e], f));
  }
  for (size_t b = 0; b < terms_.size(); ++b) {
    if (isCorrectedOnBoundary(b)) fitted.push_back(uint32_t(cells_.faceCells[problem_.boundary.halfFaces[b]]));
  }
  detail::sortUnique(fitted);
  return {cells_, fitData(cells_, dual_, problem_, coefficients_), std::move(fitted), monitor};
}

/// Octree cells of one size, larger than grid cells.
bool Differentiator::isBetweenEqual(size_t edge) const {
  const DualEdge& e = dual_.edges[edge];
  const uint32_t other = otherCell(cells_, e, dual_.faces[edge][0]);
  return std::min(e.cell, other) >= cells_.cutCells && cells_.cellLevel[e.cell] > 0 && cells_.cellLevel[other] == cells_.cellLevel[e.cell];
}

/// Between grid cells plain derivatives are of second order already, and so they are between larger cells of one size; but of these each
/// makes a larger error.
bool Differentiator::isCorrected(size_t edge) const {
  const DualEdge& e = dual_.edges[edge];
  bool isCut = e.cell < cells_.cutCells, isLarger = false, areOthersCut = false;
  if (jumps(e.cell)) return false;
  for (const uint32_t f : dual_.faces[edge]) {
    const uint32_t other = otherCell(cells_, e, f);
    if (jumps(other)) return false;
    isLarger |= cells_.cellLevel[e.cell] > cells_.cellLevel[other];
    areOthersCut |= other < cells_.cutCells;
  }
  return isLarger ? !areOthersCut : isCut || areOthersCut || isBetweenEqual(edge);
}

bool Differentiator::isCorrectedOnBoundary(size_t b) const {
  return terms_[b].perPhi > 0 && !jumps(size_t(cells_.faceCells[problem_.boundary.halfFaces[b]]));
}

double Differentiator::flowOf(size_t derivative) const {
  return derivative < cells_.faceCount() ? dual_.flowOf(cells_, derivative) : terms_[derivative - cells_.faceCount()].flow;
}

size_t Differentiator::cellOf(size_t derivative) const {
  return size_t(cells_.faceCells[derivative < cells_.faceCount() ? 2 * derivative : halfFaceOf(derivative)]);
}

double Differentiator::product(const std::vector<double>& a, const std::vector<double>& b) const {
  double sum = 0;
  for (size_t i = 0; i < a.size(); ++i) sum += a[i] * b[i] * flowOf(i);
  return sum;
}

void Differentiator::addFlows(const std::vector<double>& derivatives, std::vector<double>& cellValues) const {
  for (size_t i = 0; i < derivatives.size(); ++i) {
    if (derivatives[i] == 0) continue;
    const double flow = derivatives[i] * flowOf(i);
    cellValues[cellOf(i)] += flow;
    if (i < cells_.faceCount()) cellValues[size_t(cells_.faceCells[2 * i + 1])] -= flow;
  }
}

std::vector<double> Differentiator::plain(const std::vector<double>& phi) const {
  std::vector<double> result(size());
  for (size_t e = 0; e < dual_.edges.size(); ++e) {
    const double derivative = dual_.edges[e].sign * differenceAt(cells_, dual_, e, phi) / dual_.edges[e].distance;
    for (const uint32_t f : dual_.faces[e]) result[f] = derivative;
  }
  for (size_t b = 0; b < terms_.size(); ++b) {
    const size_t i = cells_.faceCount() + b;
    const auto& [perPhi, perValue, distance, all] = terms_[b];
    const double flow = perValue * problem_.boundary.value[b] - (perPhi > 0 ? perPhi * phi[cellOf(i)] : 0);
    result[i] = all > 0 ? flow / all : 0;
  }
  return result;
}

/// What the Laplacian of phi plus slope . gradient is, per cell.
std::vector<double> Differentiator::sourceOf(const std::vector<double>& phi, const std::vector<double>& cellSize) const {
  std::vector<double> source = problem_.source;
  if (!problem_.mass.empty()) {
    source.resize(phi.size());
    for (size_t c = 0; c < phi.size(); ++c) source[c] += problem_.mass[c] * phi[c];
  }
  for (size_t c = 0; c < source.size() && !coefficients_.value.empty(); ++c) source[c] /= coefficients_.value[c];
  // What mass makes of an error of phi must not make a larger one.
  for (size_t c = 0; c < problem_.mass.size(); ++c) {
    const double k = coefficients_.value.empty() ? 1 : coefficients_.value[c];
    source[c] /= 1 + problem_.mass[c] / k * cellSize[c] * cellSize[c];
  }
  return source;
}

/// Of a dual edge between octree cells of one size: what third derivatives add, to the mean on the face. These are how second ones change
/// across it.
double Differentiator::addedByThirds(size_t e, const CellFits& fits) const {
  const DualEdge& edge = dual_.edges[e];
  const size_t f = dual_.faces[e][0], other = otherCell(cells_, edge, f);
  const Point spread = spreadOf(cells_, f);
  double sum = 0;
  for (size_t d = 0; d < 3; ++d) {
    double factor = spread[d];
    if (cells_.faceNormal[3 * f + d] != 0) {
      const double at = cells_.faceCentroid[3 * f + d], a = cells_.cellCentre[3 * edge.cell + d] - at,
                   b = cells_.cellCentre[3 * other + d] - at;
      factor = (a + b) * (a + b) / 8 - (a - b) * (a - b) / 24;  // the first part is 0 where the face is half-way
    }
    sum += factor * (fits.second[6 * other + d] - fits.second[6 * edge.cell + d]) / edge.distance;
  }
  return sum;
}

std::vector<double> Differentiator::corrections(const CellFitter& fitter, const std::vector<double>& phi, detail::Monitor& monitor) const {
  const std::vector<double>& points = pointsOf(cells_, problem_.dualPoints);
  const CellFits fits = fitter.fit(fitValues(cells_, dual_, problem_, fitter.data(), phi), sourceOf(phi, fitter.data().cellSize), monitor);
  std::vector<double> result(size());
  for (const uint32_t e : edges_) {
    const DualEdge& edge = dual_.edges[e];
    const double plain = differenceAt(cells_, dual_, e, phi), added = isBetweenEqual(e) ? addedByThirds(e, fits) : 0;
    for (const uint32_t f : dual_.faces[e]) {
      const uint32_t other = otherCell(cells_, edge, f);
      Places at{pointAt(points, edge.cell), pointAt(points, other), pointAt(cells_.faceCentroid, f), pointAt(cells_.faceNormal, f)};
      for (double& x : at.normal) x *= edge.sign;
      const Said a = saidOf(cells_, fits, edge.cell, at), b = saidOf(cells_, fits, other, at);
      const double left = phi[other] - phi[edge.cell] - plain - (a.difference + b.difference) / 2;
      result[f] = edge.sign * ((a.derivative + b.derivative) / 2 + left / edge.distance + added);
    }
  }
  for (size_t b = 0; b < terms_.size(); ++b) {
    if (!isCorrectedOnBoundary(b)) continue;
    const size_t i = cells_.faceCount() + b, cell = cellOf(i);
    const uint32_t h = halfFaceOf(i), f = h / 2;
    Places at{pointAt(points, cell), pointAt(cells_.faceCentroid, f), pointAt(cells_.faceCentroid, f), pointAt(cells_.faceNormal, f)};
    for (double& x : at.normal) x *= h % 2 == 0 ? 1 : -1;
    const Said said = saidOf(cells_, fits, cell, at);
    result[i] = (said.derivative * terms_[b].distance - said.difference) * (terms_[b].perPhi / flowOf(i));
  }
  return result;
}

}  // namespace mandoline::physics

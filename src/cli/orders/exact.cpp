#include "cli/orders/exact.h"

#include <algorithm>
#include <cmath>

namespace mandoline::orders {
namespace {

Point at(const std::vector<double>& vectors, size_t i) { return {vectors[3 * i], vectors[3 * i + 1], vectors[3 * i + 2]}; }
double dot(const Point& a, const Point& b) { return a[0] * b[0] + a[1] * b[1] + a[2] * b[2]; }

constexpr Point kField = {0.75, -1.25, 0.5};
double nothing(const Point&) { return 0; }

double waves(const Point& p) { return std::sin(p[0]) * std::cos(p[1]) * std::exp(p[2] / 2); }
Point wavesGradient(const Point& p) {
  const double e = std::exp(p[2] / 2);
  return {std::cos(p[0]) * std::cos(p[1]) * e, -std::sin(p[0]) * std::sin(p[1]) * e, waves(p) / 2};
}

// A wind of speed 1 along x about the unit sphere.
double sphereFlow(const Point& p) { return p[0] * (1 + std::pow(dot(p, p), -1.5) / 2); }
Point sphereFlowGradient(const Point& p) {
  const double square = dot(p, p), cube = std::pow(square, -1.5);
  Point u;
  for (size_t d = 0; d < 3; ++d) u[d] = -1.5 * p[0] * p[d] / square * cube;
  u[0] += 1 + cube / 2;
  return u;
}

}  // namespace

const Exact kLinear = {
    [](const Point& p) { return dot(kField, p); }, [](const Point&) { return kField; }, nothing, false, false, Condition::neumann};
const Exact kManufactured = {waves, wavesGradient, [](const Point& p) { return -1.75 * waves(p); }, false, true, Condition::neumann};
const Exact kHeld = {waves, wavesGradient, kManufactured.laplacian, false, true, Condition::dirichlet};
const Exact kRobin = {waves, wavesGradient, kManufactured.laplacian, false, true, Condition::robin};
const Exact kSphereFlow = {sphereFlow, sphereFlowGradient, nothing, true, false, Condition::neumann};

namespace {

/// The mean in a box, by Gauss' quadrature of fourth order.
template <class F>
double meanInBox(const Point& low, const Point& high, const F& f) {
  const double near = (1 - 1 / std::sqrt(3.0)) / 2;
  double sum = 0;
  for (int corner = 0; corner < 8; ++corner) {
    Point p;
    for (size_t d = 0; d < 3; ++d) p[d] = low[d] + (corner >> d & 1 ? 1 - near : near) * (high[d] - low[d]);
    sum += f(p) / 8;
  }
  return sum;
}

/// Of faces that are rectangles along the axes.
template <class F>
double meanOnFace(const CellComplex& cells, size_t face, const F& f) {
  Point low = at(cells.faceCentroid, face), high = low;
  for (const uint32_t v : cells.loops(face)[0]) {
    for (size_t d = 0; d < 3; ++d) {
      low[d] = std::min(low[d], cells.positions[3 * size_t(v) + d]);
      high[d] = std::max(high[d], cells.positions[3 * size_t(v) + d]);
    }
  }
  return meanInBox(low, high, f);
}

/// In cut-cells f at the centroid.
template <class F>
double meanInCell(const CellComplex& cells, size_t cell, const F& f) {
  Point low = at(cells.cellCentroid, cell), high = low;
  for (const uint32_t h : cells.halfFaces(cell)) {
    for (size_t d = 0; d < 3 && cell >= cells.cutCells; ++d) {
      low[d] = std::min(low[d], cells.faceCentroid[3 * size_t(h / 2) + d]);
      high[d] = std::max(high[d], cells.faceCentroid[3 * size_t(h / 2) + d]);
    }
  }
  return meanInBox(low, high, f);
}

}  // namespace

PoissonProblem problemOf(const CellComplex& cells, const Exact& exact, DualPoints points) {
  constexpr double kCoefficient = 2;
  PoissonProblem problem;
  problem.dualPoints = points;
  Boundary& boundary = problem.boundary;
  boundary = boundaryOf(cells);
  const std::vector<double> normals = outwardNormals(boundary, cells);
  for (size_t b = 0; b < boundary.halfFaces.size(); ++b) {
    const size_t f = boundary.halfFaces[b] / 2;
    const Point centroid = at(cells.faceCentroid, f);
    const bool onSurface = cells.faceTag[f] == FaceTag::surface;
    if (onSurface && exact.surfaceStops) continue;
    const Condition onSides = exact.sidesHeld ? Condition::dirichlet : Condition::neumann;
    const Condition condition = boundary.condition[b] = onSurface ? exact.surface : onSides;
    const Point normal = at(normals, b);
    const auto derivativeAt = [&](const Point& p) { return dot(exact.gradient(p), normal); };
    const bool isWhole = size_t(cells.faceCells[boundary.halfFaces[b]]) >= cells.cutCells;
    const double phi = exact.phi(centroid);
    const double derivative = isWhole ? meanOnFace(cells, f, derivativeAt) : derivativeAt(centroid);
    if (condition == Condition::robin) boundary.coefficient[b] = kCoefficient;
    boundary.value[b] = condition == Condition::dirichlet ? phi : derivative + boundary.coefficient[b] * phi;
  }
  for (size_t c = 0; c < cells.cellCount(); ++c) problem.source.push_back(meanInCell(cells, c, exact.laplacian));
  return problem;
}

Errors errorsOf(const CellComplex& cells, const Exact& exact, DualPoints points, const std::vector<double>& phi) {
  const std::vector<double>& at3 = points == DualPoints::centres ? cells.cellCentre : cells.cellCentroid;
  const CellComponents components = cellComponents(cells);
  std::vector<double> error(phi), sum(components.count), volume(components.count);
  for (size_t c = 0; c < phi.size(); ++c) {
    error[c] -= exact.phi(at(at3, c));
    sum[components.cellComponent[c]] += error[c] * cells.cellVolume[c];
    volume[components.cellComponent[c]] += cells.cellVolume[c];
  }
  Errors errors;
  double all = 0;
  for (size_t c = 0; c < phi.size(); ++c) {
    const uint32_t r = components.cellComponent[c];
    const double e =
        std::fabs(error[c] - (exact.sidesHeld || exact.surface != Condition::neumann || !(volume[r] > 0) ? 0 : sum[r] / volume[r]));
    errors.mean += e * cells.cellVolume[c], all += cells.cellVolume[c];
    errors.largest = std::max(errors.largest, e);
  }
  errors.mean /= all;
  return errors;
}

namespace {

/// Means by area.
class FaceErrors {
 public:
  FaceErrors(const CellComplex& cells, const Exact& exact) : cells_(cells), exact_(exact) {}

  void add(size_t face, const Point& normal, double derivative) {
    const double area = cells_.faceArea[face];
    if (!(area > 0)) return;
    const auto derivativeAt = [&](const Point& p) { return dot(exact_.gradient(p), normal); };
    const double mean = face < cells_.cutFaces ? derivativeAt(at(cells_.faceCentroid, face)) : meanOnFace(cells_, face, derivativeAt);
    const double error = std::fabs(derivative - mean);
    sum_ += error * area, area_ += area;
    largest_ = std::max(largest_, error);
  }
  Errors get() const { return {sum_ / area_, largest_}; }

 private:
  const CellComplex& cells_;
  const Exact& exact_;
  double sum_ = 0, area_ = 0, largest_ = 0;
};

}  // namespace

Errors faceErrorsOf(const CellComplex& cells, const Exact& exact, const Solution& solution) {
  FaceErrors errors(cells, exact);
  for (size_t f = 0; f < cells.faceCount(); ++f) {
    if (cells.faceTag[f] == FaceTag::inner && std::min(cells.faceCells[2 * f], cells.faceCells[2 * f + 1]) >= 0)
      errors.add(f, at(cells.faceNormal, f), solution.faceDerivative[f]);
  }
  return errors.get();
}

Errors surfaceErrorsOf(const CellComplex& cells, const Exact& exact, const Boundary& boundary, const Solution& solution) {
  FaceErrors errors(cells, exact);
  const std::vector<double> normals = outwardNormals(boundary, cells);
  for (size_t b = 0; b < boundary.halfFaces.size(); ++b) {
    const size_t f = boundary.halfFaces[b] / 2;
    if (cells.faceTag[f] == FaceTag::surface) errors.add(f, at(normals, b), solution.boundaryDerivative[b]);
  }
  return errors.get();
}

}  // namespace mandoline::orders

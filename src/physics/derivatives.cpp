#include "physics/derivatives.h"

#include <algorithm>

#include "base/large_array.h"
#include "base/parallel.h"
#include "base/sort.h"
#include "physics/face_box.h"
#include "physics/node_loops.h"

namespace mandoline::physics {
namespace {

/// What a cell's polynomial says of a face: how much phi differs between two points, and its derivative along the normal.
struct Said {
  double difference = 0, derivative = 0;
};

struct Places {
  Point from, to, centroid, normal;
  Point spread{};  ///< of the face, as of spreadOf()
};

Point differenceOf(const Point& a, const Point& b) { return {a[0] - b[0], a[1] - b[1], a[2] - b[2]}; }

Said saidOf(const CellComplex& cells, const CellFits& fits, size_t cell, const Places& at) {
  Point middle, step;
  for (size_t d = 0; d < 3; ++d) middle[d] = (at.from[d] + at.to[d]) / 2, step[d] = at.to[d] - at.from[d];
  Said said{dot(fits.gradientAt(cells, cell, middle), step), dot(fits.gradientAt(cells, cell, at.centroid), at.normal)};
  if (const Thirds* thirds = fits.thirdsOf(cell)) {
    const Point centroid = pointAt(cells.cellCentroid, cell), toMiddle = differenceOf(middle, centroid),
                toFace = differenceOf(at.centroid, centroid);
    const Symmetric along = sumOver(*thirds, step), across = sumOver(*thirds, at.normal);
    said.difference += squareOf(along, toMiddle) / 2 + squareOf(along, step) / 24;
    said.derivative += squareOf(across, toFace) / 2;
    for (size_t d = 0; d < 3; ++d) said.derivative += at.spread[d] * across[d];
  }
  return said;
}

/// How much of the difference of phi that the polynomials leave counts along the normal. The smallest gradient that makes up for it lies
/// along the line between the cells, so this is the square of the cosine between line and normal; but no less than where grid cells touch
/// at a corner. Only between merged cells of similar size: where others are slivers, plain derivatives keep them in place.
double shareOfNormal(const CellComplex& cells, size_t a, size_t b, const Places& at) {
  constexpr double kLeast = 1.0 / 3, kStraight = 0.99, kSliver = 0.1;
  const auto [smaller, larger] = std::minmax(cells.cellVolume[a], cells.cellVolume[b]);
  if (cells.cellMemberOffsets.empty() || !(smaller >= kSliver * larger)) return 1;
  const Point step = differenceOf(at.to, at.from);
  const double along = dot(step, at.normal), square = dot(step, step), share = square > 0 ? along * along / square : 1;
  return share < kStraight ? std::max(share, kLeast) : 1;
}

}  // namespace

Differentiator::Differentiator(const FitSource& source, const std::vector<BoundaryTerm>& terms, unsigned threads)
    : cells_(source.cells),
      dual_(source.dual),
      edgesOfCells_(source.edgesOfCells),
      problem_(source.problem),
      terms_(terms),
      coefficients_(cellCoefficients(cells_, dual_, problem_.boundary)) {
  struct FaceOfEdge {
    uint32_t face, edge;
  };
  std::vector<FaceOfEdge> all;
  detail::Monitor monitor(threads);
  const auto parts = detail::forChunks<std::vector<uint32_t>>(dual_.edges.size(), monitor, [&](auto& edges, size_t begin, size_t end) {
    for (size_t e = begin; e < end; ++e) {
      if (isCorrected(e)) edges.push_back(uint32_t(e));
    }
  });
  for (const std::vector<uint32_t>& part : parts) {
    for (const uint32_t e : part) {
      for (const uint32_t f : dual_.faces[e]) all.push_back({f, e});
    }
  }
  detail::sortItems(all, [](const FaceOfEdge& a, const FaceOfEdge& b) { return a.face < b.face; });
  for (const auto& [face, edge] : all) corrected_.push_back(face), edges_.push_back(edge);
  for (size_t b = 0; b < terms_.size(); ++b) {
    if (isCorrectedOnBoundary(b)) corrected_.push_back(uint32_t(cells_.faceCount() + b));
  }
}

CellFitter Differentiator::fitter(detail::Monitor& monitor) const {
  std::vector<char> isFitted(cells_.cellCount());
  for (size_t i = 0; i < corrected_.size(); ++i) {
    isFitted[cellOf(corrected_[i])] = 1;
    if (i < edges_.size()) isFitted[size_t(cells_.faceCells[2 * corrected_[i] + 1])] = 1;
  }
  std::vector<uint32_t> fitted;
  for (uint32_t c = 0; c < isFitted.size(); ++c) {
    if (isFitted[c]) fitted.push_back(c);
  }
  const FitSource source{cells_, dual_, edgesOfCells_, problem_};
  std::vector<uint32_t> cubic;
  if (coefficients_.value.empty()) cubic = cubicCells(source, fitted, false);
  return {source, fitData(source, &fitted, coefficients_, monitor.threads()), fitted, cubic, monitor};
}

/// Octree cells of one size, larger than grid cells.
bool Differentiator::isBetweenEqual(size_t edge) const {
  const DualEdge& e = dual_.edges[edge];
  const uint32_t other = otherCell(cells_, e, dual_.faces[edge][0]);
  return std::min(e.cell, other) >= cells_.cutCells && cells_.cellLevel[e.cell] > 0 && cells_.cellLevel[other] == cells_.cellLevel[e.cell];
}

/// Between grid cells plain derivatives are of second order already, and so they are between larger cells of one size; but of these each
/// makes a larger error. Beside a larger cell, corrections of cut-cells that are not merged need not converge, nor those of slivers.
bool Differentiator::isCorrected(size_t edge) const {
  constexpr double kSliver = 0.01;  // of the larger cell's volume; merged cells have more
  const DualEdge& e = dual_.edges[edge];
  const bool isMerged = !cells_.cellMemberOffsets.empty();
  bool isCut = e.cell < cells_.cutCells, isLarger = false, areOthersCut = false, areSlivers = false;
  if (jumps(e.cell)) return false;
  for (const uint32_t f : dual_.faces[edge]) {
    const uint32_t other = otherCell(cells_, e, f);
    if (jumps(other)) return false;
    isLarger |= cells_.cellLevel[e.cell] > cells_.cellLevel[other];
    areOthersCut |= other < cells_.cutCells;
    const bool isWide = isMerged && cells_.cellVolume[other] >= kSliver * cells_.cellVolume[e.cell];
    areSlivers |= other < cells_.cutCells && !isWide;
  }
  return isLarger ? !areSlivers : isCut || areOthersCut || isBetweenEqual(edge);
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
  for (size_t i = 0; i < a.size(); ++i) sum += a[i] * b[i] * flowOf(corrected_[i]);
  return sum;
}

void Differentiator::addFlows(const std::vector<double>& corrections, std::vector<double>& cellValues) const {
  for (size_t i = 0; i < corrections.size(); ++i) {
    const double flow = corrections[i] * flowOf(corrected_[i]);
    cellValues[cellOf(corrected_[i])] += flow;
    if (i < edges_.size()) cellValues[size_t(cells_.faceCells[2 * corrected_[i] + 1])] -= flow;
  }
}

/// Along the normals of the edge's faces.
double Differentiator::plainAt(size_t e, const std::vector<double>& phi) const {
  return dual_.edges[e].sign * differenceAt(cells_, dual_, e, phi) / dual_.edges[e].distance;
}

double Differentiator::plainOnBoundary(size_t b, const std::vector<double>& phi) const {
  const auto& [perPhi, perValue, distance, all] = terms_[b];
  const double flow = perValue * problem_.boundary.value[b] - (perPhi > 0 ? perPhi * phi[cellOf(cells_.faceCount() + b)] : 0);
  return all > 0 ? flow / all : 0;
}

std::vector<double> Differentiator::plain(const std::vector<double>& phi, unsigned threads) const {
  std::vector<double> result;
  detail::makeLargeOnThreads(result, cells_.faceCount() + terms_.size(), threads);
  forBlocks(dual_.edges.size(), threads, [&](size_t begin, size_t end) {
    for (size_t e = begin; e < end; ++e) {
      const double derivative = plainAt(e, phi);
      for (const uint32_t f : dual_.faces[e]) result[f] = derivative;
    }
  });
  for (size_t b = 0; b < terms_.size(); ++b) result[cells_.faceCount() + b] = plainOnBoundary(b, phi);
  return result;
}

double Differentiator::squareOfPlain(const std::vector<double>& phi, unsigned threads) const {
  double onBoundary = 0;
  for (size_t b = 0; b < terms_.size(); ++b) onBoundary += plainOnBoundary(b, phi) * plainOnBoundary(b, phi) * terms_[b].flow;
  return onBoundary + sumOfBlocks(dual_.edges.size(), threads, [&](size_t begin, size_t end) {
           double sum = 0;
           for (size_t e = begin; e < end; ++e) sum += plainAt(e, phi) * plainAt(e, phi) * dual_.edges[e].flow;
           return sum;
         });
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

double Differentiator::correctionOf(size_t e, size_t f, const CellFits& fits, const std::vector<double>& phi) const {
  const std::vector<double>& points = pointsOf(cells_, problem_.dualPoints);
  const DualEdge& edge = dual_.edges[e];
  const double plain = differenceAt(cells_, dual_, e, phi);
  const uint32_t other = otherCell(cells_, edge, f);
  const bool areCubic = fits.thirdsOf(edge.cell) && fits.thirdsOf(other);
  const double added = isBetweenEqual(e) && !areCubic ? addedByThirds(e, fits) : 0;
  Places at{pointAt(points, edge.cell), pointAt(points, other), pointAt(cells_.faceCentroid, f), pointAt(cells_.faceNormal, f)};
  for (double& x : at.normal) x *= edge.sign;
  if (areCubic) at.spread = spreadOf(cells_, f);
  const Said a = saidOf(cells_, fits, edge.cell, at), b = saidOf(cells_, fits, other, at);
  const double left = phi[other] - phi[edge.cell] - plain - (a.difference + b.difference) / 2;
  const double share = dual_.faces[e].size() == 1 ? shareOfNormal(cells_, edge.cell, other, at) : 1;
  return edge.sign * ((a.derivative + b.derivative) / 2 + (share * left - (1 - share) * plain) / edge.distance + added);
}

double Differentiator::correctionOnBoundary(size_t b, const CellFits& fits) const {
  const size_t i = cells_.faceCount() + b, cell = cellOf(i);
  const uint32_t h = halfFaceOf(i), f = h / 2;
  Places at{pointAt(pointsOf(cells_, problem_.dualPoints), cell), pointAt(cells_.faceCentroid, f), pointAt(cells_.faceCentroid, f),
            pointAt(cells_.faceNormal, f)};
  for (double& x : at.normal) x *= h % 2 == 0 ? 1 : -1;
  if (fits.thirdsOf(cell)) at.spread = spreadOf(cells_, f);
  const Said said = saidOf(cells_, fits, cell, at);
  return (said.derivative * terms_[b].distance - said.difference) * (terms_[b].perPhi / flowOf(i));
}

std::vector<double> Differentiator::corrections(CellFitter& fitter, const std::vector<double>& phi, detail::Monitor& monitor) const {
  const std::vector<double> values = fitValues({cells_, dual_, edgesOfCells_, problem_}, fitter.data(), phi, monitor.threads());
  const CellFits& fits = fitter.fit(values, sourceOf(phi, fitter.data().cellSize), monitor);
  std::vector<double> result(corrected_.size());
  forBlocks(result.size(), monitor.threads(), [&](size_t begin, size_t end) {
    for (size_t i = begin; i < end; ++i) {
      result[i] = i < edges_.size() ? correctionOf(edges_[i], corrected_[i], fits, phi)
                                    : correctionOnBoundary(corrected_[i] - cells_.faceCount(), fits);
    }
  });
  return result;
}

}  // namespace mandoline::physics

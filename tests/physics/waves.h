// A field that is known, inside of a ball and outside of it, and how far solutions are from it.
#pragma once

#include "complexes.h"
#include "mandoline/merge.h"
#include "shapes.h"

/// Its Laplacian is -1.75 times itself.
inline double waves(const double* x) { return std::sin(x[0]) * std::cos(x[1]) * std::exp(x[2] / 2); }
inline std::array<double, 3> wavesGradient(const double* x) {
  const double e = std::exp(x[2] / 2);
  return {std::cos(x[0]) * std::cos(x[1]) * e, -std::sin(x[0]) * std::sin(x[1]) * e, waves(x) / 2};
}

struct Cells {
  bool isCoarsened = false, isMerged = false;
};

inline mandoline::CellComplex ballCells(const Cells& way, int64_t n) {
  using namespace mandoline;
  const Mesh mesh = shapes::icosphere({0.1, 0.05, -0.02}, 0.6, 4);
  const CutResult result = cut(mesh, Grid::box({-1, -1, -1}, {1, 1, 1}, {n, n, n}));
  REQUIRE(result);
  CoarsenOptions options;
  if (!way.isCoarsened) options.maxLevel = 0;
  const CellComplex cells = cellComplex(mesh, result.mesh, coarsen(result.mesh, options));
  return way.isMerged ? mergeSmallCells(result.mesh, cells).cells : cells;
}

/// The largest errors of phi at centroids, and of its derivative on the surface.
inline std::array<double, 2> wavesErrors(const mandoline::CellComplex& cells, const mandoline::PoissonProblem& problem,
                                         const mandoline::Solution& solution) {
  std::array<double, 2> errors{};
  for (size_t c = 0; c < cells.cellCount(); ++c)
    errors[0] = std::max(errors[0], std::fabs(solution.phi[c] - waves(&cells.cellCentroid[3 * c])));
  const std::vector<double> normals = outwardNormals(problem.boundary, cells);
  for (size_t b = 0; b < problem.boundary.halfFaces.size(); ++b) {
    const size_t f = problem.boundary.halfFaces[b] / 2;
    if (cells.faceTag[f] != mandoline::FaceTag::surface) continue;
    const double exact = dot(wavesGradient(&cells.faceCentroid[3 * f]), normals, b);
    errors[1] = std::max(errors[1], std::fabs(solution.boundaryDerivative[b] - exact));
  }
  return errors;
}

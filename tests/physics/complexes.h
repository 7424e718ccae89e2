// Cell complexes for tests, and sparse matrices looked at.
#pragma once

#include <cmath>

#include "catch.h"
#include "mandoline/cell_complex.h"
#include "mandoline/cut.h"
#include "mandoline/poisson.h"

inline mandoline::CellComplex complexOf(const mandoline::Mesh& mesh, const mandoline::Grid& grid, int maxLevel = 0, int fineLayers = 0) {
  const mandoline::CutResult result = mandoline::cut(mesh, grid);
  REQUIRE(result);
  mandoline::CoarsenOptions options;
  options.maxLevel = maxLevel;
  options.fineLayers = fineLayers;
  options.layersPerLevel = 0;
  return mandoline::cellComplex(mesh, result.mesh, mandoline::coarsen(result.mesh, options));
}

inline Eigen::Map<const Eigen::VectorXd> vectorOf(const std::vector<double>& values) {
  return {values.data(), Eigen::Index(values.size())};
}

inline double dot(const std::array<double, 3>& u, const std::vector<double>& vectors, size_t i) {
  return u[0] * vectors[3 * i] + u[1] * vectors[3 * i + 1] + u[2] * vectors[3 * i + 2];
}

/// u . vectors, per vector.
inline std::vector<double> products(const std::array<double, 3>& u, const std::vector<double>& vectors) {
  std::vector<double> result;
  for (size_t i = 0; i < vectors.size() / 3; ++i) result.push_back(dot(u, vectors, i));
  return result;
}

inline double largest(const Eigen::VectorXd& v) { return v.size() == 0 ? 0 : v.cwiseAbs().maxCoeff(); }

/// A copy.
inline mandoline::SparseMatrix eigenOf(const mandoline::CsrMatrix& matrix) { return mandoline::EigenRows(matrix).map(); }

inline bool isZero(const mandoline::SparseMatrix& matrix) {
  for (Eigen::Index i = 0; i < matrix.nonZeros(); ++i) {
    if (matrix.valuePtr()[i] != 0) return false;
  }
  return true;
}

/// The longest side of the cells' box.
inline double sizeOf(const mandoline::CellComplex& cells) {
  double size = 0;
  for (size_t d = 0; d < 3; ++d) {
    double low = HUGE_VAL, high = -HUGE_VAL;
    for (size_t v = 0; v < cells.vertexCount(); ++v) {
      low = std::min(low, cells.positions[3 * v + d]);
      high = std::max(high, cells.positions[3 * v + d]);
    }
    size = std::max(size, high - low);
  }
  return size;
}

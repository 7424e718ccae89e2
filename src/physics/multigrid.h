// A multigrid preconditioner for Poisson systems: each coarser level joins the cells that lie in one block of twice the side and are
// connected inside it, so that no level couples the two sides of a sheet.
#pragma once

#include "base/csr.h"
#include "mandoline/cell_complex.h"
#include "mandoline/csr_matrix.h"

namespace mandoline::physics {

/// Nodes with symmetric positive couplings w: row i of the matrix is diagonal[i] x[i] - sum of w x[j].
struct Level {
  struct Coupling {
    uint32_t node;
    double w;
  };
  detail::Csr<Coupling> couplings;
  std::vector<double> diagonal;  ///< the sum of a node's couplings, `held` and `mass`
  std::vector<double> held;      ///< by conditions on the boundary
  std::vector<double> mass;      ///< times volume
  std::vector<int32_t> corner;   ///< 3 per node: lowest grid cell of its block
  std::vector<double> size;      ///< of its block, in grid cells
  std::vector<double> strength;  ///< the largest diagonal of the nodes that it is made of
  std::vector<uint32_t> coarse;  ///< per node: that of the next level, or none for one without couplings
  bool twice = false;            ///< whether the next level, of at most half as many nodes, is visited twice

  static constexpr uint32_t none = ~uint32_t(0);
  size_t count() const { return diagonal.size(); }
};

class Multigrid {
 public:
  /// `matrix`: that of the system; its positive entries beside the diagonal, of small cells that share the side of a larger one, are left
  /// out. `held` and `mass` are what conditions on the boundary and mass add to the diagonal, per cell. A level where they outweigh
  /// couplings everywhere is the last one if there is mass.
  Multigrid(const CellComplex& cells, const CsrMatrix& matrix, std::vector<double> held, std::vector<double> mass);

  /// x = B r, where B is symmetric, positive definite and near the matrix's inverse. Nodes whose diagonal is zero get 0.
  void apply(const std::vector<double>& r, std::vector<double>& x);

 private:
  struct Vectors {
    std::vector<double> x, r, more;
  };
  void cycle(size_t level, const std::vector<double>& r, std::vector<double>& x);
  void correct(size_t level, const std::vector<double>& r, std::vector<double>& x);

  std::vector<Level> levels_;
  std::vector<Vectors> vectors_;  // per level
};

}  // namespace mandoline::physics

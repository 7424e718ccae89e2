// The levels of a multigrid: what nodes there are, and how they are coupled.
#pragma once

#include "base/csr.h"
#include "mandoline/cell_complex.h"
#include "mandoline/csr_matrix.h"
#include "physics/sweep_order.h"

namespace mandoline::physics {

/// Couplings w of each node i with others j.
struct Couplings {
  std::vector<uint32_t> offsets{0};
  std::vector<uint32_t> nodes;
  std::vector<double> weights;

  /// f(j, w) for those of node i.
  template <class F>
  void forEach(size_t i, const F& f) const {
    for (uint32_t e = offsets[i]; e < offsets[i + 1]; ++e) f(nodes[e], weights[e]);
  }
  /// `sum` plus all w x[j].
  double addTo(double sum, size_t i, const std::vector<double>& x) const {
    forEach(i, [&](uint32_t j, double w) { sum += w * x[j]; });
    return sum;
  }
};

/// Nodes with symmetric positive couplings w: row i of the matrix is diagonal[i] x[i] - sum of w x[j].
struct Level {
  Couplings lower, higher;        ///< with nodes before this one in the order of sweeps, and with those after it
  std::vector<double> diagonal;   ///< the sum of a node's couplings, `held` and `mass`
  std::vector<double> inverse;    ///< of the diagonal, or 0
  std::vector<double> held;       ///< by conditions on the boundary
  std::vector<double> mass;       ///< times volume
  std::vector<int32_t> corner;    ///< 3 per node: lowest grid cell of its block
  std::vector<double> size;       ///< of its block, in grid cells
  std::vector<double> strength;   ///< the largest diagonal of the nodes that it is made of
  std::vector<uint32_t> coarse;   ///< per node: that of the next level, or none for one without couplings
  detail::Csr<uint32_t> members;  ///< per node of the next level, those of this one, ascending
  SweepOrder order;
  bool twice = false;  ///< whether the next level, of at most half as many nodes, is visited twice

  static constexpr uint32_t none = ~uint32_t(0);
  size_t count() const { return diagonal.size(); }
  bool isCoupled(size_t i) const { return lower.offsets[i] < lower.offsets[i + 1] || higher.offsets[i] < higher.offsets[i + 1]; }
  template <class F>
  void forCouplings(size_t i, const F& f) const {
    lower.forEach(i, f);
    higher.forEach(i, f);
  }
};

struct OrderedMatrix {
  const CsrMatrix& matrix;
  const SweepOrder& order;  ///< of its rows
};

/// `system`: its positive entries beside the diagonal, of small cells that share the side of a larger one, are left out. `held` and `mass`
/// are what conditions on the boundary and mass add to the diagonal, per cell. A level where they outweigh couplings everywhere is the last
/// one if there is mass.
std::vector<Level> multigridLevels(const CellComplex& cells, const OrderedMatrix& system, std::vector<double> held,
                                   std::vector<double> mass, unsigned threads);

}  // namespace mandoline::physics

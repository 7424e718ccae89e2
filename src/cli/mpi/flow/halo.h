// Values of cells that processes tell each other.
#pragma once

#include "mandoline/distributed.h"
#include "mpi/communicator.h"
#include "mpi/ghost_layers.h"

namespace mandoline::cli {

class Halo {
 public:
  /// `ghostLayers`: as many as the complex was made with. Collective; keeps references to both.
  Halo(detail::Communicator& comm, const RankComplex& complex, int ghostLayers) : comm_(comm), complex_(complex), count_(ghostLayers) {
    const detail::RankLayers layers = detail::layersOfAll(comm, complex.layers);
    below_ = detail::neighbourOf(layers, comm.rank(), -1);
    above_ = detail::neighbourOf(layers, comm.rank(), 1);
    cells_.resize(size_t(complex.allLayers[1] - complex.allLayers[0]));
    for (uint32_t c = 0; c < complex.cells.cellCount(); ++c)
      cells_[size_t(complex.cells.cellCorner[3 * size_t(c) + 2] - complex.allLayers[0])].push_back(c);
  }

  /// Sets the values of ghosts to those that their processes have. Collective.
  template <class Value>
  void update(std::vector<Value>& values) const {
    for (int i = 0; i < count_; ++i) {
      move(complex_.layers[1] - 1 - i, above_, complex_.layers[0] - 1 - i, below_, values);
      move(complex_.layers[0] + i, below_, complex_.layers[1] + i, above_, values);
    }
  }

 private:
  /// Sends the values of a layer, and gets those of another one.
  template <class Value>
  void move(int64_t sent, int to, int64_t received, int from, std::vector<Value>& values) const {
    const std::span<const uint32_t> cells = cellsIn(received);  // as many as the other process sends
    std::vector<Value> items, told(from >= 0 ? cells.size() : 0);
    for (const uint32_t c : cellsIn(sent)) items.push_back(values[c]);
    comm_.exchange(std::as_bytes(std::span(items)), to, std::as_writable_bytes(std::span(told)), from);
    for (size_t i = 0; i < told.size(); ++i) values[cells[i]] = told[i];
  }

  std::span<const uint32_t> cellsIn(int64_t layer) const {
    if (layer < complex_.allLayers[0] || layer >= complex_.allLayers[1]) return {};
    return cells_[size_t(layer - complex_.allLayers[0])];
  }

  detail::Communicator& comm_;
  const RankComplex& complex_;
  const int count_;
  int below_, above_;
  std::vector<std::vector<uint32_t>> cells_;  // by layer
};

}  // namespace mandoline::cli

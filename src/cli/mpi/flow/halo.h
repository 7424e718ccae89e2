// Values of cells that processes tell each other.
#pragma once

#include <algorithm>

#include "mandoline/distributed.h"
#include "mpi/communicator.h"

namespace mandoline::cli {

class Halo {
 public:
  /// Collective; keeps a reference to the communicator. The ids of own cells ascend.
  Halo(detail::Communicator& comm, const RankComplex& complex) : comm_(comm) {
    std::vector<std::vector<uint64_t>> asked;
    comm.together(kNoun, [&] {
      asked.resize(size_t(comm.size()));
      ghosts_.resize(asked.size());
      for (uint32_t c = 0; c < complex.cells.cellCount(); ++c) {
        const auto rank = size_t(complex.cellRanks[c]);
        if (rank == size_t(comm.rank())) continue;
        ghosts_[rank].push_back(c);
        asked[rank].push_back(complex.cellIds[c]);
      }
    });
    asked = comm.exchangeAll(asked);
    comm.together(kNoun, [&] { findTold(complex, asked); });
  }

  /// Sets the values of ghosts to those that their processes have. Collective.
  template <class Value>
  void update(std::vector<Value>& values) const {
    std::vector<std::vector<Value>> items;
    comm_.together(kNoun, [&] {
      items.resize(told_.size());
      for (size_t rank = 0; rank < items.size(); ++rank) {
        for (const uint32_t c : told_[rank]) items[rank].push_back(values[c]);
      }
    });
    items = comm_.exchangeAll(items);
    for (size_t rank = 0; rank < items.size(); ++rank) {
      for (size_t i = 0; i < items[rank].size(); ++i) values[ghosts_[rank][i]] = items[rank][i];
    }
  }

 private:
  static constexpr const char* kNoun = "flow";

  void findTold(const RankComplex& complex, const std::vector<std::vector<uint64_t>>& asked) {
    std::vector<uint32_t> own;
    for (uint32_t c = 0; c < complex.cells.cellCount(); ++c) {
      if (complex.cellRanks[c] == comm_.rank()) own.push_back(c);
    }
    told_.resize(asked.size());
    for (size_t rank = 0; rank < asked.size(); ++rank) {
      for (const uint64_t id : asked[rank])
        told_[rank].push_back(
            *std::lower_bound(own.begin(), own.end(), id, [&](uint32_t c, uint64_t other) { return complex.cellIds[c] < other; }));
    }
  }

  detail::Communicator& comm_;
  std::vector<std::vector<uint32_t>> told_, ghosts_;  // per process: cells that it asks for, and those that it has
};

}  // namespace mandoline::cli

// Numbers, in the order of the whole's ids, for things that are spread over processes.
#pragma once

#include "mpi/communicator.h"

namespace mandoline::cli {

/// So many things that have a key.
struct KeyCount {
  uint64_t key, count;
};

struct KeysBefore {
  std::vector<uint64_t> before;  ///< per key: how many things have lower keys, in all processes
  uint64_t all = 0;              ///< how many there are
};

/// Collective. Where several processes have a key, each of them tells of all its things. Keys that follow each other with the same counts
/// cost as much as one. Throws RankError.
KeysBefore countKeys(detail::Communicator& comm, const std::vector<KeyCount>& keys);

}  // namespace mandoline::cli

// The cut-edges of one grid cell.
#pragma once

#include <algorithm>
#include <vector>

#include "base/stamped_table.h"
#include "cut/stages/cell_halves.h"

namespace mandoline::detail {

/// The cut-edges of one grid cell, each with its uses by half-faces.
class EdgeTable {
 public:
  struct Use {
    uint32_t next;    ///< or kEnd
    LocalHalf local;  ///< side 0 of a tri-cut-face, or a half-face of a grid-face
    bool isTri;
    bool ascending;  ///< runs from the lower vertex id to the higher
  };
  struct Edge {
    VertexId low, high;
    uint32_t firstUse;
  };
  static constexpr uint32_t kEnd = ~0u;

  void clear(size_t mostUses) {
    edges.clear();
    uses.clear();
    table_.clear(2 * mostUses);
  }

  void add(VertexId from, VertexId to, LocalHalf local, bool isTri) {
    const uint64_t key = keyOf(from, to);
    const StampedTable::View table = table_.view();
    StampedTable::Slot& slot = table.at(key);
    if (table.isFree(slot)) {
      table.put(slot, key, uint32_t(edges.size()));
      edges.push_back({std::min(from, to), std::max(from, to), kEnd});
    }
    Edge& edge = edges[slot.number];
    uses.push_back({edge.firstUse, local, isTri, from < to});
    edge.firstUse = uint32_t(uses.size() - 1);
  }

  std::vector<Edge> edges;
  std::vector<Use> uses;

 private:
  StampedTable table_;  // of numbers of edges
};

}  // namespace mandoline::detail

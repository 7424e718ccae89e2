// The cut-edges of one grid cell.
#pragma once

#include <algorithm>
#include <cstdint>
#include <vector>

#include "cut/stages/cell_halves.h"

namespace mandoline::detail {

/// The cut-edges of one grid cell, each with its uses by half-faces: a hash table that is emptied by counting up a stamp.
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
    size_t size = slots_.size();
    while (size < 2 * mostUses) size = std::max<size_t>(256, 2 * size);
    if (size > slots_.size()) {
      slots_.assign(size, {0, 0});
      stamp_ = 0;
    }
    mask_ = 255;
    while (mask_ + 1 < 2 * mostUses) mask_ = 2 * mask_ + 1;  // small cells stay in a small part of the table
    if (++stamp_ == 0) {
      std::fill(slots_.begin(), slots_.end(), Slot{0, 0});
      stamp_ = 1;
    }
  }

  void add(VertexId from, VertexId to, LocalHalf local, bool isTri) {
    const bool ascending = from < to;
    const VertexId low = ascending ? from : to, high = ascending ? to : from;
    size_t at = (low.number * 0x9e3779b1u ^ high.number * 0x85ebca6bu) >> 7;
    for (;; ++at) {
      Slot& slot = slots_[at & mask_];
      if (slot.stamp != stamp_) {
        slot = {stamp_, uint32_t(edges.size())};
        edges.push_back({low, high, kEnd});
      }
      Edge& edge = edges[slot.edge];
      if (edge.low != low || edge.high != high) continue;
      uses.push_back({edge.firstUse, local, isTri, ascending});
      edge.firstUse = uint32_t(uses.size() - 1);
      return;
    }
  }

  std::vector<Edge> edges;
  std::vector<Use> uses;

 private:
  struct Slot {
    uint32_t stamp, edge;
  };
  std::vector<Slot> slots_;
  uint32_t stamp_ = 0;
  size_t mask_ = 0;
};

}  // namespace mandoline::detail

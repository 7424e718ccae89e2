// Cuts a polygon's chain into triangles by clipping ears: a chain of n corners gives n - 2.
#pragma once

#include <cstdint>
#include <vector>

#include "operators/triangulate/chains.h"
#include "operators/triangulate/corner_tree.h"

namespace mandoline::operators {

/// One chain at a time; the buffers are kept from chain to chain.
class EarClipper {
 public:
  /// Appends the triangles of the one chain of all corners, 3 vertices each.
  void run(Chains& chains, std::vector<uint32_t>& triangles);

 private:
  static constexpr uint32_t kNone = Chains::kNone;
  static constexpr size_t kSmall = 64;  // corners up to which it tries a fan, and takes neither tree nor heap, but a bit for each

  struct HeapEntry {
    double key;  // squared length of the edge that the ear leaves
    uint32_t corner, version;
    bool operator<(const HeapEntry& other) const;  // the heap's top is the largest
  };
  struct Watcher {
    uint32_t corner, version, next;
  };

  bool isSmall() const { return chains_->corners.size() <= kSmall; }
  bool clipFan();
  void clipEars();
  void emit(uint32_t a, uint32_t b, uint32_t c);
  void suggest(uint32_t ear);
  uint32_t takeSuggested();
  uint32_t nextEar();
  uint32_t blockerOf(uint32_t ear, bool closed) const;
  uint32_t leastBadEar(uint32_t first) const;
  std::pair<int, double> badness(uint32_t ear) const;
  uint32_t clip(uint32_t ear);
  void remove(uint32_t corner);
  void wakeWatchers(uint32_t corner);

  Chains* chains_ = nullptr;
  uint32_t* triangle_ = nullptr;  // where the next one goes
  std::vector<double> keys_;      // per corner of a small chain: that of its entry, infinite without one
  uint64_t reflex_ = 0;           // the corners of a small chain, a bit each, that are there and not convex
  CornerTree tree_;               // of other chains
  std::vector<HeapEntry> heap_;
  std::vector<Watcher> watchers_;
  size_t remaining_ = 0;
};

}  // namespace mandoline::operators

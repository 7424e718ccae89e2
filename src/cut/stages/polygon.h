// Convex polygons: pieces of triangles while they are diced (dicer.h).
#pragma once

#include <algorithm>
#include <array>
#include <cstring>
#include <span>
#include <utility>
#include <vector>

#include "cut/ids.h"
#include "grid/slab.h"

namespace mandoline::detail {

struct Corner {
  VertexId id;
  Slab slab;
};
using Polygon = std::span<const Corner>;

/// Corners in a row. Room for them is made beforehand, not corner by corner; kBlock more may be read and written behind it.
class CornerRow {
 public:
  static constexpr size_t kBlock = 4;

  CornerRow() = default;
  CornerRow(const CornerRow&) = delete;

  /// Forgets all, and makes room for so many.
  void begin(size_t count) {
    clear();
    makeRoom(count);
  }
  void clear() { end_ = memory_.data(); }
  void makeRoom(size_t more) {
    if (more > size_t(limit_ - end_)) grow(more);
  }
  void add(const Corner& corner) { *end_++ = corner; }
  /// Adds some that are to be written where it says.
  Corner* lengthen(size_t count) { return std::exchange(end_, end_ + count); }
  /// Adds some that are in another such row: block by block, since how many they are can't be foretold.
  void addBlocks(const Corner* from, size_t count) {
    for (size_t i = 0; i < count; i += kBlock) std::memcpy(end_ + i, from + i, kBlock * sizeof(Corner));
    end_ += count;
  }

  size_t size() const { return size_t(end_ - memory_.data()); }
  Polygon all() const { return {memory_.data(), size()}; }

 private:
  void grow(size_t more) {
    const size_t count = size();
    memory_.resize(2 * (count + more) + kBlock);
    end_ = memory_.data() + count;
    limit_ = memory_.data() + memory_.size() - kBlock;
  }

  std::vector<Corner> memory_;
  Corner *end_ = nullptr, *limit_ = nullptr;
};

}  // namespace mandoline::detail

#include "cut/stages/ordered_loops.h"

#include "base/appender.h"
#include "base/prefetch.h"

namespace mandoline::detail {
namespace {

constexpr size_t kAhead = 8;  // faces, while where the loop of one is comes from memory

/// Block by block if there is room for it.
void writeLoop(const std::vector<VertexId>& all, std::span<const VertexId> loop, std::span<uint32_t> to) {
  const size_t pastLoop = size_t(loop.data() - all.data()) + loop.size();
  if (all.size() >= pastLoop + kAppendedBlock && to.size() >= loop.size() + kAppendedBlock) {
    for (size_t i = 0; i < loop.size(); i += kAppendedBlock) {
      for (size_t k = i; k < i + kAppendedBlock; ++k) to.data()[k] = loop.data()[k].number;
    }
  } else {
    for (size_t i = 0; i < loop.size(); ++i) to[i] = loop[i].number;
  }
}

}  // namespace

void writeOrderedLoops(const TriFaces& faces, std::span<const FaceId> order, std::span<uint32_t> vertices, uint32_t* offsets) {
  const Csr<VertexId>& loops = faces.loops;
  uint32_t at = 0;
  for (size_t i = 0; i < order.size(); ++i) {
    if (i + 2 * kAhead < order.size()) prefetch(&loops.offsets[faces.firstLoop(order[i + 2 * kAhead])]);
    if (i + kAhead < order.size()) prefetch(loops.items.data() + loops.offsets[faces.firstLoop(order[i + kAhead])]);
    for (const auto loop : faces.loopsOf(order[i])) {
      *offsets++ = at;
      writeLoop(loops.items, loop, vertices.subspan(at));
      at += uint32_t(loop.size());
    }
  }
}

}  // namespace mandoline::detail

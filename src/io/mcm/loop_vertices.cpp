#include <algorithm>
#include <array>

#include "io/mcm/arrays.h"

namespace mandoline::detail {
namespace {

/// The vertices that loops had beside a vertex, the last ones first.
class Neighbours {
 public:
  static constexpr size_t kMost = 4;

  explicit Neighbours(size_t vertices) : lists_(vertices) {
    for (auto& list : lists_) list.fill(kNone);
  }

  /// The place of `other` in the vertex's list, or kMost.
  size_t find(uint32_t vertex, uint32_t other) const {
    const auto& list = lists_[vertex];
    return size_t(std::find(list.begin(), list.end(), other) - list.begin());
  }
  uint32_t at(uint32_t vertex, size_t place) const { return lists_[vertex][place]; }
  /// Puts each in front of the other's list.
  void join(uint32_t a, uint32_t b) {
    moveToFront(a, b);
    moveToFront(b, a);
  }

  static constexpr uint32_t kNone = ~0u;

 private:
  void moveToFront(uint32_t vertex, uint32_t other) {
    bool found = false;  // no branch on it, since the place can't be predicted
    uint32_t moved = other;
    for (uint32_t& entry : lists_[vertex]) {
      const uint32_t old = entry;
      entry = found ? old : moved;
      found |= old == other;
      moved = old;
    }
  }

  std::vector<std::array<uint32_t, kMost>> lists_;
};

template <class Stream, class AnyCutMesh>
class LoopCoder {
 public:
  LoopCoder(typename Stream::Bytes& bytes, AnyCutMesh& cutMesh)
      : cutMesh_(cutMesh), neighbours_(cutMesh.vertexMask.size()), places_(bytes), steps_(bytes) {}

  void run(uint64_t length) {
    requireOffsets(cutMesh_.loopOffsets, length);
    places_.expect(length - std::min<uint64_t>(length, cutMesh_.loopOffsets.size() - 1));  // all but the first of each loop
    setLength(cutMesh_.loopVertices, length);
    for (size_t l = 0; l + 1 < cutMesh_.loopOffsets.size(); ++l) codeLoop(cutMesh_.loopOffsets[l], cutMesh_.loopOffsets[l + 1]);
    places_.finish();
    steps_.finish();
  }

 private:
  static constexpr bool kIsRead = !std::is_const_v<AnyCutMesh>;

  void codeLoop(size_t begin, size_t end) {
    auto& vertices = cutMesh_.loopVertices;
    if (begin == end) return;
    first_ = codeStep(vertices[begin], first_);
    for (size_t i = begin + 1; i < end; ++i) {
      const uint32_t last = vertices[i - 1];
      const size_t known = kIsRead ? 0 : neighbours_.find(last, vertices[i]);
      const size_t place = size_t(places_.code(int64_t(known)));
      if (place > Neighbours::kMost) throw Damaged{kNoVertex};
      if (place == Neighbours::kMost) {
        codeStep(vertices[i], last);
      } else if constexpr (kIsRead) {
        vertices[i] = neighbours_.at(last, place);
        if (vertices[i] == Neighbours::kNone) throw Damaged{kNoVertex};
      }
      neighbours_.join(last, vertices[i]);
    }
    neighbours_.join(vertices[end - 1], vertices[begin]);
  }

  template <class Vertex>
  uint32_t codeStep(Vertex& vertex, uint32_t from) {
    codeEntry(steps_, vertex, from);
    if (vertex >= cutMesh_.vertexMask.size()) throw Damaged{kNoVertex};
    return vertex;
  }

  static constexpr const char* kNoVertex = "names a vertex that does not exist";
  AnyCutMesh& cutMesh_;
  Neighbours neighbours_;
  Stream places_, steps_;
  uint32_t first_ = 0;  // of the loop before
};

}  // namespace

void requireOffsets(const std::vector<uint32_t>& offsets, uint64_t end) {
  const bool fit = !offsets.empty() && offsets.front() == 0 && offsets.back() == end && std::is_sorted(offsets.begin(), offsets.end());
  if (!fit) throw Damaged{"does not fit its offsets"};
}

template <class Stream, class AnyCutMesh>
void codeLoopVertices(typename Stream::Bytes& bytes, AnyCutMesh& cutMesh, uint64_t length) {
  LoopCoder<Stream, AnyCutMesh>(bytes, cutMesh).run(length);
}

template void codeLoopVertices<WrittenStream>(std::string& bytes, const CutMesh& cutMesh, uint64_t length);
template void codeLoopVertices<ReadStream>(std::string_view& bytes, CutMesh& cutMesh, uint64_t length);

}  // namespace mandoline::detail

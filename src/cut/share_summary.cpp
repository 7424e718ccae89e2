#include "cut/share_summary.h"

#include <array>
#include <bit>
#include <cstring>

#include "base/sort.h"

namespace mandoline::detail {
namespace {

constexpr size_t kMostWords = 8;  // of an item

/// Of which all bytes are known.
template <class Item>
constexpr size_t wordsOf() {
  static_assert(std::is_trivially_copyable_v<Item> && std::has_unique_object_representations_v<Item>);
  static_assert(sizeof(Item) <= kMostWords * sizeof(uint32_t));
  return sizeof(Item) / sizeof(uint32_t);
}

class Writer {
 public:
  template <class Item>
  void add(std::span<const Item> items) {
    static_assert(std::is_trivially_copyable_v<Item>);
    addBytes(std::as_bytes(items));
  }
  void add(uint32_t number) { words.push_back(number); }
  /// Items that are like those before them: of each word of theirs the difference, in as few bytes as it needs. The lowest bit is the sign.
  template <class Item>
  void addDifferences(std::span<const Item> items) {
    addDifferences(std::as_bytes(items), wordsOf<Item>());
  }

  std::vector<uint32_t> words;

 private:
  void addDifferences(std::span<const std::byte> items, size_t wordsOfOne) {
    const size_t count = items.size() / sizeof(uint32_t);
    uint32_t before[kMostWords]{};
    bytes_.clear();
    for (size_t i = 0; i < count; ++i) {
      uint32_t now, &last = before[i % wordsOfOne];
      std::memcpy(&now, &items[i * sizeof now], sizeof now);
      const uint32_t difference = now - last;
      uint32_t left = difference << 1 ^ (0 - (difference >> 31));
      for (; left >= 128; left >>= 7) bytes_.push_back(std::byte(left % 128 + 128));
      bytes_.push_back(std::byte(left));
      last = now;
    }
    add(uint32_t(count / wordsOfOne));
    addBytes(bytes_);
  }
  void addBytes(std::span<const std::byte> bytes) {
    words.push_back(uint32_t(bytes.size()));
    const size_t at = words.size();
    words.resize(at + (bytes.size() + 3) / 4);
    if (!bytes.empty()) std::memcpy(&words[at], bytes.data(), bytes.size());
  }

  std::vector<std::byte> bytes_;  // of differences
};

struct BadSummary {};

class Reader {
 public:
  Reader(std::span<const uint32_t> words, Arena& memory) : words_(words), memory_(memory) {}

  uint32_t number() {
    if (words_.empty()) throw BadSummary();
    const uint32_t word = words_.front();
    words_ = words_.subspan(1);
    return word;
  }
  /// In memory that stays.
  template <class Item>
  std::span<const Item> items() {
    const size_t bytes = number();
    if (bytes % sizeof(Item) != 0) throw BadSummary();
    return {static_cast<const Item*>(copied((bytes + 3) / 4)), bytes / sizeof(Item)};
  }
  /// Likewise, of addDifferences().
  template <class Item>
  std::span<const Item> itemsOfDifferences() {
    const size_t count = number();
    const std::span<const std::byte> bytes = differences(count, wordsOf<Item>());
    return memory_.make<Item>(count, [&](std::span<Item> items) { addUp(bytes, std::as_writable_bytes(items), wordsOf<Item>()); });
  }
  bool isAtEnd() const { return words_.empty(); }

 private:
  std::span<const std::byte> differences(size_t count, size_t wordsOfOne) {
    const size_t bytes = number(), size = (bytes + 3) / 4;
    if (size > words_.size() || count > bytes / wordsOfOne) throw BadSummary();
    const std::span<const std::byte> differences = std::as_bytes(words_).first(bytes);
    words_ = words_.subspan(size);
    return differences;
  }
  static void addUp(std::span<const std::byte> differences, std::span<std::byte> items, size_t wordsOfOne) {
    uint32_t now[kMostWords]{};
    for (size_t i = 0; i < items.size() / sizeof *now; ++i) {
      uint32_t& word = now[i % wordsOfOne];
      word += differenceFrom(differences);
      std::memcpy(&items[i * sizeof word], &word, sizeof word);
    }
    if (!differences.empty()) throw BadSummary();
  }
  static uint32_t differenceFrom(std::span<const std::byte>& bytes) {
    constexpr uint32_t kMostBits = 32;
    uint32_t sum = 0;
    for (uint32_t shift = 0; shift < kMostBits; shift += 7) {
      if (bytes.empty()) break;
      const uint32_t byte = uint32_t(bytes.front());
      bytes = bytes.subspan(1);
      sum |= byte % 128 << shift;
      if (byte < 128) return sum >> 1 ^ (0 - (sum & 1));
    }
    throw BadSummary();
  }

  const void* copied(size_t words) {
    if (words > words_.size()) throw BadSummary();
    const void* copy = memory_.copy(words_.first(words)).data();
    words_ = words_.subspan(words);
    return copy;
  }

  std::span<const uint32_t> words_;
  Arena& memory_;
};

/// What seams and regions need of a brick, in the order in which it is written and read: f(array) for each.
template <class Cut, class F>
void forArrays(Cut& cut, const F& f) {
  f(cut.rows);
  f(cut.boundaryFaces);
  f(cut.boundaryHalves);
  f(cut.boundaryLines);
  f(cut.openFaces);
  f(cut.steps);
}

/// The cells in which components begin: what is left of `gridCells` where `components` counts up.
std::vector<uint32_t> firstCells(const BrickCut& cut) {
  std::vector<uint32_t> first;
  for (const CellId c : cut.components.ids()) {
    if (cut.components[c] == first.size()) first.push_back(cut.gridCells[c]);
  }
  return first;
}

constexpr size_t kHead = 5;
std::array<uint32_t, kHead> headOf(const ShareOf& shareOf, Fingerprint cut, uint32_t vertices) {
  return {uint32_t(cut.value >> 32), uint32_t(cut.value), shareOf.count, shareOf.index, vertices};
}

void addBrick(const Bricks& bricks, BrickId b, const BrickCut& cut, Writer& to) {
  to.add(uint32_t(bricks.keys[b] >> 32));
  to.add(uint32_t(bricks.keys[b]));
  to.add(bricks.wordsOf(b));
  to.addDifferences(std::span<const uint32_t>(firstCells(cut)));
  to.add(cut.componentAtCorner.value_or(~0u));
  forArrays(cut, [&](const auto& array) { to.addDifferences(array); });
}

/// Appends it to the bricks; its cut has a place already.
void readBrick(Reader& from, const CellLayers& layers, Bricks& bricks, BrickCuts& cuts) {
  const uint64_t high = from.number(), key = high << 32 | from.number();
  const bool ascends = bricks.size() == 0 || bricks.keys.back() < key;
  const auto [nx, ny, nz] = bricks.grid.counts;
  if (!ascends || key >= uint64_t(nx) * uint64_t(ny) * uint64_t(nz)) throw BadSummary();
  const BrickBox box = bricks.grid.boxOf(key);
  if (box.first[2] < layers.first || box.first[2] >= layers.past) throw BadSummary();
  if (bricks.size() == cuts.size()) throw BadSummary();
  const BrickId b = bricks.add(key);
  BrickCut& cut = cuts[b];
  const std::span<const uint64_t> touched = from.items<uint64_t>();
  if (touched.size() != bricks.wordCount(b)) throw BadSummary();
  std::copy(touched.begin(), touched.end(), bricks.wordsOf(b).begin());
  cut.gridCells = from.itemsOfDifferences<uint32_t>();
  cut.componentCount = uint32_t(cut.gridCells.size());
  if (const uint32_t corner = from.number(); corner != ~0u) cut.componentAtCorner = corner;
  forArrays(cut, [&](auto& array) { array = from.itemsOfDifferences<typename std::remove_cvref_t<decltype(array)>::value_type>(); });
}

/// Which vertices of the mesh and its edges loops have: a bit for each, by the whole's ids.
using UsedBits = std::vector<uint32_t>;

/// The whole's id of a vertex of the mesh or its edges.
uint32_t wholeId(const CutState& state, const ShareExcerpt* excerpt, VertexId v) {
  return excerpt ? excerpt->wholeId(state.surface.vertices, v) : v.number;
}
uint32_t wholeVertices(const CutState& state, const ShareExcerpt* excerpt) {
  return excerpt ? excerpt->wholeVertices : uint32_t(state.used.size());
}

/// Those of the loops here: the words that have any, each with its place.
void addUsed(const CutState& state, const ShareExcerpt* excerpt, Writer& to) {
  std::vector<uint32_t> places, words;
  for (uint32_t v = 0; v < state.used.size(); ++v) {
    if (state.used[v].load(std::memory_order_relaxed) == 0) continue;
    const uint32_t id = wholeId(state, excerpt, {v}), place = id / 32;
    if (places.empty() || places.back() != place) {
      places.push_back(place);
      words.push_back(0);
    }
    words.back() |= 1u << id % 32;
  }
  to.addDifferences(std::span<const uint32_t>(places));
  to.add(std::span<const uint32_t>(words));
}

/// Adds those of a share.
void readUsed(Reader& from, uint32_t vertices, UsedBits& used) {
  const std::span<const uint32_t> places = from.itemsOfDifferences<uint32_t>(), words = from.items<uint32_t>();
  if (places.size() != words.size()) throw BadSummary();
  for (size_t i = 0; i < places.size(); ++i) {
    if (words[i] == 0 || uint64_t(places[i]) * 32 + uint64_t(std::bit_width(words[i])) > vertices) throw BadSummary();
    used[places[i]] |= words[i];
  }
}

/// Numbers what all shares use, in the order of the whole's ids, and notes what of it is here.
void numberUsed(const UsedBits& used, const ShareExcerpt* excerpt, CutState& state) {
  SurfaceNumbers& numbers = state.surfaceNumbers.emplace();
  std::vector<uint32_t> first;  // per word
  first.reserve(used.size());
  for (const uint32_t word : used) {
    first.push_back(numbers.count);
    numbers.count += uint32_t(std::popcount(word));
  }
  numbers.ofSurface.assign(state.used.size(), Numbers::kUnused);
  for (uint32_t v = 0; v < state.used.size(); ++v) {
    const uint32_t id = wholeId(state, excerpt, {v}), word = used[id / 32], bit = 1u << id % 32;
    if ((word & bit) == 0) continue;
    state.used[v].store(1, std::memory_order_relaxed);
    numbers.ofSurface[{v}] = first[id / 32] + uint32_t(std::popcount(word & (bit - 1)));
  }
}

}  // namespace

size_t summaryBytes(const CutState& state, BrickId brick) {
  Writer to;
  addBrick(state.bricks, brick, state.cuts[brick], to);
  return to.words.size() * sizeof to.words[0];
}

std::vector<uint32_t> summarize(const CutState& state, const ShareContext& context) {
  Writer to;
  const auto head = headOf(context.shareOf, context.cut, wholeVertices(state, context.excerpt));
  to.words.assign(head.begin(), head.end());
  to.add(uint32_t(state.bricks.here.size()));
  addUsed(state, context.excerpt, to);
  for (const BrickId b : state.bricks.here.ids()) addBrick(state.bricks, b, state.cuts[b], to);
  return std::move(to.words);
}

void addSummaries(std::span<const std::vector<uint32_t>> summaries, const ShareContext& context, const ShareLayers& layers,
                  CutState& state) {
  const auto& [shareOf, cut, excerpt] = context;
  const uint32_t vertices = wholeVertices(state, excerpt);
  const auto fail = [](size_t share) {
    const std::string message = "summaries[" + std::to_string(share) + "] is not that of this share of the same cut.";
    throw Failure{{Status::badArgument, int64_t(share), -1, message}};
  };
  if (summaries.size() != shareOf.count) fail(std::min(summaries.size(), size_t(shareOf.count) - 1));
  size_t count = 0;
  for (uint32_t share = 0; share < shareOf.count; ++share) {
    const auto head = headOf({share, shareOf.count}, cut, vertices);
    if (summaries[share].size() <= kHead || !std::equal(head.begin(), head.end(), summaries[share].begin())) fail(share);
    count += std::min<size_t>(summaries[share][kHead], summaries[share].size());  // more there can't be
  }
  Bricks bricks;
  bricks.grid = state.bricks.grid;
  BrickCuts cuts;
  cuts.resize(count);
  BrickMemory memory;
  UsedBits used((size_t(vertices) + 31) / 32, 0);
  BricksHere here = state.bricks.here;
  for (uint32_t share = 0; share < shareOf.count; ++share) {
    Reader from(std::span<const uint32_t>(summaries[share]).subspan(kHead), memory.seams);
    try {
      uint32_t left = from.number();
      readUsed(from, vertices, used);
      if (share != shareOf.index) {
        for (; left > 0; --left) readBrick(from, layers.of(share), bricks, cuts);
        if (!from.isAtEnd()) throw BadSummary();
      }
    } catch (const BadSummary&) {
      fail(share);
    }
    if (share == shareOf.index) {
      here.first = {uint32_t(bricks.size())};
      for (const BrickId b : state.bricks.here.ids()) {
        const std::span<const uint64_t> touched = state.bricks.wordsOf(b);
        std::copy(touched.begin(), touched.end(), bricks.wordsOf(bricks.add(state.bricks.keys[b])).begin());
      }
      here.past = {uint32_t(bricks.size())};
    }
  }
  for (const BrickId b : state.bricks.here.ids())
    cuts[{here.first.number + b.number - state.bricks.here.first.number}] = std::move(state.cuts[b]);
  cuts.memory = std::move(state.cuts.memory);
  cuts.memory.push_back(std::move(memory));
  bricks.here = here;
  state.bricks = std::move(bricks);
  state.cuts = std::move(cuts);
  numberUsed(used, excerpt, state);
}

}  // namespace mandoline::detail

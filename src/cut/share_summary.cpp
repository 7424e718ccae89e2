#include "cut/share_summary.h"

#include <cstring>

namespace mandoline::detail {
namespace {

class Writer {
 public:
  template <class Item>
  void add(std::span<const Item> items) {
    static_assert(std::is_trivially_copyable_v<Item>);
    addBytes(std::as_bytes(items));
  }
  void add(uint32_t number) { words.push_back(number); }

  std::vector<uint32_t> words;

 private:
  void addBytes(std::span<const std::byte> bytes) {
    words.push_back(uint32_t(bytes.size()));
    const size_t at = words.size();
    words.resize(at + (bytes.size() + 3) / 4);
    if (!bytes.empty()) std::memcpy(&words[at], bytes.data(), bytes.size());
  }
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
  bool isAtEnd() const { return words_.empty(); }

 private:
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

std::vector<uint32_t> headOf(const CutState& state, const ShareOf& shareOf, Fingerprint cut) {
  return {uint32_t(cut.value >> 32),     uint32_t(cut.value),        shareOf.count, shareOf.index,
          uint32_t(state.bricks.size()), uint32_t(state.used.size())};
}

void addBrick(const Bricks& bricks, BrickId b, const BrickCut& cut, Writer& to) {
  to.add(bricks.wordsOf(b));
  to.add(std::span<const uint32_t>(firstCells(cut)));
  to.add(cut.componentAtCorner.value_or(~0u));
  forArrays(cut, [&](const auto& array) { to.add(array); });
}

void readBrick(Reader& from, Bricks& bricks, BrickId b, BrickCut& cut) {
  const std::span<const uint64_t> touched = from.items<uint64_t>();
  if (touched.size() != bricks.wordCount(b)) throw BadSummary();
  std::copy(touched.begin(), touched.end(), bricks.wordsOf(b).begin());
  cut.gridCells = from.items<uint32_t>();
  cut.componentCount = uint32_t(cut.gridCells.size());
  if (const uint32_t corner = from.number(); corner != ~0u) cut.componentAtCorner = corner;
  forArrays(cut, [&](auto& array) { array = from.items<typename std::remove_cvref_t<decltype(array)>::value_type>(); });
}

}  // namespace

size_t summaryBytes(const CutState& state, BrickId brick) {
  Writer to;
  addBrick(state.bricks, brick, state.cuts[brick], to);
  return to.words.size() * sizeof to.words[0];
}

std::vector<uint32_t> summarize(const CutState& state, const ShareOf& shareOf, Fingerprint cut) {
  Writer to;
  to.words = headOf(state, shareOf, cut);
  for (const BrickId b : state.bricks.here.ids()) addBrick(state.bricks, b, state.cuts[b], to);
  std::vector<uint8_t> used((state.used.size() + 7) / 8);
  for (size_t v = 0; v < state.used.size(); ++v) used[v / 8] |= uint8_t(state.used[v].load(std::memory_order_relaxed) << v % 8);
  to.add(std::span<const uint8_t>(used));
  return std::move(to.words);
}

void addSummaries(std::span<const std::vector<uint32_t>> summaries, const ShareOf& shareOf, Fingerprint cut, CutState& state) {
  const auto fail = [](size_t share) {
    const std::string message = "summaries[" + std::to_string(share) + "] is not that of this share of the same cut.";
    throw Failure{{Status::badArgument, int64_t(share), -1, message}};
  };
  if (summaries.size() != shareOf.count) fail(std::min(summaries.size(), size_t(shareOf.count) - 1));
  Bricks& bricks = state.bricks;
  const LayerShares shares(workOfLayers(bricks), shareOf.count);
  for (uint32_t share = 0; share < shareOf.count; ++share) {
    const std::vector<uint32_t>& summary = summaries[share];
    const std::vector<uint32_t> head = headOf(state, {share, shareOf.count}, cut);
    if (summary.size() < head.size() || !std::equal(head.begin(), head.end(), summary.begin())) fail(share);
    if (share == shareOf.index) continue;
    state.cuts.memory.emplace_back();
    Reader from(std::span<const uint32_t>(summary).subspan(head.size()), state.cuts.memory.back().seams);
    try {
      for (const BrickId b : bricksOf(bricks, shares, share).ids()) readBrick(from, bricks, b, state.cuts[b]);
      const std::span<const uint8_t> used = from.items<uint8_t>();
      if (used.size() != (state.used.size() + 7) / 8 || !from.isAtEnd()) throw BadSummary();
      for (size_t v = 0; v < state.used.size(); ++v) {
        if (used[v / 8] >> v % 8 & 1) state.used[v].store(1, std::memory_order_relaxed);
      }
    } catch (const BadSummary&) {
      fail(share);
    }
  }
}

}  // namespace mandoline::detail

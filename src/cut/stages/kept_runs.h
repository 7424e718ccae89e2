// Where things of a result lie that are the same as in the cut before: ranges of numbers, now and then.
#pragma once

#include <algorithm>
#include <cstdint>
#include <cstring>
#include <memory>
#include <numeric>
#include <span>
#include <vector>

#include "base/large_array.h"

namespace mandoline::detail {

struct KeptRuns {
  /// Things with numbers in a row, now and before.
  struct Run {
    uint32_t first, before, count;

    uint32_t past() const { return first + count; }
  };
  std::vector<Run> runs;  ///< ascending, without common numbers

  /// Calls f(part of a run) for what is kept of a range of numbers.
  template <class F>
  void forKept(size_t first, size_t past, const F& f) const {
    auto run = std::upper_bound(runs.begin(), runs.end(), first, [](size_t at, const Run& r) { return at < r.past(); });
    for (; run != runs.end() && run->first < past; ++run) {
      const uint32_t begin = std::max(run->first, uint32_t(first)), end = uint32_t(std::min<size_t>(run->past(), past));
      f(Run{begin, run->before + (begin - run->first), end - begin});
    }
  }
  /// Calls f(first, past) for the parts of a range of numbers that are not kept.
  template <class F>
  void forOthers(size_t first, size_t past, const F& f) const {
    forKept(first, past, [&](const Run& run) {
      if (first < run.first) f(first, size_t(run.first));
      first = run.past();
    });
    if (first < past) f(first, past);
  }

  /// Of an array as it was before, with `each` items for a thing: brings what is kept to where it is now, and makes it `count` things long.
  /// Calls then(items, index of a run) for parts of each run once they are there. Things have to be in the order in which they were.
  template <class Item, class Then>
  void place(std::vector<Item>& items, size_t each, size_t count, const Then& then) const {
    constexpr size_t kPart = 2048;  // things, which are still in the cache when then() is called
    const size_t length = each * count;
    if (items.capacity() < length) items = longer(items, length + length / 8);
    if (items.size() < length) resizeInRoom(items, length);
    const auto bring = [&](const Run& run, size_t begin) {
      const size_t part = each * std::min(kPart, run.count - begin);
      Item* const to = items.data() + each * (run.first + begin);
      if (run.first != run.before) std::memmove(to, items.data() + each * (run.before + begin), part * sizeof(Item));
      then(std::span(to, part), size_t(&run - runs.data()));
    };
    // What moves down comes to lie only on what such things before it have left, what moves up on what those after it have.
    for (auto run = runs.begin(); run != runs.end(); ++run) {
      if (run->first > run->before) continue;
      for (size_t begin = 0; begin < run->count; begin += kPart) bring(*run, begin);
    }
    for (auto run = runs.rbegin(); run != runs.rend(); ++run) {
      if (run->first <= run->before) continue;
      for (size_t part = (run->count + kPart - 1) / kPart; part-- > 0;) bring(*run, part * kPart);
    }
    items.resize(length);
  }
  template <class Item>
  void place(std::vector<Item>& items, size_t each, size_t count) const {
    place(items, each, count, [](std::span<Item>, size_t) {});
  }
  /// The same of an array with an item for each thing, of which those that are not kept become `fill`.
  template <class Item>
  void placeAndFill(std::vector<Item>& items, size_t count, Item fill) const {
    place(items, 1, count);
    forOthers(0, count, [&](size_t first, size_t past) { std::fill_n(items.data() + first, past - first, fill); });
  }
  /// Per number before the number now, of what is kept; there is nothing at others.
  std::unique_ptr<uint32_t[]> numbersNow(size_t countBefore) const {
    std::unique_ptr<uint32_t[]> now(new uint32_t[countBefore]);
    for (const Run& run : runs) std::iota(now.get() + run.before, now.get() + run.before + run.count, run.first);
    return now;
  }
};

}  // namespace mandoline::detail

// Where things of a result lie that are the same as in the cut before: ranges of numbers, now and then.
#pragma once

#include <algorithm>
#include <cstdint>
#include <memory>
#include <span>
#include <vector>

#include "base/function_ref.h"
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
    const size_t length = each * count;
    if (items.capacity() < length) items = longer(items, length + length / 8);
    if (items.size() < length) resizeInRoom(items, length);
    move(items.data(), each * sizeof(Item),
         [&](const Run& part, size_t run) { then(std::span(items.data() + each * part.first, each * part.count), run); });
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
  std::unique_ptr<uint32_t[]> numbersNow(size_t countBefore) const;

 private:
  /// Brings what is kept to where it is now, of things of so many bytes each, and calls then(part, index of its run).
  void move(void* things, size_t bytes, FunctionRef<void(const Run&, size_t)> then) const;
};

}  // namespace mandoline::detail

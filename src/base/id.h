// Numbers of things that must not be mixed up, and arrays by them. At run time they are bare numbers.
#pragma once

#include <compare>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

namespace mandoline::detail {

/// The number of a thing of one kind, counted from 0.
template <class Kind>
struct Id {
  uint32_t number;

  auto operator<=>(const Id&) const = default;
};

template <class Kind>
size_t indexOf(Id<Kind> id) {
  return id.number;
}
inline size_t indexOf(size_t index) { return index; }

/// Ids in a row, to loop over.
template <class Id>
class Ids {
 public:
  struct Iterator {
    Id id;

    Id operator*() const { return id; }
    Iterator& operator++() {
      ++id.number;
      return *this;
    }
    bool operator==(const Iterator&) const = default;
  };

  /// first .. past - 1
  Ids(Id first, Id past) : first_(first), past_(past) {}
  Ids(size_t first, size_t past) : first_{uint32_t(first)}, past_{uint32_t(past)} {}
  /// 0 .. count - 1
  explicit Ids(size_t count) : Ids(0, count) {}
  bool empty() const { return first_ == past_; }
  Iterator begin() const { return {first_}; }
  Iterator end() const { return {past_}; }

 private:
  Id first_, past_;
};

/// A flat array with one item for each id.
template <class Id, class Item>
struct IdVector : std::vector<Item> {
  using std::vector<Item>::vector;

  Item& operator[](Id id) { return this->data()[id.number]; }
  const Item& operator[](Id id) const { return this->data()[id.number]; }
  Ids<Id> ids() const { return Ids<Id>(this->size()); }
};

/// The same in memory of somebody else.
template <class Id, class Item>
struct IdSpan : std::span<const Item> {
  IdSpan() = default;
  IdSpan(std::span<const Item> items) : std::span<const Item>(items) {}

  const Item& operator[](Id id) const { return this->data()[id.number]; }
  Ids<Id> ids() const { return Ids<Id>(this->size()); }
};

}  // namespace mandoline::detail

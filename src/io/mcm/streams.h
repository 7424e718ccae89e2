// One function for both ways: code(n) writes the integer n or, where there is none yet, reads and returns it. So what is read is what was
// written: there is no step that only one of them has.
#pragma once

#include <cstring>
#include <limits>
#include <type_traits>

#include "io/mcm/integers.h"

namespace mandoline::detail {

class WrittenStream {
 public:
  using Bytes = std::string;

  explicit WrittenStream(Bytes& bytes) : bytes_(bytes) {}
  void expect(uint64_t) const {}
  int64_t code(int64_t n) {
    writer_.putSigned(n);
    return n;
  }
  void finish() { writer_.finish(bytes_); }

 private:
  Bytes& bytes_;
  IntegerWriter writer_;
};

/// Throws Damaged.
class ReadStream {
 public:
  using Bytes = std::string_view;

  explicit ReadStream(Bytes& bytes) : reader_(bytes) {}
  void expect(uint64_t count) const { reader_.expect(count); }
  int64_t code(int64_t) { return reader_.nextSigned(); }
  void finish() const { reader_.finish(); }

 private:
  IntegerReader reader_;
};

// Numbers as integers and back. Doubles are numbered in their order, so that near ones have near numbers.
template <class Number>
int64_t toInteger(Number n) {
  if constexpr (std::is_floating_point_v<Number>) {
    int64_t bits;
    std::memcpy(&bits, &n, sizeof bits);
    return bits < 0 ? bits ^ std::numeric_limits<int64_t>::max() : bits;
  } else {
    return int64_t(n);
  }
}
template <class Number>
Number fromInteger(int64_t n) {
  if constexpr (std::is_floating_point_v<Number>) {
    const int64_t bits = n < 0 ? n ^ std::numeric_limits<int64_t>::max() : n;
    double number;
    std::memcpy(&number, &bits, sizeof number);
    return number;
  } else if constexpr (std::is_same_v<Number, uint64_t>) {
    return Number(n);
  } else {
    if (n < int64_t(std::numeric_limits<Number>::min()) || n > int64_t(std::numeric_limits<Number>::max())) {
      throw Damaged{"has an entry that is out of its type's range"};
    }
    return Number(n);
  }
}

/// Gives an array its length, or where it is written, takes it as it is.
template <class Array>
void setLength(Array& array, uint64_t length) {
  if constexpr (!std::is_const_v<Array>) {
    if (length > array.max_size()) throw Damaged{"is longer than memory is large"};
    array.resize(size_t(length));
  }
}

/// Codes a - b and returns a, without overflow.
template <class Stream>
int64_t codeDifference(Stream& stream, int64_t a, int64_t b) {
  return int64_t(uint64_t(stream.code(int64_t(uint64_t(a) - uint64_t(b)))) + uint64_t(b));
}

/// Codes an array's entry as what it differs from its prediction: an entry that is const is written, any other is read.
template <class Stream, class Entry>
void codeEntry(Stream& stream, Entry& entry, int64_t prediction) {
  const int64_t n = codeDifference(stream, std::is_const_v<Entry> ? toInteger(entry) : 0, prediction);
  if constexpr (!std::is_const_v<Entry>) entry = fromInteger<Entry>(n);
}

}  // namespace mandoline::detail

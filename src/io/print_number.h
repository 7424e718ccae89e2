// Numbers as text.
#pragma once

#include <charconv>
#include <version>

namespace mandoline::detail {

/// Writes an integer from `begin` on, with room up to `end`, and returns where it ends.
template <class Integer>
char* printNumber(char* begin, char* end, Integer n) {
  return std::to_chars(begin, end, n).ptr;
}

/// What std::to_chars writes for a double, in a few kilobytes and from the standard library's integers alone.
char* printShortest(char* begin, char* end, double n);

/// Doubles read back identically, from as few digits as possible.
inline char* printNumber(char* begin, char* end, double n) {
#if defined(__cpp_lib_to_chars) && !defined(__EMSCRIPTEN__)
  return std::to_chars(begin, end, n).ptr;
#else
  return printShortest(begin, end, n);
#endif
}

}  // namespace mandoline::detail

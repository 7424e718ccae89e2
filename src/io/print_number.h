// Numbers as text.
#pragma once

#include <charconv>

namespace mandoline::detail {

/// Writes an integer from `begin` on, with room up to `end`, and returns where it ends.
template <class Integer>
char* printNumber(char* begin, char* end, Integer n) {
  return std::to_chars(begin, end, n).ptr;
}

#ifdef __EMSCRIPTEN__  // its library may lack doubles, and JavaScript knows how to print them
char* printNumber(char* begin, char* end, double n);
#else
/// Doubles read back identically, from as few digits as possible.
inline char* printNumber(char* begin, char* end, double n) { return std::to_chars(begin, end, n).ptr; }
#endif

}  // namespace mandoline::detail

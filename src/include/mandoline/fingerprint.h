// What a result was made of.
#pragma once

#include <cstdint>
#include <string>

#include "mandoline/api.h"

namespace MANDOLINE_API mandoline {

/// Stands for a result and all that it was made of: the numbers of the mesh, the planes of the grid, the options. The same input has the
/// same one, for any number of threads, natively and in WebAssembly. Functions that take two results refuse those that were not made from
/// each other. Of arrays from elsewhere it is unknown: these are trusted to belong together. Who changes arrays sets it to {}.
struct Fingerprint {
  uint64_t value = 0;  ///< 0 if unknown

  bool isKnown() const { return value != 0; }
  bool operator==(const Fingerprint&) const = default;
  /// 16 hexadecimal digits, as in JSON and JavaScript.
  std::string text() const {
    std::string digits(16, '0');
    for (size_t i = 0; i < digits.size(); ++i) digits[i] = "0123456789abcdef"[value >> (60 - 4 * i) & 15];
    return digits;
  }
};

}  // namespace mandoline

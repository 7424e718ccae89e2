// What fingerprints are made of, and whether two results belong together.
#pragma once

#include <span>
#include <string_view>

#include "base/mix.h"
#include "base/shared.h"
#include "mandoline/fingerprint.h"
#include "mandoline/mesh.h"

namespace mandoline::detail {

/// Takes all that a result is made of, number by number.
class Fingerprinter {
 public:
  /// `kind`: what the result is, since different ones may be made of the same.
  explicit Fingerprinter(std::string_view kind) {
    for (const char letter : kind) add(uint64_t(uint8_t(letter)));
  }
  /// Of a result that is made from another.
  Fingerprinter(std::string_view kind, Fingerprint from) : Fingerprinter(kind) {
    add(from.value);
    isKnown_ = from.isKnown();
  }

  /// From what another has come to, which knows of no other result.
  static Fingerprinter goingOn(uint64_t state) {
    Fingerprinter fingerprinter("");
    fingerprinter.sum_ = state;
    return fingerprinter;
  }
  uint64_t state() const { return sum_; }

  void add(uint64_t number) { sum_ = mixed(sum_, number); }
  /// -0 counts as 0, and what is no number as one and the same, since both change on their way through files and JavaScript.
  MANDOLINE_SHARED void add(double number);
  MANDOLINE_SHARED void add(std::span<const double> numbers);
  MANDOLINE_SHARED void add(std::span<const uint32_t> numbers);

  /// Unknown if that of the other result is.
  Fingerprint get() const { return {!isKnown_ ? 0 : sum_ == 0 ? 1 : sum_}; }

 private:
  uint64_t sum_ = 0;
  bool isKnown_ = true;
};

MANDOLINE_SHARED Fingerprint fingerprintOf(const MeshView& mesh);

/// Whether both may stand for the same.
inline bool mayBeSame(Fingerprint a, Fingerprint b) { return !a.isKnown() || !b.isKnown() || a == b; }

}  // namespace mandoline::detail

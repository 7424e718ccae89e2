// How checks are counted and reported.
//
// Measured checks are in roundings. One rounding along axis d is half an ulp of the largest coordinate there, the most that storing a
// position can move it. The deviation of a length, area or volume is divided by how much it changes when its whole boundary moves by one
// rounding, so one tolerance fits slivers, thin slabs and huge grids alike.
#pragma once

#include <cstdint>
#include <string>

#include "mandoline/validate.h"
#include "operators/validate/geometry.h"

namespace mandoline::validation {

/// A made vertex may be off by the 8 roundings of its own computation and is compared through a chain of at most some 20 more, each of
/// values up to twice the largest coordinate.
constexpr double kTolerance = 64;

/// How far something is off: in roundings, by which it is judged, and as a share of the quantity that the message names.
struct Deviation {
  double roundings = 0, share = 0;

  /// A distance whose coordinates are in roundings; its share is that of the largest coordinate.
  static Deviation ofDistance(double roundings) { return {roundings, roundings * kRounding}; }
};

/// Collects one check: the number of violations, or the largest deviation. Tallies of parts of the work, merged in order, give that of the
/// whole.
class Tally {
 public:
  explicit Tally(const char* name, double tolerance = 0) { check_.name = name, check_.tolerance = tolerance; }
  /// A combinatorial check is broken; `text` goes on after "Face 12 ". The first element is kept.
  void violate(const char* kind, int64_t element, const char* text);
  /// Something was measured; `text` goes on after "Face 12 " and has {} where the share belongs, if anywhere. The worst element is kept.
  void measure(const Deviation& deviation, const char* kind, int64_t element, const char* text);
  /// Takes in what the next part of the work has found.
  void merge(const Tally& next);
  void skip(const std::string& reason) { check_.skipped = true, check_.message = reason; }
  /// The result; `leftOut` says what a check that passes has not looked at.
  Check finish(const std::string& leftOut = {}) const;

 private:
  void keep(const char* kind, int64_t element, const char* text);
  std::string sentence() const;

  Check check_;
  const char* text_ = "";
  double share_ = 0;
};

/// "1 edge", "2 edges".
std::string counted(uint64_t count, const std::string& noun);

}  // namespace mandoline::validation

// Corrections that follow from the phi that they lead to.
#pragma once

#include <algorithm>
#include <cmath>
#include <vector>

#include "base/function_ref.h"

namespace mandoline::physics {

/// Finds them pass by pass: in each the system is solved with the last ones, and phi says which ones there should be. A secant through the
/// last two passes (Anderson's acceleration) leaves a tenth of what is still missing.
class CorrectionPasses {
 public:
  using Vector = std::vector<double>;
  /// That of corrections, as of Differentiator::product().
  using Product = detail::FunctionRef<double(const Vector&, const Vector&)>;

  /// `enough`: what may be missing, as a square; `isWarm`: whether the first phi is no solution yet.
  CorrectionPasses(size_t count, double enough, bool isWarm) : next_(count), enough_(enough), first_(isWarm ? 1 : 0) {}

  /// Takes those that phi says. Whether there are better ones to solve with: next().
  bool add(Vector found, Product product) {
    Vector missing(found.size());
    for (size_t i = 0; i < found.size(); ++i) missing[i] = found[i] - next_[i];
    const double size = product(missing, missing);
    if (!(size > enough_ && (pass_ <= first_ || size < before_) && std::isfinite(size))) return false;
    if (pass_ == first_) enough_ = std::max(enough_, kEnough * product(found, found));
    before_ = size;
    next_ = found;
    if (pass_ > 0) {
      Vector change = missing;
      for (size_t i = 0; i < change.size(); ++i) change[i] -= missingBefore_[i];
      const double share = product(missing, change) / product(change, change);
      for (size_t i = 0; i < next_.size(); ++i) next_[i] -= share * (found[i] - foundBefore_[i]);
    }
    foundBefore_ = std::move(found), missingBefore_ = std::move(missing);
    ++pass_;
    return true;
  }
  const Vector& next() const { return next_; }

 private:
  /// Corrections of which less is missing, as a square, relative to the first ones, are good enough.
  static constexpr double kEnough = 1e-9;

  Vector next_, foundBefore_, missingBefore_;
  double enough_, before_ = 0;
  const int first_;  // the first pass after a solution
  int pass_ = 0;
};

}  // namespace mandoline::physics

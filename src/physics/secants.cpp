#include "physics/secants.h"

#include <cmath>
#include <utility>

namespace mandoline::physics {

static void addTimes(double factor, const std::vector<double>& values, std::vector<double>& sums) {
  for (size_t i = 0; i < sums.size(); ++i) sums[i] += factor * values[i];
}

double Secants::add(const std::vector<double>& x, std::vector<double> found) {
  std::vector<double> missing = found;
  addTimes(-1, x, missing);
  if (!std::exchange(isFirst_, false)) {
    addTimes(-1, found, found_), addTimes(-1, missing, missing_);
    addDirection(std::move(missing_), std::move(found_));
  }
  found_ = std::move(found), missing_ = std::move(missing);
  return std::sqrt(product(missing_, missing_));
}

std::vector<double> Secants::next() const {
  std::vector<double> x = found_;
  for (const Direction& direction : directions_) addTimes(-product(missing_, direction.missing), direction.found, x);
  return x;
}

/// A direction that others nearly span is left out: what is new in it is mostly the error of f.
void Secants::addDirection(std::vector<double> missing, std::vector<double> found) {
  constexpr double kNew = 0.02;
  const double lengthBefore = std::sqrt(product(missing, missing));
  for (const Direction& direction : directions_) {
    const double along = product(missing, direction.missing);
    addTimes(-along, direction.missing, missing), addTimes(-along, direction.found, found);
  }
  const double length = std::sqrt(product(missing, missing));
  if (!(length > kNew * lengthBefore)) return;
  for (std::vector<double>* values : {&missing, &found}) {
    for (double& value : *values) value /= length;
  }
  directions_.push_back({std::move(missing), std::move(found)});
}

double Secants::product(const std::vector<double>& a, const std::vector<double>& b) const {
  double sum = 0;
  for (size_t i = 0; i < a.size(); ++i) sum += weights_[i] * a[i] * b[i];
  return sum_ ? sum_(sum) : sum;
}

}  // namespace mandoline::physics

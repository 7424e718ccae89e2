// The fixed point of a linear map.
#pragma once

#include <functional>
#include <vector>

namespace mandoline::physics {

/// Where x = f(x), for a linear f that takes long: by secants through all x that were tried (Anderson's acceleration with full memory).
class Secants {
 public:
  /// Per number of x, not negative: distances are weighted. `sum`: over several processes, of which each has a part of x; null for one.
  explicit Secants(std::vector<double> weights, std::function<double(double)> sum = nullptr)
      : weights_(std::move(weights)), sum_(std::move(sum)) {}

  /// Takes f(x). Gives how far it is from x.
  double add(const std::vector<double>& x, std::vector<double> found);

  /// What to try next.
  std::vector<double> next() const;

 private:
  struct Direction {
    std::vector<double> missing;  ///< of length 1, at right angles to those of other directions
    std::vector<double> found;
  };

  double product(const std::vector<double>& a, const std::vector<double>& b) const;
  void addDirection(std::vector<double> missing, std::vector<double> found);

  std::vector<double> weights_;
  std::function<double(double)> sum_;
  std::vector<Direction> directions_;
  std::vector<double> found_, missing_;  ///< f(x), and f(x) - x, of the last x
  bool isFirst_ = true;                  ///< also where this process has no number of x
};

}  // namespace mandoline::physics

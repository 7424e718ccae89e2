// Orders of convergence, and what is said of those that are too low.
#pragma once

#include <array>
#include <cmath>
#include <cstdint>
#include <iomanip>
#include <sstream>
#include <string>
#include <vector>

namespace mandoline::orders {

/// The order that two errors show, and what is said of numbers that are not as they should be.
class Orders {
 public:
  /// `row` names what is measured.
  double of(const std::string& row, std::array<int64_t, 2> n, std::array<double, 2> errors, double least) {
    const double order = std::log(errors[0] / errors[1]) / std::log(double(n[1]) / double(n[0]));
    const bool isBounded = n[1] == 2 * n[0] && (n[0] == 16 || n[0] == 32);
    if (isBounded && !(order >= least)) {
      std::ostringstream text;
      text << std::fixed << std::setprecision(2) << row << ", N = " << n[1] << ": order " << order << ", should be at least " << least;
      complaints_.push_back(text.str());
    }
    return order;
  }
  /// The same of what two halvings show. One halving may leave the largest octree cells as large as they were: from 16 to 32 it does.
  void ofHalvings(const std::string& row, std::array<double, 2> errors, double least) {
    const double order = std::log(errors[0] / errors[1]) / std::log(4);
    require("the order from N = 16 to 64 of " + row, order, least, HUGE_VAL);
  }
  void require(const std::string& row, double value, double least, double most) {
    if (value >= least && value <= most) return;
    std::ostringstream text;
    text << row << " is " << value << ", should be " << least << " to " << most;
    complaints_.push_back(text.str());
  }
  const std::vector<std::string>& complaints() const { return complaints_; }

 private:
  std::vector<std::string> complaints_;
};

}  // namespace mandoline::orders

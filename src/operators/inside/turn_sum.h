// Sums of angles, the same bits on every platform: C libraries differ in atan2.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>

namespace mandoline::operators {

/// The angle of (x, y) from the x-axis, in turns: above -1/2 and at most 1/2. Off by a few roundings.
inline double turnsOf(double x, double y) {
  constexpr double kTurn = 6.283185307179586476925, kTanOfSixteenth = 0.41421356237309504880;
  const double large = std::max(std::fabs(x), std::fabs(y)), small = std::min(std::fabs(x), std::fabs(y));
  if (large == 0) return 0;
  double t = small / large, turns = 0;
  if (t > kTanOfSixteenth) {  // the angle less an eighth of a turn
    t = (t - 1) / (t + 1);
    turns = 0.125;
  }
  double series = 0;
  for (int n = 43; n >= 1; n -= 2) series = 1.0 / n - t * t * series;  // Gregory's
  turns += t * series / kTurn;
  if (std::fabs(y) > std::fabs(x)) turns = 0.25 - turns;
  if (x < 0) turns = 0.5 - turns;
  return y < 0 ? -turns : turns;
}

/// A sum of angles, each given by a vector that has it from the x-axis: their product as complex numbers, and how often it went around.
class TurnSum {
 public:
  /// An angle of half a turn, which might as well be minus that, counts as their mean, 0; so does that of a zero vector.
  void add(double x, double y) {
    if (y == 0 && x <= 0) return;
    const bool wasBelow = y_ < 0;
    const double nextX = x_ * x - y_ * y, nextY = x_ * y + y_ * x;
    if (!wasBelow && !(y < 0) && nextY < 0) ++wholeTurns_;
    if (wasBelow && y < 0 && (nextY > 0 || (nextY == 0 && nextX < 0))) --wholeTurns_;
    x_ = nextX, y_ = nextY;
    const double size = std::max(std::fabs(x_), std::fabs(y_));
    if (size > 0x1p100 || size < 0x1p-100) {
      x_ /= size;
      y_ /= size;
    }
  }
  double turns() const { return double(wholeTurns_) + turnsOf(x_, y_); }

 private:
  double x_ = 1, y_ = 0;
  int64_t wholeTurns_ = 0;
};

}  // namespace mandoline::operators

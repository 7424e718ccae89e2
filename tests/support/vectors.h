// Arithmetic on points and vectors, of doubles or of exact numbers.
#pragma once

#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

namespace vectors {

template <class Number>
std::array<Number, 3> operator+(const std::array<Number, 3>& a, const std::array<Number, 3>& b) {
  return {a[0] + b[0], a[1] + b[1], a[2] + b[2]};
}
template <class Number>
std::array<Number, 3> operator-(const std::array<Number, 3>& a, const std::array<Number, 3>& b) {
  return {a[0] - b[0], a[1] - b[1], a[2] - b[2]};
}
template <class Number>
std::array<Number, 3> operator*(const Number& s, const std::array<Number, 3>& a) {
  return {s * a[0], s * a[1], s * a[2]};
}
template <class Number>
Number dot(const std::array<Number, 3>& a, const std::array<Number, 3>& b) {
  return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}
template <class Number>
std::array<Number, 3> cross(const std::array<Number, 3>& a, const std::array<Number, 3>& b) {
  return {a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]};
}
inline double length(const std::array<double, 3>& a) { return std::sqrt(dot(a, a)); }

/// Point p of an array with three coordinates each.
inline std::array<double, 3> pointAt(const std::vector<double>& positions, uint32_t p) {
  return {positions[3 * size_t(p)], positions[3 * size_t(p) + 1], positions[3 * size_t(p) + 2]};
}
/// Signed area of a triangle in a plane with the given normal, which needs no length of 1.
inline double areaAbout(const std::array<double, 3>& normal, const std::array<double, 3>& a, const std::array<double, 3>& b,
                        const std::array<double, 3>& c) {
  return 0.5 * dot(normal, cross(b - a, c - a)) / length(normal);
}
/// Signed area of a loop of such points.
inline double areaAbout(const std::array<double, 3>& normal, const std::vector<double>& positions, std::span<const uint32_t> loop) {
  double sum = 0;
  for (size_t i = 1; i + 1 < loop.size(); ++i)
    sum += areaAbout(normal, pointAt(positions, loop[0]), pointAt(positions, loop[i]), pointAt(positions, loop[i + 1]));
  return sum;
}

/// Group i of offsets + items.
inline std::span<const uint32_t> itemsOf(const std::vector<uint32_t>& offsets, const std::vector<uint32_t>& items, size_t i) {
  return {items.data() + offsets[i], offsets[i + 1] - offsets[i]};
}

}  // namespace vectors

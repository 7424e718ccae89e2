#include "io/print_number.h"

#include <cmath>
#include <cstdint>
#include <cstdlib>
#include <cstring>

#include "io/shortest_decimal.h"

namespace mandoline::detail {
namespace {

char* put(char* to, const char* text, int count) {
  std::memcpy(to, text, size_t(count));
  return to + count;
}

char* putZeros(char* to, int count) {
  std::memset(to, '0', size_t(count));
  return to + count;
}

/// The digits of a decimal as text.
struct Digits {
  explicit Digits(uint64_t digits) : count(int(std::to_chars(text, text + sizeof text, digits).ptr - text)) {}

  char text[20];
  int count;
};

char* putScientific(char* to, char* end, const Digits& digits, int exponent) {
  *to++ = digits.text[0];
  if (digits.count > 1) *to++ = '.';
  to = put(to, digits.text + 1, digits.count - 1);
  *to++ = 'e';
  *to++ = exponent < 0 ? '-' : '+';
  if (std::abs(exponent) < 10) *to++ = '0';
  return std::to_chars(to, end, std::abs(exponent)).ptr;
}

/// A whole number below 10^22 with all its digits, not only those of its shortest decimal, whose exponent is at most 5.
char* putWhole(char* to, char* end, const Decimal& decimal, double n) {
  constexpr int64_t kLowest = 10'000'000'000;  // the last ten digits are worked out, and may carry into the others
  constexpr double kTwoTo64 = 18446744073709551616.0;
  int64_t power = 1;
  for (int i = 0; i < decimal.exponent; ++i) power *= 10;
  // The number and the decimal differ by less than 2^63, so that their remainders by 2^64 tell how much.
  const uint64_t remainder = uint64_t(n - std::floor(n / kTwoTo64) * kTwoTo64);
  const int64_t difference = int64_t(remainder - decimal.digits * uint64_t(power));
  int64_t high = int64_t(decimal.digits) / (kLowest / power);
  int64_t low = int64_t(decimal.digits) % (kLowest / power) * power + difference;
  if (low < 0) --high, low += kLowest;
  if (low >= kLowest) ++high, low -= kLowest;
  if (high == 0) return std::to_chars(to, end, low).ptr;
  to = std::to_chars(to, end, high).ptr;
  const Digits digits{uint64_t(low)};
  return put(putZeros(to, 10 - digits.count), digits.text, digits.count);
}

char* putFixed(char* to, const Digits& digits, int point) {
  if (point <= 0) return put(putZeros(put(to, "0.", 2), -point), digits.text, digits.count);
  return put(put(put(to, digits.text, point), ".", 1), digits.text + point, digits.count - point);
}

}  // namespace

char* printShortest(char* begin, char* end, double n) {
  char* to = begin;
  if (std::signbit(n)) *to++ = '-';
  n = std::fabs(n);
  if (!std::isfinite(n)) return put(to, std::isnan(n) ? "nan" : "inf", 3);
  const Decimal decimal = shortestDecimal(n);
  const Digits digits(decimal.digits);
  const int point = digits.count + decimal.exponent;  // how many digits are before it
  const int scientific = digits.count + (digits.count > 1) + (std::abs(point - 1) < 100 ? 4 : 5);
  const int fixed = point <= 0 ? 2 - point + digits.count : point < digits.count ? digits.count + 1 : point;
  if (fixed > scientific) return putScientific(to, end, digits, point - 1);
  if (point < digits.count) return putFixed(to, digits, point);
  return putWhole(to, end, decimal, n);
}

}  // namespace mandoline::detail

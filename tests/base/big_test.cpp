// Exact numbers of any size against rational arithmetic, on numbers of all magnitudes that a double can have.
#include "base/big.h"

#include <cmath>
#include <limits>
#include <random>

#include "catch.h"
#include "rational.h"

using mandoline::detail::Big;

namespace {

/// Of any magnitude, few bits or all, often like another.
class Doubles {
 public:
  explicit Doubles(int largestExponent) : largest_(largestExponent) {}

  double next() {
    if (random_() % 8 == 0) return 0;
    if (random_() % 4 == 0) return random_() % 2 ? last_ : -last_;
    const uint64_t bits = random_() >> 11 >> random_() % 53 | 1;
    const int exponent = int(random_() % (2 * uint64_t(largest_))) - largest_;
    last_ = std::ldexp(random_() % 2 ? double(bits) : -double(bits), exponent - 52);
    return last_;
  }

 private:
  std::mt19937_64 random_{1};
  int largest_;
  double last_ = 1;
};

}  // namespace

TEST_CASE("Big: polynomials have the sign that rational numbers give", "[big]") {
  int signs[3] = {};
  for (const int largest : {8, 60, 1000}) {
    Doubles doubles(largest);
    for (int run = 0; run < 400; ++run) {
      double x[8];
      for (double& v : x) v = doubles.next();
      const auto polynomial = [&](auto number) {
        using Number = decltype(number);
        Number n[8];
        for (int i = 0; i < 8; ++i) n[i] = Number(x[i]);
        return (n[0] - n[1]) * (n[2] + n[3]) * n[4] - (n[2] - n[1]) * -n[5] * (n[6] + n[7]) + n[0] * n[0] * n[3];
      };
      const int sign = polynomial(Rational()).sign();
      REQUIRE(polynomial(Big()).sign() == sign);
      ++signs[sign + 1];
    }
  }
  for (const int count : signs) CHECK(count > 10);
}

TEST_CASE("Big: differences that cancel are 0", "[big]") {
  const double large = std::numeric_limits<double>::max(), least = std::numeric_limits<double>::denorm_min();
  CHECK((Big(large) - Big(large)).sign() == 0);
  CHECK(((Big(large) + Big(least)) - Big(large) - Big(least)).sign() == 0);
  CHECK(((Big(large) + Big(least)) - Big(large)).sign() == 1);
  CHECK(((Big(large) - Big(least)) - Big(large)).sign() == -1);
  CHECK((Big(least) * Big(least) * Big(least)).sign() == 1);
  CHECK((Big(-0.0)).sign() == 0);
  CHECK(((Big(least) * Big(large) - Big(large) * Big(least))).sign() == 0);
  CHECK(Big::difference(1, 1 + 0x1p-52).sign() == -1);
}

TEST_CASE("Big: scaling by powers of two shifts a quotient's exponent alone", "[big]") {
  Doubles doubles(60);
  for (int run = 0; run < 300; ++run) {
    const double a = doubles.next(), b = doubles.next(), c = doubles.next(), d = doubles.next();
    const Big numerator = Big(a) * Big(b) - Big(d), denominator = Big(c) * Big(c) * Big(b) + Big(a);
    const double q = Big::quotient(numerator, denominator);
    for (int shift = 1; shift <= 32; ++shift) {
      CAPTURE(a, b, c, d, shift);
      REQUIRE(Big::quotient(numerator * Big(std::ldexp(1, shift)), denominator) == std::ldexp(q, shift));
      REQUIRE(Big::quotient(numerator, denominator * Big(std::ldexp(1, shift))) == std::ldexp(q, -shift));
    }
  }
}

TEST_CASE("Big: quotients are right to four units in the last place", "[big]") {
  Doubles doubles(300);
  for (int run = 0; run < 2000; ++run) {
    const double a = doubles.next(), b = doubles.next(), c = doubles.next(), d = doubles.next();
    const Rational denominator = Rational(c) * Rational(c) + Rational(d), numerator = Rational(a) * Rational(b) - Rational(d);
    if (denominator.sign() == 0) continue;
    const double q = Big::quotient(Big(a) * Big(b) - Big(d), Big(c) * Big(c) + Big(d));
    if (!std::isfinite(q) || std::fabs(q) < std::numeric_limits<double>::min()) continue;
    const Rational error = abs(Rational(q) * denominator - numerator);
    REQUIRE(error <= Rational(4 * 0x1p-52) * abs(numerator));
  }
  CHECK(Big::quotient(Big(), Big(3)) == 0);
  CHECK(Big::quotient(Big(1), Big(-4)) == -0.25);
  CHECK(Big::quotient(Big(1e300) * Big(1e300), Big(1e300)) == Approx(1e300));
}

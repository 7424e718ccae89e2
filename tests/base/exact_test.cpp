// The number types that predicates are written for, and the orientation predicates, against rational arithmetic.
#include "base/exact.h"

#include "catch.h"
#include "rational.h"
#include "samples.h"

using namespace mandoline::detail;

namespace {

/// A unit in the last place of x, away from 0.
Rational ulp(double x) { return Rational(std::nextafter(std::fabs(x), INFINITY)) - Rational(std::fabs(x)); }

/// An expansion's value, by taking estimates off it until nothing is left.
Rational valueOf(Expansion e) {
  Rational sum;
  for (int i = 0; e.sign() != 0; ++i) {
    REQUIRE(i < 200);
    const double part = e.estimate();
    sum = sum + Rational(part);
    e = e - Expansion(part);
  }
  return sum;
}

/// One number in three arithmetics.
struct Value {
  Rational exact;
  Expansion expansion;
  Bounded bounded;
  int degree;

  static Value difference(double a, double b) {
    return {Rational(a) - Rational(b), Expansion::difference(a, b), Bounded::difference(a, b), 1};
  }
  friend Value operator+(const Value& a, const Value& b) {
    return {a.exact + b.exact, a.expansion + b.expansion, a.bounded + b.bounded, std::max(a.degree, b.degree)};
  }
  friend Value operator-(const Value& a, const Value& b) {
    return {a.exact - b.exact, a.expansion - b.expansion, a.bounded - b.bounded, std::max(a.degree, b.degree)};
  }
  friend Value operator*(const Value& a, const Value& b) {
    return {a.exact * b.exact, a.expansion * b.expansion, a.bounded * b.bounded, a.degree + b.degree};
  }
  Value operator-() const { return {-exact, -expansion, -bounded, degree}; }
};

constexpr int kLargestDegree = 7;

void check(const Value& v) {
  const double estimate = v.expansion.estimate();
  REQUIRE(v.expansion.sign() == v.exact.sign());
  REQUIRE(valueOf(v.expansion) == v.exact);
  REQUIRE(abs(Rational(estimate) - v.exact) <= ulp(estimate));
  REQUIRE(abs(Rational(v.bounded.value) - v.exact) <= Rational(v.bounded.error) * Rational(1 + 0x1p-30));
  if (v.bounded.certain()) REQUIRE(v.bounded.sign() == v.exact.sign());
}

/// Polynomials of degree up to 7: a random list of steps, each of which works on two results before it.
struct Polynomials {
  struct Step {
    uint64_t operation, a, b;
  };
  static constexpr size_t kLeaves = 4, kSteps = 12;
  std::vector<Step> steps;

  explicit Polynomials(Sampler& sampler) {
    for (size_t i = 0; i < kSteps; ++i) steps.push_back({sampler.below(5), sampler.below(kLeaves + i), sampler.below(kLeaves + i)});
  }
  std::vector<Value> at(const std::vector<double>& x) const {
    std::vector<Value> values;
    for (size_t i = 0; i < kLeaves; ++i) values.push_back(Value::difference(x[2 * i], x[2 * i + 1]));
    for (const Step& s : steps) {
      const Value &a = values[s.a], &b = values[s.b];
      values.push_back(s.operation == 0                                           ? a + b
                       : s.operation == 1 || a.degree + b.degree > kLargestDegree ? a - b
                       : s.operation == 2                                         ? -a
                                                                                  : a * b);
    }
    return values;
  }
};

int orient2d(const Point& a, const Point& b, const Point& c, int p, int q) {
  const auto minus = [](double x, double y) { return Rational(x) - Rational(y); };
  return (minus(b[p], a[p]) * minus(c[q], a[q]) - minus(b[q], a[q]) * minus(c[p], a[p])).sign();
}

int orient3d(const Point& a, const Point& b, const Point& c, const Point& d) {
  Rational x[3][3];
  for (int i = 0; i < 3; ++i) {
    x[0][i] = Rational(b[i]) - Rational(a[i]);
    x[1][i] = Rational(c[i]) - Rational(a[i]);
    x[2][i] = Rational(d[i]) - Rational(a[i]);
  }
  Rational det;
  for (int i = 0; i < 3; ++i) det = det + x[0][i] * (x[1][(i + 1) % 3] * x[2][(i + 2) % 3] - x[1][(i + 2) % 3] * x[2][(i + 1) % 3]);
  return det.sign();
}

}  // namespace

TEST_CASE("Rational numbers obey arithmetic", "[exact]") {
  CHECK(Rational(1) / Rational(3) + Rational(1) / Rational(6) == Rational(0.5));
  CHECK(Rational(0.1) * Rational(0x1p55) == Rational(3602879701896397.0));
  CHECK(Rational(0x1p-1074) * Rational(0x1p1000) * Rational(0x1p74) == Rational(1));
  CHECK(Rational(1) / Rational(-3) < Rational(-0.333));
  CHECK(Rational(1) / Rational(-3) > Rational(-0.334));
  CHECK(Rational(0x1p200) - Rational(1) < Rational(0x1p200));
  CHECK((Rational(0x1p200) - Rational(1)) / (Rational(0x1p100) - Rational(1)) == Rational(0x1p100) + Rational(1));
  CHECK((Rational(0.1) - Rational(0.1)).sign() == 0);
  CHECK(-Rational(0) == Rational(0));
  Sampler sampler(Kind::wide);
  for (int i = 0; i < 500; ++i) {
    const double x = sampler.coordinate(), y = sampler.coordinate();
    const Rational a(x), b(y), c = a / b;
    CHECK((a < b) == (x < y));
    CHECK((a == b) == (x == y));
    CHECK(c * b == a);
    CHECK((a + c) * (a - c) == a * a - c * c);
    CHECK((a + b) - b == a);
    CHECK(abs(Rational(x * y) - a * b) <= abs(a * b) * Rational(kRoundoff));
    CHECK(abs(Rational(x + y) - (a + b)) <= abs(a + b) * Rational(kRoundoff));
    const int64_t m = int64_t(sampler.below(uint64_t(1) << 62)) - (int64_t(1) << 61), n = int64_t(sampler.below(uint64_t(1) << 40)) + 1;
    CHECK(BigInt(m) * BigInt(n) + BigInt(m % 1000) - BigInt(m) * BigInt(n - 1) == BigInt(m + m % 1000));
    CHECK(BigInt(m).shiftedUp(77).shiftedDown(70) == BigInt(m) * BigInt(128));
  }
}

TEST_CASE("Expansions are exact and bounds hold", "[exact]") {
  for (const Kind kind : kKinds) {
    Sampler sampler(kind);
    size_t uncertain = 0;
    for (int repeat = 0; repeat < 150; ++repeat) {
      const Polynomials polynomials(sampler);
      std::vector<double> x, nudged;
      for (size_t i = 0; i < 2 * Polynomials::kLeaves; ++i) {
        x.push_back(i > 0 && sampler.oneIn(3) ? sampler.nudged(x[sampler.below(i)]) : sampler.coordinate());  // small differences
        nudged.push_back(sampler.nudged(x.back()));
      }
      const std::vector<Value> values = polynomials.at(x), close = polynomials.at(nudged);
      for (size_t i = 0; i < values.size(); ++i) {
        check(values[i]);
        const Value cancelled = values[i] - close[i];
        check(cancelled);
        const Value& other = values[sampler.below(values.size())];
        if (cancelled.degree + other.degree <= kLargestDegree) check(cancelled * other);
        uncertain += !cancelled.bounded.certain();
      }
    }
    CHECK(uncertain > 0);
  }
}

TEST_CASE("Expansions and bounds where everything cancels", "[exact]") {
  for (const Kind kind : kKinds) {
    Sampler sampler(kind);
    for (int repeat = 0; repeat < 100; ++repeat) {
      const double x = sampler.coordinate();
      const Value a = Value::difference(x, sampler.coordinate()), b = Value::difference(sampler.coordinate(), sampler.coordinate());
      check((a + b) * (a - b) - (a * a - b * b));
      check((a + b) * (a + b) * (a + b) - (a * a * a + b * b * b) - a * b * (a + b) - a * b * (a + b) - a * b * (a + b));
      const Value tiny = Value::difference(x, Sampler::kFlushBelow) - Value::difference(x, 0);  // its double may well be 0
      check(tiny);
      check(tiny * tiny);
      check(tiny * (a - tiny) - a * tiny);
      check(tiny * tiny * tiny * tiny * tiny * tiny * tiny);
    }
  }
}

TEST_CASE("Sums of seven factors stay in range at both ends", "[exact]") {
  for (const double largest : {std::nextafter(Sampler::kLimit, 0.0), -std::nextafter(Sampler::kLimit, 0.0)}) {
    Value product = Value::difference(largest, -largest);
    for (int i = 1; i < kLargestDegree; ++i)
      product = product * Value::difference(largest, i % 2 ? -largest : std::nextafter(-largest, 0.0));
    Value sum = product;
    for (int i = 0; i < 5; ++i) sum = sum + product;  // the six terms of a determinant
    check(sum);
    CHECK(std::isfinite(sum.bounded.error));
  }
  const double smallest = Sampler::kFlushBelow, next = std::nextafter(smallest, 1.0);
  Value product = Value::difference(next, smallest);
  for (int i = 1; i < kLargestDegree; ++i) product = product * Value::difference(next, smallest);
  check(product);
  CHECK(product.bounded.sign() == 1);
  check(product - product);
  check(product * Value{Rational(3), Expansion(3), Bounded(3), 0} - product);
}

TEST_CASE("Quotients of expansions are within a unit in the last place", "[exact]") {
  for (const Kind kind : kKinds) {
    Sampler sampler(kind);
    for (int repeat = 0; repeat < 300; ++repeat) {
      const double x = sampler.coordinate(), y = sampler.nudged(x);
      const auto factor = [&] {
        return Value::difference(sampler.oneIn(2) ? x : sampler.coordinate(), sampler.oneIn(2) ? y : sampler.coordinate());
      };
      const Value numerator = factor() * factor() * factor() - factor() * factor() * factor(),
                  denominator = factor() * factor() - factor() * factor();
      if (denominator.exact.sign() == 0) continue;
      const double quotient = Expansion::quotient(numerator.expansion, denominator.expansion);
      CHECK(abs(Rational(quotient) - numerator.exact / denominator.exact) <= ulp(quotient));
    }
  }
}

TEST_CASE("orient2d is exact", "[exact]") {
  for (const Kind kind : kKinds) {
    Sampler sampler(kind);
    Predicates predicates;
    int counts[3] = {};
    for (int repeat = 0; repeat < 5000; ++repeat) {
      const Point a = sampler.point(), b = sampler.oneIn(20) ? a : sampler.point();
      const Point c = sampler.oneIn(20) ? b : sampler.oneIn(3) ? sampler.point() : sampler.nudged(sampler.onLine(a, b));
      const int sign = predicates.orient2d({a[0], a[1]}, {b[0], b[1]}, {c[0], c[1]});
      REQUIRE(sign == orient2d(a, b, c, 0, 1));
      ++counts[sign + 1];
    }
    for (const int count : counts) CHECK(count > 50);
    CHECK(predicates.fallbacks > 50);
  }
}

TEST_CASE("orient3d is exact", "[exact]") {
  for (const Kind kind : kKinds) {
    Sampler sampler(kind);
    Predicates predicates;
    int counts[3] = {};
    for (int repeat = 0; repeat < 5000; ++repeat) {
      const Point a = sampler.point(), b = sampler.oneIn(20) ? a : sampler.point();
      const Point c = sampler.oneIn(10) ? sampler.nudged(sampler.onLine(a, b)) : sampler.point();
      const Point d = sampler.oneIn(20) ? b : sampler.oneIn(4) ? sampler.point() : sampler.nudged(sampler.onPlane(a, b, c));
      const int sign = predicates.orient3d(a.data(), b.data(), c.data(), d.data());
      REQUIRE(sign == orient3d(a, b, c, d));
      ++counts[sign + 1];
    }
    for (const int count : counts) CHECK(count > 50);
    CHECK(predicates.fallbacks > 50);
  }
}

TEST_CASE("Doubles decide the easy cases, and only the others are counted", "[exact]") {
  Sampler sampler(Kind::random);
  Predicates predicates;
  for (int repeat = 0; repeat < 1000; ++repeat) {
    const Point a = sampler.point(), b = sampler.point(), c = sampler.point(), d = sampler.point();
    predicates.orient2d({a[0], a[1]}, {b[0], b[1]}, {c[0], c[1]});
    predicates.orient3d(a.data(), b.data(), c.data(), d.data());
    predicates.sign([&](auto number) { return decltype(number)::difference(a[0], b[0]) * decltype(number)::difference(c[0], d[0]); });
  }
  CHECK(predicates.fallbacks == 0);
  predicates.orient2d({0.1, 0.1}, {0.2, 0.2}, {0.7, 0.7});
  CHECK(predicates.fallbacks == 1);
  predicates.sign([](auto number) {
    using Number = decltype(number);
    return Number(0.1) * Number(0.1) - Number(0.1) * Number(0.1);
  });
  CHECK(predicates.fallbacks == 2);
}

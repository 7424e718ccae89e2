// Numbers in text: read as strtod reads them, written as std::to_chars writes them.
#include <charconv>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <limits>
#include <random>
#include <string>
#include <version>

#include "catch.h"
#include "io/print_number.h"
#include "mesh/read/parse_number.h"

namespace {

using mandoline::detail::parseNumber;
using mandoline::detail::printShortest;
using Random = std::mt19937_64;

uint64_t bitsOf(double x) {
  uint64_t bits;
  std::memcpy(&bits, &x, sizeof x);
  return bits;
}

double doubleOf(uint64_t bits) {
  double x;
  std::memcpy(&x, &bits, sizeof x);
  return x;
}

uint64_t below(Random& random, uint64_t n) { return random() % n; }

/// Of any exponent, denormal ones and infinity included.
double randomDouble(Random& random) {
  const uint64_t bits = random() & ~(uint64_t(1) << 63);
  const double x = doubleOf(below(random, 8) == 0 ? bits >> (11 + below(random, 53)) : bits);
  return std::isnan(x) ? std::numeric_limits<double>::infinity() : x;
}

std::string randomDigits(Random& random, size_t count) {
  std::string digits;
  for (size_t i = 0; i < count; ++i) digits += char('0' + below(random, 10));
  return digits;
}

/// Digits with a point anywhere or none, and mostly an exponent.
std::string randomDecimal(Random& random) {
  std::string text = randomDigits(random, 1 + below(random, below(random, 10) == 0 ? 60 : 20));
  if (below(random, 4) != 0) text.insert(below(random, text.size() + 1), 1, '.');
  if (below(random, 10) == 0) text.insert(0, below(random, 400), '0');
  if (below(random, 10) == 0) text.append(below(random, 400), '0');
  if (below(random, 3) == 0) return text;
  text += "eE"[below(random, 2)];
  if (const uint64_t sign = below(random, 3); sign > 0) text += "+-"[sign - 1];
  text += std::to_string(below(random, below(random, 50) == 0 ? 1'000'000 : below(random, 3) == 0 ? 345 : 30));
  return text;
}

std::string printed(const char* format, int precision, auto x) {
  char text[1200];
  const int size = std::snprintf(text, sizeof text, format, precision, x);
  return std::string(text, size_t(size));
}

/// Exactly halfway between two neighbours, or away from there by one digit that comes late.
std::string nearHalfway(Random& random) {
  static_assert(std::numeric_limits<long double>::digits > 53, "the place halfway has a bit more than doubles");
  double low = randomDouble(random);
  if (std::isinf(low)) low = std::numeric_limits<double>::max();
  const double high = std::nextafter(low, HUGE_VAL);
  const long double halfway = std::isinf(high) ? low + ((long double)low - std::nextafter(low, 0)) / 2 : ((long double)low + high) / 2;
  std::string text = printed("%.*Le", 767, halfway);
  const size_t exponent = text.find('e');
  const size_t last = text.find_last_not_of('0', exponent - 1);
  if (below(random, 3) == 0) return text;
  if (below(random, 2) == 0) {
    text.insert(exponent, 1, '1');
    return text.insert(exponent, below(random, 200), '0');
  }
  if (text[last] > '0') --text[last];
  return text;
}

/// Negative or not; many are hard to round.
std::string randomNumber(Random& random) {
  const std::string sign(below(random, 4) == 0, '-');
  const uint64_t way = below(random, 10);
  const int digits = int(below(random, 30));
  switch (way) {
    case 0:
      return sign + nearHalfway(random);
    case 1:
      return sign + printed("%.*e", digits, randomDouble(random));
    case 2:
      return sign + printed("%.*g", 17, randomDouble(random));
    case 3:
      return sign + printed("%.*f", digits, std::ldexp(double(random()), digits - 40));
    default:
      return sign + randomDecimal(random);
  }
}

/// A hash of what was read, by which WebAssembly is held to native code: its C library rounds some of these strings wrongly.
uint64_t requireReadAsByStrtod(uint64_t count) {
  Random random(1);
  uint64_t hash = 0;
  for (uint64_t i = 0; i < count; ++i) {
    const std::string text = randomNumber(random);
    double value = -1;
    const char* end = parseNumber(text.data(), text.data() + text.size(), value);
    hash = (hash ^ bitsOf(value)) * 0x9e3779b97f4a7c15;
    hash ^= hash >> 32;
    if (end != text.data() + text.size()) FAIL(text << " is not read to its end");
#ifndef __EMSCRIPTEN__
    const double expected = std::strtod(text.c_str(), nullptr);
    if (bitsOf(value) != bitsOf(expected))
      FAIL(text << " is read as " << printed("%.*g", 17, value) << ", not " << printed("%.*g", 17, expected));
#endif
  }
  return hash;
}

std::string shortest(double x) {
  char text[32];
  return std::string(text, printShortest(text, text + sizeof text, x));
}

/// With few digits or many, and an exponent from `least` on.
double decimal(Random& random, uint64_t exponents, int least) {
  const std::string text = randomDigits(random, 1 + below(random, 17)) + 'e' + std::to_string(int(below(random, exponents)) + least);
  return std::strtod(text.c_str(), nullptr);
}

/// Also whole ones, ones with few digits or few bits, and powers of two, whose neighbours are not equally far.
double randomPrinted(Random& random) {
  switch (below(random, 6)) {
    case 0:
      return double(int64_t(random()) >> below(random, 64));
    case 1:
      return doubleOf(random() >> 52 << 52);
    case 2:
      return double(random()) * double(uint64_t(1) << below(random, 12));
    case 3:
      return decimal(random, 40, -30);
    case 4:
      return decimal(random, 650, -340);
    default:
      return doubleOf(random());
  }
}

void requirePrintedAsByToChars(uint64_t count) {
  Random random(2);
  for (uint64_t i = 0; i < count; ++i) {
    const double x = randomPrinted(random);
    const std::string text = shortest(x);
#ifdef __cpp_lib_to_chars
    char expected[32];
    const std::string_view expectedText(expected, size_t(std::to_chars(expected, expected + sizeof expected, x).ptr - expected));
    if (text != expectedText) REQUIRE(text == expectedText);
#endif
    const double back = std::strtod(text.c_str(), nullptr);
    if (!std::isnan(x) && bitsOf(back) != bitsOf(x)) FAIL(text << " is not " << printed("%.*g", 17, x));
  }
}

/// How many characters of the text are a number.
int64_t taken(const std::string& text) {
  double value = 0;
  return parseNumber(text.data(), text.data() + text.size(), value) - text.data();
}

}  // namespace

TEST_CASE("Random and hard decimals are read as by strtod", "[numbers]") { CHECK(requireReadAsByStrtod(100'000) == 0xdd4a45d335b86831); }
TEST_CASE("Ten million random and hard decimals are read as by strtod", "[.tenmillion]") { requireReadAsByStrtod(10'000'000); }

TEST_CASE("Doubles are written as by std::to_chars, and read back", "[numbers]") { requirePrintedAsByToChars(300'000); }
TEST_CASE("Ten million doubles are written as by std::to_chars, and read back", "[.tenmillion]") { requirePrintedAsByToChars(10'000'000); }

TEST_CASE("What is a number, and where it ends", "[numbers]") {
  for (const char* whole : {"0", "-0", "5.", ".5", "-.5e-3", "1E+5", "007", "inf", "-inf", "INF", "Infinity", "nan", "-NaN", "1e99999"}) {
    CAPTURE(whole);
    CHECK(taken(whole) == int64_t(std::strlen(whole)));
  }
  for (const char* none : {"", ".", "-", "+1", "--1", "e5", ".e5", "x", "-x", "in"}) {
    CAPTURE(none);
    CHECK(taken(none) == 0);
  }
  CHECK(taken("1e") == 1);
  CHECK(taken("1e+") == 1);
  CHECK(taken("0x10") == 1);
  CHECK(taken("1.5.2") == 3);
  CHECK(taken("1,5") == 1);
  CHECK(taken("2/3") == 1);
}

TEST_CASE("Decimals that no double is near are infinite or 0", "[numbers]") {
  const auto read = [](const std::string& text) {
    double value = -1;
    parseNumber(text.data(), text.data() + text.size(), value);
    return bitsOf(value);
  };
  CHECK(read("1e309") == bitsOf(HUGE_VAL));
  CHECK(read("-1" + std::string(400, '0')) == bitsOf(-HUGE_VAL));
  CHECK(read("1e-400") == bitsOf(0.0));
  CHECK(read("-0." + std::string(400, '0') + "1") == bitsOf(-0.0));
  CHECK(read("0." + std::string(400, '0') + "1e401") == bitsOf(1.0));
  CHECK(read("0e999999999999999999999") == bitsOf(0.0));
}

TEST_CASE("Doubles as text: fixed or scientific, whichever is shorter", "[numbers]") {
  const std::pair<double, const char*> cases[] = {
      {0.0, "0"},
      {-0.0, "-0"},
      {1, "1"},
      {-2.5, "-2.5"},
      {10000, "10000"},
      {100000, "1e+05"},
      {120000, "120000"},
      {0.001, "0.001"},
      {0.0001, "1e-04"},
      {0.00012, "0.00012"},
      {0.00001, "1e-05"},
      {0.00012345, "0.00012345"},
      {1e100, "1e+100"},
      {1.5e-300, "1.5e-300"},
      {5e-324, "5e-324"},
      {std::numeric_limits<double>::max(), "1.7976931348623157e+308"},
      {std::numeric_limits<double>::min(), "2.2250738585072014e-308"},
      {9007199254740993, "9007199254740992"},
      {1234567890123456789, "1234567890123456768"},
      {18446744073709551616.0, "18446744073709551616"},
      {1e22, "1e+22"},
      {1.2345678901234567e21, "1234567890123456774144"},
      {HUGE_VAL, "inf"},
      {-HUGE_VAL, "-inf"},
      {std::numeric_limits<double>::quiet_NaN(), "nan"},
  };
  for (const auto& [x, text] : cases) CHECK(shortest(x) == text);
}

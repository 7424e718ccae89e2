#include "mesh/read/text_cursor.h"

#include <algorithm>
#include <cctype>
#include <charconv>
#include <cmath>
#include <cstdlib>
#include <system_error>

namespace mandoline::detail {
namespace {

#if defined(_LIBCPP_VERSION) && _LIBCPP_VERSION < 200000  // where std::from_chars lacks doubles
std::from_chars_result parse(const char* first, const char* last, double& value) {
  const auto belongs = [](unsigned char c) { return std::isalnum(c) || c == '+' || c == '-' || c == '.'; };
  const std::string text(first, std::find_if_not(first, last, belongs));  // strtod looks for its end, and takes more
  const bool number = text.find_first_of("0123456789.inIN") == (text[0] == '-') && text.find_first_of("xX") == std::string::npos;
  char* end = nullptr;
  const double parsed = number ? std::strtod(text.c_str(), &end) : 0;
  if (!number || end == text.c_str()) return {first, std::errc::invalid_argument};
  value = parsed;
  return {first + (end - text.c_str()), std::errc()};
}
#else
/// A number that no double holds: nearly 0, or infinite.
double outOfRange(const char* first, const char* last) {
  long double value = 0;
  if (std::from_chars(first, last, value).ec == std::errc()) return double(value);
  const std::string_view digits(first, size_t(last - first));
  const size_t exponent = digits.find_first_of("eE");
  const bool tiny = exponent != std::string_view::npos && digits.substr(exponent + 1, 1) == "-";
  const double magnitude = tiny ? 0.0 : HUGE_VAL;
  return digits[0] == '-' ? -magnitude : magnitude;
}

std::from_chars_result parse(const char* first, const char* last, double& value) {
  const std::from_chars_result result = std::from_chars(first, last, value);
  if (result.ec != std::errc::result_out_of_range) return result;
  value = outOfRange(first, result.ptr);
  return {result.ptr, std::errc()};
}
#endif

}  // namespace

TextCursor::TextCursor(std::string path, std::string_view text)
    : path_(std::move(path)), position_(text.data()), end_(text.data() + text.size()) {
  if (text.substr(0, 3) == "\xef\xbb\xbf") position_ += 3;  // byte order mark
}

bool TextCursor::skipContinuation() {
  const char* p = position_ + 1;
  if (p != end_ && *p == '\r') ++p;
  if (p != end_ && *p == '\n') ++p;
  if (p == position_ + 1) return false;
  position_ = p;
  ++line_;
  return true;
}

bool TextCursor::moreOnLine() {
  for (; position_ != end_; ++position_) {
    while (position_ != end_ && *position_ == '\\' && skipContinuation()) {
    }
    if (position_ == end_ || *position_ == '\n' || *position_ == '\r' || *position_ == '#') return false;
    if (!isWordEnd(position_)) return true;
  }
  return false;
}

bool TextCursor::more() {
  while (!moreOnLine()) {
    if (position_ == end_) return false;
    nextLine();
  }
  return true;
}

void TextCursor::nextLine() {
  while (position_ != end_ && *position_ != '\n' && *position_ != '\r') ++position_;
  if (position_ == end_) return;
  if (*position_++ == '\r' && position_ != end_ && *position_ == '\n') ++position_;
  ++line_;
}

std::string_view TextCursor::word(const char* expected) {
  requireWord(expected);
  const char* begin = position_;
  while (!isWordEnd(position_)) ++position_;
  return {begin, size_t(position_ - begin)};
}

double TextCursor::number() {
  requireWord("a number");
  const char* begin = position_;
  if (*begin == '+' && begin + 1 != end_ && begin[1] != '-') ++begin;
  double value = 0;
  const auto [last, error] = parse(begin, end_, value);
  if (error != std::errc() || !isWordEnd(last)) failExpected("a number", position_);
  position_ = last;
  return value;
}

int64_t TextCursor::integer() {
  const char* begin = position_;
  const int64_t value = leadingInteger();
  if (!atWordEnd()) {
    position_ = begin;
    moreOnLine();
    failExpected("a whole number", position_);
  }
  return value;
}

int64_t TextCursor::leadingInteger() {
  requireWord("a whole number");
  const char* begin = position_;
  if (*begin == '+' && begin + 1 != end_ && begin[1] != '-') ++begin;
  int64_t value = 0;
  const auto [last, error] = std::from_chars(begin, end_, value);
  if (error != std::errc()) failExpected("a whole number", position_);
  position_ = last;
  return value;
}

void TextCursor::requireWordEnd(const char* expected) {
  if (!atWordEnd()) failExpected(expected, position_);
}

void TextCursor::requireLineEnd() {
  if (moreOnLine()) failExpected("the end of the line", position_);
}

std::string_view TextCursor::restOfLine() {
  const char* begin = position_;
  while (position_ != end_ && *position_ != '\n' && *position_ != '\r') ++position_;
  const auto isBlank = [](char c) { return c == ' ' || c == '\t' || c == '\v' || c == '\f'; };
  const char* last = position_;
  while (begin != last && isBlank(*begin)) ++begin;
  while (last != begin && isBlank(last[-1])) --last;
  return {begin, size_t(last - begin)};
}

void TextCursor::requireWord(const char* expected) {
  if (!moreOnLine()) failExpected(expected, position_);
}

void TextCursor::failExpected(const char* expected, const char* wordBegin) const {
  std::string found;
  for (const char* p = wordBegin; !isWordEnd(p); ++p) {
    if (found.size() == 24) {
      found += "...";
      break;
    }
    found += *p >= ' ' && *p <= '~' ? *p : '?';
  }
  if (!found.empty()) {
    found = "'" + found + "'";
  } else {
    found = wordBegin == end_ ? "the end of the file" : "the end of the line";
  }
  fail(std::string("expected ") + expected + ", found " + found);
}

void TextCursor::failAt(size_t line, const std::string& message) const {
  throw FileError(path_ + ": line " + std::to_string(line) + ": " + message);
}

std::string lowerCase(std::string_view word) {
  std::string lower(word);
  for (char& c : lower) {
    if (c >= 'A' && c <= 'Z') c = char(c - 'A' + 'a');
  }
  return lower;
}

}  // namespace mandoline::detail

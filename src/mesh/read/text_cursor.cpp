#include "mesh/read/text_cursor.h"

#include <charconv>
#include <system_error>

#include "mesh/read/parse_number.h"

namespace mandoline::detail {

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
  const char* last = parseNumber(begin, end_, value);
  if (last == begin || !isWordEnd(last)) failExpected("a number", position_);
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

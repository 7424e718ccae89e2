// Walks through a text file word by word and knows the line it is on.
#pragma once

#include <cstdint>
#include <string>
#include <string_view>

#include "mandoline/mesh_files.h"

namespace mandoline::detail {

/// Lines end with LF, CR LF or CR. '#' begins a comment; a backslash at the end of a line continues it.
class TextCursor {
 public:
  TextCursor(std::string path, std::string_view text);

  /// Whether there is a word left on this line; if so, stands on it.
  bool moreOnLine();
  /// Whether there is a word left in the file; if so, stands on it. Skips comments and empty lines.
  bool more();
  /// Goes to the beginning of the next line.
  void nextLine();

  // These take the next word of this line and fail if there is none or it is of another kind.
  std::string_view word(const char* expected);
  double number();
  int64_t integer();
  /// An integer that need not end the word.
  int64_t leadingInteger();
  /// Whether the character is the very next.
  bool at(char c) const { return position_ != end_ && *position_ == c; }
  /// Goes past the character if it is the very next.
  bool skip(char c) {
    if (!at(c)) return false;
    ++position_;
    return true;
  }
  bool atWordEnd() const { return isWordEnd(position_); }
  void requireWordEnd(const char* expected);
  /// The rest of the line without the blanks around it; '#' is a character of it like others.
  std::string_view restOfLine();

  size_t line() const { return line_; }
  size_t remaining() const { return size_t(end_ - position_); }
  const char* position() const { return position_; }

  [[noreturn]] void fail(const std::string& message) const { failAt(line_, message); }
  [[noreturn]] void failAt(size_t line, const std::string& message) const;

 private:
  bool isWordEnd(const char* p) const { return p == end_ || *p == ' ' || (*p >= '\t' && *p <= '\r') || *p == '#'; }
  bool skipContinuation();
  void requireWord(const char* expected);
  [[noreturn]] void failExpected(const char* expected, const char* wordBegin) const;

  std::string path_;
  const char *position_, *end_;
  size_t line_ = 1;
};

/// The word in small letters.
std::string lowerCase(std::string_view word);

}  // namespace mandoline::detail

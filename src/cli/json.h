// JSON text for reports.
#pragma once

#include <charconv>
#include <cmath>
#include <optional>
#include <string>
#include <string_view>
#include <type_traits>

namespace mandoline::cli {

/// Built front to back. The two outer levels are broken into lines, what is deeper stays on its line.
class Json {
 public:
  Json& open(char bracket) {
    beginItem();
    text_ += bracket;
    ++depth_;
    first_ = true;
    return *this;
  }
  Json& close(char bracket) {
    --depth_;
    if (!first_ && depth_ < kLineDepth) breakLine();
    text_ += bracket;
    first_ = false;
    return *this;
  }
  Json& key(std::string_view name) {
    beginItem();
    quote(name);
    text_ += ": ";
    afterKey_ = true;
    return *this;
  }
  Json& null() {
    beginItem();
    text_ += "null";
    return *this;
  }
  Json& value(std::string_view s) {
    beginItem();
    quote(s);
    return *this;
  }
  Json& value(bool b) {
    beginItem();
    text_ += b ? "true" : "false";
    return *this;
  }
  Json& value(const char* s) { return value(std::string_view(s)); }
  /// Numbers that JSON can't hold become null.
  template <class Number>
  std::enable_if_t<std::is_arithmetic_v<Number>, Json&> value(Number n) {
    if constexpr (std::is_floating_point_v<Number>) {
      if (!std::isfinite(n)) return null();
    }
    beginItem();
    char digits[32];
    text_.append(digits, std::to_chars(digits, digits + sizeof digits, n).ptr);
    return *this;
  }
  template <class Value>
  Json& value(const std::optional<Value>& v) {
    return v ? value(*v) : null();
  }
  template <class Array>
  Json& values(const Array& array) {
    open('[');
    for (const auto& item : array) value(item);
    return close(']');
  }
  template <class Value>
  Json& member(std::string_view name, const Value& v) {
    return key(name).value(v);
  }
  /// The number of an element, or null if it is negative.
  Json& element(std::string_view name, int64_t number) { return number < 0 ? key(name).null() : member(name, number); }
  std::string text() const { return text_ + "\n"; }

 private:
  static constexpr int kLineDepth = 2;

  void beginItem() {
    if (afterKey_) {
      afterKey_ = false;
      first_ = false;
      return;
    }
    if (!first_) text_ += depth_ <= kLineDepth ? "," : ", ";
    if (depth_ > 0 && depth_ <= kLineDepth) breakLine();
    first_ = false;
  }
  void breakLine() {
    text_ += '\n';
    text_.append(size_t(2 * depth_), ' ');
  }
  void quote(std::string_view s) {
    constexpr const char* kHex = "0123456789abcdef";
    text_ += '"';
    for (const char c : s) {
      if (c == '"' || c == '\\') {
        text_ += '\\';
        text_ += c;
      } else if (c >= 0 && c < ' ') {
        text_ += "\\u00";
        text_ += kHex[c >> 4];
        text_ += kHex[c & 15];
      } else {
        text_ += c;
      }
    }
    text_ += '"';
  }

  std::string text_;
  int depth_ = 0;
  bool first_ = true, afterKey_ = false;
};

}  // namespace mandoline::cli

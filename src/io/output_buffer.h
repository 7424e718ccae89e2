// Text for a stream, gathered in a large buffer.
#pragma once

#include <charconv>
#include <ostream>
#include <string_view>
#include <vector>

namespace mandoline::detail {

/// Whoever uses it calls flush() at the end. Errors are left to the stream's state.
class OutputBuffer {
 public:
  explicit OutputBuffer(std::ostream& out) : out_(out), buffer_(size_t(1) << 18) {}

  void text(std::string_view s) {
    if (s.size() > buffer_.size() - size_) flush();
    if (s.size() > buffer_.size()) {
      out_.write(s.data(), std::streamsize(s.size()));
      return;
    }
    s.copy(buffer_.data() + size_, s.size());
    size_ += s.size();
  }
  void character(char c) { text({&c, 1}); }
  /// Doubles read back identically, from as few digits as possible.
  template <class Number>
  void number(Number n) {
    constexpr size_t kLongest = 32;
    if (kLongest > buffer_.size() - size_) flush();
    size_ = size_t(std::to_chars(buffer_.data() + size_, buffer_.data() + buffer_.size(), n).ptr - buffer_.data());
  }
  void flush() {
    out_.write(buffer_.data(), std::streamsize(size_));
    size_ = 0;
  }

 private:
  std::ostream& out_;
  std::vector<char> buffer_;
  size_t size_ = 0;
};

}  // namespace mandoline::detail

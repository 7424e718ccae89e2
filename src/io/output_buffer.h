// Text for a sink, gathered in a large buffer.
#pragma once

#include <string_view>
#include <vector>

#include "io/print_number.h"
#include "mandoline/io.h"

namespace mandoline::detail {

/// Whoever uses it calls flush() at the end.
class OutputBuffer {
 public:
  explicit OutputBuffer(const Sink& out) : out_(out), buffer_(size_t(1) << 18) {}

  void text(std::string_view s) {
    if (s.size() > buffer_.size() - size_) flush();
    if (s.size() > buffer_.size()) {
      out_(s);
      return;
    }
    s.copy(buffer_.data() + size_, s.size());
    size_ += s.size();
  }
  void character(char c) { text({&c, 1}); }
  template <class Number>
  void number(Number n) {
    constexpr size_t kLongest = 32;
    if (kLongest > buffer_.size() - size_) flush();
    size_ = size_t(printNumber(buffer_.data() + size_, buffer_.data() + buffer_.size(), n) - buffer_.data());
  }
  void flush() {
    out_({buffer_.data(), size_});
    size_ = 0;
  }

 private:
  const Sink& out_;
  std::vector<char> buffer_;
  size_t size_ = 0;
};

}  // namespace mandoline::detail

// Text for a file, gathered in a large buffer.
#pragma once

#include <string_view>
#include <vector>

#include "io/meter.h"
#include "io/print_number.h"

namespace mandoline::detail {

/// flush() has to be called at the end.
class OutputBuffer {
 public:
  explicit OutputBuffer(Meter& meter) : meter_(meter), buffer_(size_t(1) << 18) {}

  void text(std::string_view s) {
    if (s.size() > buffer_.size() - size_) flush();
    if (s.size() > buffer_.size()) {
      meter_.write(s);
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
  /// Reports that items of the work are done.
  void advance(uint64_t items = 1) { meter_.advance(items); }
  void flush() {
    meter_.write({buffer_.data(), size_});
    size_ = 0;
  }

 private:
  Meter& meter_;
  std::vector<char> buffer_;
  size_t size_ = 0;
};

}  // namespace mandoline::detail

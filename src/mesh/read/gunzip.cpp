// Gzipped files, unpacked by zlib where there is one.
#include "mesh/read/readers.h"

#ifdef MANDOLINE_HAVE_ZLIB
#include <zlib.h>

#include <algorithm>
#include <cstdint>
#include <new>

#include "mesh/read/scalar.h"

namespace mandoline::detail {
namespace {

class Inflater {
 public:
  explicit Inflater(const FileBytes& file) : path_(file.path), packed_(file.bytes) {}
  ~Inflater() { inflateEnd(&stream_); }
  Inflater(const Inflater&) = delete;
  Inflater& operator=(const Inflater&) = delete;

  std::string inflateAll() {
    constexpr int kGzipOnly = 16 + MAX_WBITS;
    if (inflateInit2(&stream_, kGzipOnly) != Z_OK) throw FileError(path_ + ": zlib can't be started");
    bytes_.resize(likelySize());
    do {  // gzip files may be concatenated; anything else after the end is padding
      inflateMember();
      inflateReset(&stream_);
    } while (isGzipped(packed_.substr(consumed_)));
    bytes_.resize(made_);
    return std::move(bytes_);
  }

 private:
  /// The last four bytes tell the size, but can't be trusted: deflate packs at most 1032 to 1.
  size_t likelySize() const {
    if (packed_.size() < 18) return 64;
    const size_t told = loadScalar<uint32_t>(packed_.data() + packed_.size() - 4, ByteOrder::little);
    return std::min(told, 1032 * packed_.size()) + 1;
  }

  void inflateMember() {
    constexpr size_t kLargestStep = size_t(1) << 30;  // zlib counts in 32 bits
    for (;;) {
      if (made_ == bytes_.size()) bytes_.resize(2 * bytes_.size());
      const size_t room = std::min(bytes_.size() - made_, kLargestStep), left = std::min(packed_.size() - consumed_, kLargestStep);
      stream_.next_in = reinterpret_cast<Bytef*>(const_cast<char*>(packed_.data() + consumed_));
      stream_.avail_in = uInt(left);
      stream_.next_out = reinterpret_cast<Bytef*>(bytes_.data() + made_);
      stream_.avail_out = uInt(room);
      const int status = inflate(&stream_, Z_NO_FLUSH);
      consumed_ += left - stream_.avail_in;
      made_ += room - stream_.avail_out;
      if (status == Z_STREAM_END) return;
      if (status == Z_MEM_ERROR) throw std::bad_alloc();
      if (status == Z_BUF_ERROR || (status == Z_OK && consumed_ == packed_.size() && stream_.avail_out > 0))
        fail("the gzip data end early");
      if (status != Z_OK) fail(std::string("damaged gzip data") + (stream_.msg ? std::string(" (") + stream_.msg + ")" : ""));
    }
  }

  [[noreturn]] void fail(const std::string& message) const {
    throw FileError(path_ + ": byte " + std::to_string(consumed_) + ": " + message);
  }

  const std::string& path_;
  const std::string_view packed_;
  std::string bytes_;
  size_t consumed_ = 0, made_ = 0;
  z_stream stream_{};
};

}  // namespace

std::string gunzip(const FileBytes& file) { return Inflater(file).inflateAll(); }

}  // namespace mandoline::detail
#else
namespace mandoline::detail {

std::string gunzip(const FileBytes& file) {
  throw FileError(file.path + ": is gzipped, which this build can't read because it has no zlib");
}

}  // namespace mandoline::detail
#endif

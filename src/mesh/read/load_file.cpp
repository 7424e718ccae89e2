#include <algorithm>
#include <cerrno>
#include <cstdint>
#include <cstdio>
#include <cstring>
#include <filesystem>
#include <memory>
#include <new>

#include "mesh/read/readers.h"
#include "mesh/read/scalar.h"

#ifdef MANDOLINE_HAVE_ZLIB
#include <zlib.h>
#endif

namespace mandoline::detail {
namespace {

std::string readBytes(const std::string& path) {
  std::error_code ignored;
  if (std::filesystem::is_directory(path, ignored)) throw FileError(path + ": is a directory");
  const std::unique_ptr<FILE, int (*)(FILE*)> file(std::fopen(path.c_str(), "rb"), std::fclose);
  if (!file) throw FileError(path + ": " + std::strerror(errno));
  const auto size = std::filesystem::file_size(path, ignored);
  std::string bytes;
  bytes.resize(ignored ? 0 : size_t(size));
  size_t count = 0;
  for (;;) {  // pipes have no size, and files may grow
    count += std::fread(bytes.data() + count, 1, bytes.size() - count, file.get());
    if (count < bytes.size() || std::feof(file.get())) break;
    const int next = std::fgetc(file.get());
    if (next == EOF) break;
    bytes.resize(std::max(2 * bytes.size(), size_t(1) << 16));
    bytes[count++] = char(next);
  }
  if (std::ferror(file.get())) throw FileError(path + ": byte " + std::to_string(count) + ": " + std::strerror(errno));
  bytes.resize(count);
  return bytes;
}

bool isGzipped(const std::string& bytes, size_t begin = 0) { return bytes.compare(begin, 2, "\x1f\x8b") == 0; }

#ifdef MANDOLINE_HAVE_ZLIB
class Inflater {
 public:
  Inflater(const std::string& path, const std::string& packed) : path_(path), packed_(packed) {}
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
    } while (isGzipped(packed_, consumed_));
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
  const std::string& packed_;
  std::string bytes_;
  size_t consumed_ = 0, made_ = 0;
  z_stream stream_{};
};
#endif

}  // namespace

std::string loadFile(const std::string& path) {
  std::string bytes = readBytes(path);
  if (isGzipped(bytes)) {
#ifdef MANDOLINE_HAVE_ZLIB
    bytes = Inflater(path, bytes).inflateAll();
#else
    throw FileError(path + ": is gzipped, which this build can't read because it has no zlib");
#endif
  }
  if (bytes.empty()) throw FileError(path + ": the file is empty");
  return bytes;
}

}  // namespace mandoline::detail

#include "mesh/read/load_file.h"

#include <algorithm>
#include <cerrno>
#include <cstdio>
#include <cstring>
#include <filesystem>
#include <memory>
#include <new>

#include "mesh/fingerprints.h"
#include "mesh/read/readers.h"

namespace mandoline {

bool detail::isBinaryMesh(const std::string& path) {
  std::error_code failed;
  if (!std::filesystem::is_regular_file(path, failed)) return false;
  const auto size = std::filesystem::file_size(path, failed);
  const std::unique_ptr<FILE, int (*)(FILE*)> file(failed ? nullptr : std::fopen(path.c_str(), "rb"), std::fclose);
  if (!file) return false;
  char bytes[512];
  const std::string_view head(bytes, std::fread(bytes, 1, sizeof bytes, file.get()));
  return looksLikePly(head) ? head.find("format binary_") != head.npos : isBinaryStl(head, size);
}

detail::PartlyRead::PartlyRead(const std::string& path) : path_(path), file_(path, std::ios::binary) {
  if (!file_) throw FileError(path + ": " + std::strerror(errno));
  size_ = std::filesystem::file_size(path);
}

std::string detail::PartlyRead::read(uint64_t offset, size_t count) const {
  std::string bytes(count, '\0');
  if (!file_.seekg(std::streamoff(offset)) || !file_.read(bytes.data(), std::streamsize(count)))
    throw FileError(path_ + ": byte " + std::to_string(offset) + ": can't be read");
  return bytes;
}

namespace detail {
namespace {

/// Its size and some bytes at even distances.
uint64_t sampleOf(const PartlyRead& file) {
  constexpr uint64_t kPlaces = 64, kBytes = 64;
  Fingerprinter fingerprinter("file");
  fingerprinter.add(file.size());
  for (uint64_t place = 0; place < kPlaces; ++place) {
    const uint64_t count = std::min(file.size(), kBytes);
    for (const char byte : file.read((file.size() - count) * place / (kPlaces - 1), size_t(count)))
      fingerprinter.add(uint64_t(uint8_t(byte)));
  }
  return fingerprinter.get().value;
}

}  // namespace
}  // namespace detail

std::optional<detail::FileSlice> detail::readMeshSlice(const std::string& path, const ShareOf& shareOf) {
  try {
    if (!isBinaryMesh(path)) return std::nullopt;
    PartlyRead file(path);
    const std::string head = file.read(0, size_t(std::min<uint64_t>(file.size(), 512)));
    if (isGzipped(head) || looksLikeOff(head)) return std::nullopt;
    const uint64_t sample = sampleOf(file);
    FileSlice slice{{}, looksLikePly(head) ? openPly(std::move(file)) : openStl(std::move(file)), sample};
    if (!slice.whole) return std::nullopt;
    slice.mesh = readShare(*slice.whole, shareOf);
    return slice;
  } catch (const FileError&) {
    return std::nullopt;
  } catch (const std::filesystem::filesystem_error&) {
    return std::nullopt;
  }
}

std::string detail::loadFile(const std::string& path) {
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

Mesh readMesh(const std::string& path) {
  try {
    return readMesh(detail::loadFile(path), path);
  } catch (const std::bad_alloc&) {
    throw FileError(path + ": does not fit into memory");
  }
}

}  // namespace mandoline

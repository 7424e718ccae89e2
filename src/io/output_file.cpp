#include "io/output_file.h"

#include <cerrno>
#include <cstring>

namespace mandoline::detail {
namespace {

namespace fs = std::filesystem;

[[noreturn]] void failWriting(const std::string& path) {
  throw FileError(path + ": can't be written" + (errno ? std::string(": ") + std::strerror(errno) : ""));
}

}  // namespace

void checkPlace(const std::string& path) {
  const fs::path folder = fs::path(path).parent_path();
  std::error_code ignored;
  if (!folder.empty() && !fs::is_directory(folder, ignored)) throw FileError(path + ": there is no folder " + folder.string());
  if (fs::is_directory(path, ignored)) throw FileError(path + ": is a directory");
}

OutputFile::OutputFile(const std::string& path) : path_(path), target_(path) {
  std::error_code error;
  if (fs::exists(path, error)) target_ = fs::canonical(path, error);  // what a link points to
  inPlace_ = fs::exists(target_, error) && !fs::is_regular_file(target_, error);
  written_ = target_;
  if (!inPlace_) written_ += ".part";
  errno = 0;
  stream_.open(written_, std::ios::binary | std::ios::trunc);
  if (!stream_) failWriting(path_);
}

OutputFile::~OutputFile() {
  stream_.close();
  std::error_code ignored;
  if (!inPlace_ && !committed_) fs::remove(written_, ignored);
}

void OutputFile::write(std::string_view bytes) {
  if (!stream_.write(bytes.data(), std::streamsize(bytes.size()))) failWriting(path_);
}

void OutputFile::commit() {
  stream_.close();
  if (!stream_) failWriting(path_);
  std::error_code error;
  if (!inPlace_) fs::rename(written_, target_, error);
  if (error) throw FileError(path_ + ": can't be written: " + error.message());
  committed_ = true;
}

OutputFolder::OutputFolder(const fs::path& path) {
  std::error_code error;
  for (fs::path folder = path; folder.has_relative_path() && !fs::exists(folder, error); folder = folder.parent_path())
    made_.push_back(folder);
  fs::create_directories(path, error);
  if (!error) return;
  removeMade();
  throw FileError(path.string() + ": can't be written: " + error.message());
}

OutputFolder::~OutputFolder() { removeMade(); }

void OutputFolder::removeMade() {
  std::error_code ignored;
  for (const fs::path& folder : made_) fs::remove(folder, ignored);
}

}  // namespace mandoline::detail

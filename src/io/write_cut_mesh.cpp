#include <cerrno>
#include <cstring>
#include <filesystem>
#include <fstream>

#include "mandoline/io.h"
#include "mesh/read/text_cursor.h"

namespace mandoline {
namespace {

namespace fs = std::filesystem;

std::string extensionOf(const std::string& path) { return detail::lowerCase(fs::path(path).extension().string()); }

[[noreturn]] void failWriting(const std::string& path) {
  throw FileError(path + ": can't be written" + (errno ? std::string(": ") + std::strerror(errno) : ""));
}

/// A file that takes its place only when it is complete, unless that place is a device or a pipe.
class OutputFile {
 public:
  explicit OutputFile(const std::string& path) : path_(path), target_(path) {
    std::error_code error;
    if (fs::exists(path, error)) target_ = fs::canonical(path, error);  // what a link points to
    inPlace_ = fs::exists(target_, error) && !fs::is_regular_file(target_, error);
    written_ = target_;
    if (!inPlace_) written_ += ".part";
    errno = 0;
    stream_.open(written_, std::ios::binary | std::ios::trunc);
    if (!stream_) failWriting(path_);
  }
  ~OutputFile() {
    stream_.close();
    std::error_code ignored;
    if (!inPlace_ && !committed_) fs::remove(written_, ignored);
  }
  OutputFile(const OutputFile&) = delete;
  OutputFile& operator=(const OutputFile&) = delete;

  std::ostream& stream() { return stream_; }
  void commit() {
    stream_.close();
    if (!stream_) failWriting(path_);
    std::error_code error;
    if (!inPlace_) fs::rename(written_, target_, error);
    if (error) throw FileError(path_ + ": can't be written: " + error.message());
    committed_ = true;
  }

 private:
  std::string path_;
  fs::path target_, written_;
  bool inPlace_ = false, committed_ = false;
  std::ofstream stream_;
};

}  // namespace

void checkOutput(const std::string& path) {
  const std::string extension = extensionOf(path);
  if (extension != ".json" && extension != ".vtu" && extension != ".obj") {
    throw FileError(path + ": the extension must be .json, .vtu or .obj");
  }
  const fs::path folder = fs::path(path).parent_path();
  std::error_code ignored;
  if (!folder.empty() && !fs::is_directory(folder, ignored)) throw FileError(path + ": there is no folder " + folder.string());
  if (fs::is_directory(path, ignored)) throw FileError(path + ": is a directory");
}

void writeCutMesh(const std::string& path, const MeshView& mesh, const CutMesh& cutMesh) {
  checkOutput(path);
  const std::string extension = extensionOf(path);
  OutputFile file(path);
  if (extension == ".json") writeJson(file.stream(), cutMesh);
  if (extension == ".vtu") writeVtu(file.stream(), mesh, cutMesh);
  if (extension == ".obj") writeObj(file.stream(), cutMesh);
  file.commit();
}

}  // namespace mandoline

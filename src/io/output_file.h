// Files that appear when they are complete.
#pragma once

#include <filesystem>
#include <fstream>
#include <vector>

#include "base/shared.h"
#include "mandoline/io.h"

namespace mandoline::detail {

/// Throws the FileError that opening the file would meet at once: no such folder, or it is a folder.
MANDOLINE_SHARED void checkPlace(const std::string& path);

/// A file that takes its place when it is committed, unless that place is a device or a pipe, which gets everything as it comes.
class OutputFile {
 public:
  MANDOLINE_SHARED explicit OutputFile(const std::string& path);
  MANDOLINE_SHARED ~OutputFile();
  OutputFile(const OutputFile&) = delete;
  OutputFile& operator=(const OutputFile&) = delete;

  MANDOLINE_SHARED void write(std::string_view bytes);
  MANDOLINE_SHARED void commit();

 private:
  std::string path_;
  std::filesystem::path target_, written_;
  bool inPlace_ = false, committed_ = false;
  std::ofstream stream_;
};

/// A folder for files, made with those that it lies in. Of these, those that were not there go again if nothing is in them at the end.
class OutputFolder {
 public:
  /// Throws FileError.
  MANDOLINE_SHARED explicit OutputFolder(const std::filesystem::path& path);
  MANDOLINE_SHARED ~OutputFolder();
  OutputFolder(const OutputFolder&) = delete;
  OutputFolder& operator=(const OutputFolder&) = delete;

 private:
  void removeMade();

  std::vector<std::filesystem::path> made_;  // the innermost first
};

}  // namespace mandoline::detail

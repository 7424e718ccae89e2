#include "cli/files.h"

#include <cerrno>
#include <cstdio>
#include <cstring>

#include "cli/arguments.h"
#include "cli/interrupt.h"
#include "io/output_file.h"

namespace mandoline::cli {
namespace {

namespace fs = std::filesystem;

void writeStandardOutput(std::string_view bytes) {
  errno = 0;
  if (std::fwrite(bytes.data(), 1, bytes.size(), stdout) != bytes.size() || std::fflush(stdout) != 0) {
    throw FileError(std::string("standard output: can't be written") + (errno ? std::string(": ") + std::strerror(errno) : ""));
  }
}

bool areSame(const std::string& a, const std::string& b) {
  if (a == "-" || b == "-") return a == b;
  std::error_code error;
  if (fs::exists(a, error) || fs::exists(b, error)) return fs::is_regular_file(a, error) && fs::equivalent(a, b, error);
  const fs::path p = fs::weakly_canonical(fs::absolute(a, error), error), q = fs::weakly_canonical(fs::absolute(b, error), error);
  return p == q;
}

}  // namespace

bool isPolyMesh(const std::string& path) {
  const fs::path place = fs::path(path).lexically_normal();
  return (place.has_filename() ? place : place.parent_path()).filename() == "polyMesh";
}

void writeOutput(const std::string& path, const std::function<void(const Sink&)>& write) {
  const DeferInterrupts defer;
  if (path == "-") {
    return write([](std::string_view bytes) {
      throwIfInterrupted();
      writeStandardOutput(bytes);
    });
  }
  detail::OutputFile file(path);
  write([&](std::string_view bytes) {
    throwIfInterrupted();
    file.write(bytes);
  });
  throwIfInterrupted();
  file.commit();
}

void requireDifferent(const std::vector<NamedFile>& files) {
  for (size_t i = 0; i < files.size(); ++i) {
    for (size_t j = 0; j < i; ++j) {
      if (!areSame(files[j].path, files[i].path)) continue;
      const std::string both = files[j].use + ' ' + files[j].path + " and " + files[i].use + ' ' + files[i].path;
      throw UsageError(both + (files[i].path == "-" ? " both are standard output" : " are the same file"));
    }
  }
}

}  // namespace mandoline::cli

// Files by the names on the command line, where "-" is standard input or output.
#pragma once

#include "mandoline/io.h"

namespace mandoline::cli {

/// Whether the output is a folder for OpenFOAM: it is called polyMesh.
bool isPolyMesh(const std::string& path);

/// Calls write(sink) for a file that appears when it is complete, or for standard output. Throws FileError, and Interrupted when a signal
/// comes, without leaving an unfinished file.
void writeOutput(const std::string& path, const std::function<void(const Sink&)>& write);

/// A name and what the file is for, as in "-o".
struct NamedFile {
  std::string use, path;
};
/// Throws UsageError if two of them are the same file, even if they are spelt differently. Devices and pipes may be named twice.
void requireDifferent(const std::vector<NamedFile>& files);

}  // namespace mandoline::cli

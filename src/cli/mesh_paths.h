// The mesh files of a folder.
#pragma once

#include <algorithm>
#include <filesystem>
#include <vector>

namespace mandoline::cli {

inline bool isMesh(const std::filesystem::path& path) {
  const std::filesystem::path file = path.extension() == ".gz" ? path.stem() : path;
  constexpr const char* kExtensions[] = {".obj", ".stl", ".ply", ".off"};
  return std::find(std::begin(kExtensions), std::end(kExtensions), file.extension()) != std::end(kExtensions);
}

/// In the order of their names.
inline std::vector<std::filesystem::path> meshesIn(const std::filesystem::path& folder) {
  std::vector<std::filesystem::path> paths;
  for (const std::filesystem::directory_entry& entry : std::filesystem::directory_iterator(folder)) {
    if (isMesh(entry.path())) paths.push_back(entry.path());
  }
  std::sort(paths.begin(), paths.end());
  return paths;
}

}  // namespace mandoline::cli

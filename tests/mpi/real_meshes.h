// Real meshes for programs without Catch2: see mesh_folder.h.
#pragma once

#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <string>
#include <vector>

/// Of those below 40000 triangles every so many-th; none without the folder.
inline std::vector<std::string> realMeshes(size_t every) {
  const char* folder = std::getenv("MANDOLINE_MESHES");
  std::vector<std::string> files;
  if (!folder || !*folder) return files;
  std::ifstream in(std::filesystem::path(folder) / "manifest.csv");
  std::string line;
  std::getline(in, line);
  for (size_t i = 0; std::getline(in, line);) {
    const size_t file = line.find(','), kind = line.find(',', file + 1);
    if (std::strtoul(line.c_str() + kind + 1, nullptr, 10) > 40000) continue;
    if (i++ % every == 0) files.push_back((std::filesystem::path(folder) / line.substr(0, file)).string());
  }
  return files;
}

// The collection of meshes that some tests use: a folder named by the environment variable MANDOLINE_MESHES, with the files and a
// manifest.csv that has a line for each. Without the variable these tests are skipped, which ctest tells by the words of the warning.
#pragma once

#include <cstdlib>
#include <filesystem>
#include <optional>

#include "catch.h"

/// The folder; nothing, after a warning, if there is none.
inline std::optional<std::filesystem::path> meshFolder() {
  const char* folder = std::getenv("MANDOLINE_MESHES");
  if (folder && *folder) return std::filesystem::path(folder);
  WARN("skipped: MANDOLINE_MESHES is not set");
  return std::nullopt;
}

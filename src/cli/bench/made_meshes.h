// Meshes that need no files: written to a temporary folder for as long as the benchmark runs.
#pragma once

#include <filesystem>
#include <vector>

#include "cli/bench/measure.h"

namespace mandoline::bench {

inline constexpr const char* kCube = "cube";  ///< of 12 triangles

class MadeMeshes {
 public:
  MadeMeshes();
  ~MadeMeshes();
  MadeMeshes(const MadeMeshes&) = delete;
  MadeMeshes& operator=(const MadeMeshes&) = delete;

  /// Each mesh at each N.
  std::vector<Job> jobs(const std::vector<int64_t>& cells) const;

 private:
  std::filesystem::path folder_;
};

}  // namespace mandoline::bench

#include "cli/bench/made_meshes.h"

#include <unistd.h>

#include <string>

#include "mandoline/io.h"
#include "mandoline/shapes.h"

namespace mandoline::bench {
namespace {

namespace fs = std::filesystem;

constexpr const char* kNames[] = {kCube, "sphere", "torus-knot"};

Mesh make(const std::string& name) {
  if (name == kCube) return makeBox({0, 0, 0}, {1, 1, 1});
  if (name == "sphere") return makeSphere({0, 0, 0}, 1, 6);
  return makeTorusKnot(0.4, 960, 36);
}

fs::path fileOf(const fs::path& folder, const std::string& name) { return folder / (name + ".obj"); }

}  // namespace

MadeMeshes::MadeMeshes() : folder_(fs::temp_directory_path() / ("mandoline-bench-" + std::to_string(getpid()))) {
  fs::create_directory(folder_);
  for (const char* name : kNames) {
    const Mesh mesh = make(name);
    writeMesh(fileOf(folder_, name).string(), mesh);
  }
}

MadeMeshes::~MadeMeshes() {
  std::error_code ignored;
  fs::remove_all(folder_, ignored);
}

std::vector<Job> MadeMeshes::jobs(const std::vector<int64_t>& cells) const {
  std::vector<Job> jobs;
  for (const char* name : kNames) {
    for (const int64_t n : cells) jobs.push_back({name, fileOf(folder_, name).string(), n});
  }
  return jobs;
}

}  // namespace mandoline::bench

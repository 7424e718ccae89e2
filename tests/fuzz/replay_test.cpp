// Replays what the fuzzer in lattice.cpp once found, and runs a few thousand inputs of its kind that are the same every time.
#include <algorithm>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <random>
#include <vector>

#include "brick_sizes.h"
#include "catch.h"
#include "lattice.h"

namespace {

/// Calls f(name, find) for those in the corpus.
template <class F>
void forFinds(const F& f) {
  std::vector<std::filesystem::path> files;
  for (const auto& entry : std::filesystem::directory_iterator(MANDOLINE_FUZZ_CORPUS)) files.push_back(entry.path());
  std::sort(files.begin(), files.end());
  REQUIRE_FALSE(files.empty());
  for (const auto& file : files) {
    std::ifstream in(file, std::ios::binary);
    const std::vector<char> bytes{std::istreambuf_iterator<char>(in), {}};
    f(file.filename().string(), decodeLattice(reinterpret_cast<const uint8_t*>(bytes.data()), bytes.size()));
  }
}

}  // namespace

TEST_CASE("finds of the fuzzer stay fixed", "[fuzz]") {
  forFinds([](const std::string& name, const LatticeCase& find) {
    INFO(name);
    CHECK(brokenPromise(find) == "");
  });
}

TEST_CASE("finds of the fuzzer are cut alike with all sizes of bricks", "[fuzz]") {
  forFinds([](const std::string& name, const LatticeCase& find) {
    INFO(name);
    for (const int shift : {0, 1, 2, 3}) CHECK(brokenBricks(find.mesh, find.grid, shift, 1) == "");
  });
}

TEST_CASE("random meshes on a lattice", "[fuzz]") {
  std::mt19937 random(1);
  size_t clean = 0, intersecting = 0;
  for (int run = 0; run < 4000; ++run) {
    std::vector<uint8_t> bytes(20 + random() % 200);
    for (uint8_t& byte : bytes) byte = uint8_t(random() >> 24);
    const LatticeCase latticeCase = decodeLattice(bytes.data(), bytes.size());
    ++(latticeCase.intersects ? intersecting : clean);
    const std::string broken = brokenPromise(latticeCase);
    INFO("run " << run);
    CHECK(broken == "");
  }
  CHECK(clean > 1000);
  CHECK(intersecting > 100);
}

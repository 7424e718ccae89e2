// Cuts and validates every mesh of a collection of real ones (see mesh_folder.h), of whose manifest.csv the columns `file` and
// `self_intersects` are read. Meshes without self-intersections have to pass. The others may be refused by the names of two
// triangles or, as not every crossing inside of a grid cell is looked for, by a validation that names what is wrong.
#include <algorithm>
#include <chrono>
#include <filesystem>
#include <fstream>
#include <sstream>

#include "catch.h"
#include "mandoline/io.h"
#include "mandoline/validate.h"
#include "mesh_folder.h"

using namespace mandoline;

namespace {

struct Row {
  std::string file;
  bool intersects;
};

std::vector<std::string> fieldsOf(const std::string& line) {
  std::vector<std::string> fields(1);
  bool quoted = false;
  for (char c : line) {
    if (c == '"')
      quoted = !quoted;
    else if (c == ',' && !quoted)
      fields.emplace_back();
    else
      fields.back() += c;
  }
  return fields;
}

std::vector<Row> manifest(const std::filesystem::path& folder) {
  std::ifstream in(folder / "manifest.csv");
  std::string line;
  std::getline(in, line);
  const std::vector<std::string> header = fieldsOf(line);
  const auto column = [&](const char* title) { return size_t(std::find(header.begin(), header.end(), title) - header.begin()); };
  std::vector<Row> rows;
  while (std::getline(in, line)) {
    const std::vector<std::string> fields = fieldsOf(line);
    rows.push_back({fields.at(column("file")), fields.at(column("self_intersects")) != "0"});
  }
  return rows;
}

void cutAll(int64_t n) {
  const std::optional<std::filesystem::path> folder = meshFolder();
  if (!folder) return;
  const std::vector<Row> rows = manifest(*folder);
  REQUIRE(!rows.empty());
  size_t clean = 0, refused = 0, invalid = 0;
  for (const Row& row : rows) {
    INFO(row.file << " at N = " << n);
    const Mesh mesh = readMesh((*folder / row.file).string());
    const auto start = std::chrono::steady_clock::now();
    const CutResult result = cut(mesh, Grid::around(mesh, n));
    INFO(name(result.error.status) << " " << result.error.message);
    CHECK(std::chrono::steady_clock::now() - start < std::chrono::seconds(60));
    clean += !row.intersects;
    if (!result) {
      CHECK(row.intersects);
      CHECK(std::string(name(result.error.status)) == "selfIntersection");
      CHECK(std::min(result.error.element, result.error.element2) >= 0);
      CHECK(result.error.element != result.error.element2);
      ++refused;
      continue;
    }
    const Validation validation = validate(mesh, result.mesh);
    std::string failures;
    bool named = true;
    for (const Check& check : validation.checks) {
      if (check.pass) continue;
      failures += check.name + " at " + check.elementKind + " " + std::to_string(check.element) + "; ";
      named = named && check.element >= 0;
    }
    INFO(failures);
    CHECK((validation.pass || row.intersects));
    CHECK(named);
    invalid += !validation.pass;
  }
  WARN("N = " << n << ": " << clean << " meshes without self-intersections, " << rows.size() - clean << " with; " << refused << " refused, "
              << invalid << " not valid");
}

}  // namespace

TEST_CASE("real meshes at N = 5", "[corpus5]") { cutAll(5); }
TEST_CASE("real meshes at N = 13", "[corpus13]") { cutAll(13); }
TEST_CASE("real meshes at N = 32", "[corpus32]") { cutAll(32); }
TEST_CASE("real meshes at N = 64", "[corpus64]") { cutAll(64); }

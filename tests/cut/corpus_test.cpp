// Cuts and validates every mesh of a collection of real ones (see mesh_folder.h), whether it intersects itself or not. Any number of
// threads gives the same bits, and so does saving and loading. Where there are winding numbers, those of the regions times their volumes
// make the input's signed volume.
#include <algorithm>
#include <chrono>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <sstream>

#include "catch.h"
#include "conforming_cells.h"
#include "mandoline/intersections.h"
#include "mandoline/io.h"
#include "mandoline/measure.h"
#include "mandoline/validate.h"
#include "mcm_file.h"
#include "mesh_folder.h"
#include "same_bits.h"
#include "shapes.h"

using namespace mandoline;

namespace {

struct Row {
  std::string file;
  bool intersects, hasZeroArea, hasDuplicates;
  uint64_t pairs, folded, coplanar;  ///< of triangles that meet
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
    const auto number = [&](const char* title) { return std::strtoull(fields.at(column(title)).c_str(), nullptr, 10); };
    rows.push_back({fields.at(column("file")), number("self_intersects") != 0, number("degenerate_tris") != 0,
                    number("duplicate_tris") != 0, number("si_pairs"), number("si_folded_pairs"), number("si_coplanar_pairs")});
  }
  return rows;
}

/// Winding number times volume, summed over the regions, is the input's signed volume.
void checkVolume(const Mesh& mesh, const CutMesh& cutMesh) {
  const std::vector<double> volumes = regionVolumes(cutMesh, measure(mesh, cutMesh));
  double sum = 0, all = 0;
  for (size_t r = 0; r < volumes.size(); ++r) {
    sum += cutMesh.regionWinding[r] * volumes[r];
    all += volumes[r];
  }
  CHECK(std::abs(sum - shapes::signedVolume(mesh)) <= 1e-9 * all);
}

void cutAll(int64_t n) {
  const std::optional<std::filesystem::path> folder = meshFolder();
  if (!folder) return;
  const std::vector<Row> rows = manifest(*folder);
  REQUIRE(!rows.empty());
  CutOptions threeThreads;
  threeThreads.threads = 3;
  size_t intersecting = 0, withWinding = 0, complexes = 0;
  for (const Row& row : rows) {
    INFO(row.file << " at N = " << n);
    const Mesh mesh = readMesh((*folder / row.file).string());
    const auto start = std::chrono::steady_clock::now();
    const CutResult result = cut(mesh, Grid::around(mesh, n));
    INFO(name(result.error.status) << " " << result.error.message);
    CHECK(std::chrono::steady_clock::now() - start < std::chrono::seconds(60));
    CHECK(result);
    if (!result) continue;
    CHECK(differences(result.mesh, cut(mesh, Grid::around(mesh, n), threeThreads).mesh).empty());
    const Validation validation = validate(mesh, result.mesh);
    std::string failures;
    for (const Check& check : validation.checks) {
      if (!check.pass) failures += check.name + " at " + check.elementKind + " " + std::to_string(check.element) + "; ";
    }
    CHECK(failures == "");
    if (n == 5) {
      const std::string saved = mcmOf(result.mesh);
      const CutMesh loaded = readMcm(saved);
      CHECK(differences(result.mesh, loaded).empty());
      CHECK(mcmOf(loaded) == saved);
    }
    if (n == 13 && ++complexes % 4 == 0) checkedComplex(mesh, result.mesh);  // a quarter of them, which takes long enough
    const PairCounts& pairs = result.stats.intersections;
    const bool intersects = pairs.total() > pairs.identical;
    CHECK((row.intersects || !intersects));  // the manifest counts triangles without area
    intersecting += intersects;
    if (!result.mesh.hasWinding) continue;
    ++withWinding;
    checkVolume(mesh, result.mesh);
  }
  WARN("N = " << n << ": " << rows.size() << " meshes, " << intersecting << " that intersect themselves, " << withWinding
              << " with winding numbers");
}

}  // namespace

TEST_CASE("real meshes: pairs of triangles that meet", "[pairs]") {
  const std::optional<std::filesystem::path> folder = meshFolder();
  if (!folder) return;
  size_t compared = 0;
  for (const Row& row : manifest(*folder)) {
    if (row.hasZeroArea || row.hasDuplicates) continue;  // of which the manifest counts some pairs and not others
    ++compared;
    INFO(row.file);
    const Mesh mesh = readMesh((*folder / row.file).string());
    const PairCounts counts = findIntersections(mesh).counts;
    CHECK(counts.total() == row.pairs);
    CHECK(counts.folded == row.folded);
    CHECK(counts.overlapping <= row.coplanar);  // where they touch in one plane, too
    CHECK(counts.identical == 0);
  }
  CHECK(compared > 100);
}

TEST_CASE("real meshes at N = 5", "[corpus5]") { cutAll(5); }
TEST_CASE("real meshes at N = 13", "[corpus13]") { cutAll(13); }
TEST_CASE("real meshes at N = 64", "[corpus64]") { cutAll(64); }

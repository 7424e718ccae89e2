// Inside by parity against rays in rational arithmetic.
#include <fstream>
#include <random>
#include <sstream>

#include "catch.h"
#include "mandoline/mandoline.h"
#include "mandoline/mesh_files.h"
#include "mesh_folder.h"
#include "rational.h"

using namespace mandoline;

namespace {

struct Row {
  std::string file;
  bool isOriented, isEven;
};

/// Meshes whose edges all have an even number of triangles: first those that are not consistently oriented.
std::vector<Row> evenMeshes(const std::filesystem::path& folder) {
  std::ifstream in(folder / "manifest.csv");
  std::string line;
  std::getline(in, line);
  std::vector<Row> rows;
  while (std::getline(in, line)) {
    std::istringstream fields(line);
    std::vector<std::string> values;
    for (std::string field; values.size() < 7 && std::getline(fields, field, ',');) values.push_back(field);
    rows.push_back({values[0], values[5] == "1", values[6] == "1"});
  }
  std::erase_if(rows, [](const Row& row) { return !row.isEven; });
  std::stable_sort(rows.begin(), rows.end(), [](const Row& a, const Row& b) { return a.isOriented < b.isOriented; });
  return rows;
}

/// Exact sign of the turn of a, b, p seen along z.
int turn(const double* a, const double* b, const double* p) {
  const auto r = [](double x) { return Rational(x); };
  return order((r(b[0]) - r(a[0])) * (r(p[1]) - r(a[1])), (r(b[1]) - r(a[1])) * (r(p[0]) - r(a[0])));
}

/// Exact: whether the ray from p along +z meets an odd number of triangles; nothing if it meets an edge, or if p lies on a triangle.
std::optional<bool> isOddAbove(const Mesh& mesh, const double* p) {
  bool odd = false;
  for (size_t t = 0; t < mesh.triangleCount(); ++t) {
    const double* v[3];
    for (size_t i = 0; i < 3; ++i) v[i] = &mesh.positions[3 * size_t(mesh.triangles[3 * t + i])];
    const auto [lowX, highX] = std::minmax({v[0][0], v[1][0], v[2][0]});
    const auto [lowY, highY] = std::minmax({v[0][1], v[1][1], v[2][1]});
    if (lowX > p[0] || highX < p[0] || lowY > p[1] || highY < p[1] || std::max({v[0][2], v[1][2], v[2][2]}) < p[2]) continue;
    const int ab = turn(v[0], v[1], p), bc = turn(v[1], v[2], p), ca = turn(v[2], v[0], p);
    if (std::min({ab, bc, ca}) < 0 && std::max({ab, bc, ca}) > 0) continue;
    if (ab == 0 || bc == 0 || ca == 0) return std::nullopt;
    Rational to[3][3];
    for (size_t i = 0; i < 3; ++i) {
      for (size_t d = 0; d < 3; ++d) to[i][d] = Rational(v[i][d]) - Rational(p[d]);
    }
    const auto minor = [&](size_t d, size_t e) { return to[1][d] * to[2][e] - to[1][e] * to[2][d]; };
    const int volume = (to[0][0] * minor(1, 2) + to[0][1] * minor(2, 0) + to[0][2] * minor(0, 1)).sign();
    if (volume == 0) return std::nullopt;
    if (volume == ab) odd = !odd;  // the triangle, counter-clockwise from above if ab is 1, lies above p
  }
  return odd;
}

}  // namespace

TEST_CASE("real meshes: parity is that of rays in rational arithmetic", "[parity]") {
  const std::optional<std::filesystem::path> folder = meshFolder();
  if (!folder) return;
  constexpr size_t kPoints = 1000;
  size_t meshes = 0, compared = 0, byParity = 0;
  for (const Row& row : evenMeshes(*folder)) {
    if (meshes == 30) break;
    const Mesh mesh = readMesh((*folder / row.file).string());
    if (mesh.triangleCount() > 60000) continue;
    ++meshes;
    INFO(row.file);
    const CutResult cut = mandoline::cut(mesh, Grid::around(mesh, 13));
    REQUIRE(cut);
    CHECK(cut.stats.parts.open == 0);
    CHECK((cut.mesh.hasWinding || cut.mesh.regionParity.size() == cut.mesh.regionCount));
    const InsideRegions inside = insideRegions(cut.mesh, {WindingRule::odd});
    CHECK(inside.isComplete);
    byParity += inside.by == InsideBy::parity;
    std::mt19937_64 random(meshes);
    std::vector<double> points;
    for (size_t i = 0; i < 3 * kPoints; ++i) {
      const std::vector<double>& planes = cut.mesh.grid.planes[i % 3];
      points.push_back(planes.front() + (planes.back() - planes.front()) * (double(random() >> 11) * 0x1p-53));
    }
    const Locations found = cellsAt(cut.mesh, points);
    size_t wrong = 0;
    for (size_t i = 0; i < kPoints; ++i) {
      const std::optional<bool> expected = isOddAbove(mesh, &points[3 * i]);
      if (!expected) continue;
      ++compared;
      wrong += *expected != (inside.isInside[size_t(found.region[i])] != 0);
    }
    CHECK(wrong == 0);
  }
  CHECK(meshes == 30);
  CHECK(compared > 29 * kPoints);
  CHECK(byParity > 3);
}

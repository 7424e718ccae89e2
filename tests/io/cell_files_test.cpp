// Files of all cells, read back: OpenFOAM's polyMesh, and .vtu files of cells and of faces.
#include <cmath>
#include <cstring>
#include <map>
#include <numeric>
#include <set>
#include <sstream>

#include "case_list.h"
#include "catch.h"
#include "mandoline/io.h"
#include "mandoline/merge.h"
#include "refusal.h"
#include "shapes.h"
#include "temporary_folder.h"
#include "vtu_files.h"

using namespace mandoline;

namespace {

struct Cells {
  CutMesh cutMesh;
  CellComplex complex;

  Cells(const Mesh& mesh, const Grid& grid, int levels) {
    CutResult result = cut(mesh, grid);
    REQUIRE(result);
    cutMesh = std::move(result.mesh);
    CoarsenOptions options;
    options.maxLevel = levels;
    complex = cellComplex(mesh, cutMesh, coarsen(cutMesh, options));
  }
};

struct PolyMesh {
  struct Patch {
    std::string name, type;
    size_t faces, start;
    std::string group;
  };
  std::vector<std::array<double, 3>> points;
  std::vector<std::vector<size_t>> faces;
  std::vector<size_t> owner, neighbour;
  std::vector<Patch> patches;
  std::vector<std::pair<std::string, size_t>> zones;  ///< names and numbers of cells

  /// The last one may be an owner of no face.
  size_t cellCount() const {
    size_t count = 0;
    for (const std::vector<size_t>* cells : {&owner, &neighbour}) {
      for (const size_t c : *cells) count = std::max(count, c + 1);
    }
    return count;
  }
  const Patch& patch(const std::string& name) const {
    return *std::find_if(patches.begin(), patches.end(), [&](const Patch& p) { return p.name == name; });
  }
};

/// The words of a file after its head, without brackets and semicolons; the first one is the number of entries.
std::vector<std::string> wordsOf(const TemporaryFolder& folder, const std::string& name) {
  std::string text = folder.read("polyMesh/" + name);
  text = text.substr(text.find('}') + 1);
  std::vector<std::string> words;
  std::string word;
  for (const char c : text + ' ') {
    if (std::strchr(" \n(){};", c)) {
      if (!word.empty()) words.push_back(word);
      word.clear();
    } else {
      word += c;
    }
  }
  return words;
}

PolyMesh readPolyMesh(const TemporaryFolder& folder) {
  PolyMesh mesh;
  const auto number = [](const std::string& word) { return size_t(std::stoull(word)); };
  std::vector<std::string> words = wordsOf(folder, "points");
  for (size_t i = 1; i < words.size(); i += 3)
    mesh.points.push_back({std::stod(words[i]), std::stod(words[i + 1]), std::stod(words[i + 2])});
  REQUIRE(mesh.points.size() == number(words[0]));
  words = wordsOf(folder, "faces");
  for (size_t i = 1; i < words.size();) {
    const size_t size = number(words[i++]);
    mesh.faces.emplace_back();
    for (size_t k = 0; k < size; ++k) mesh.faces.back().push_back(number(words[i++]));
  }
  REQUIRE(mesh.faces.size() == number(words[0]));
  words = wordsOf(folder, "owner");
  for (size_t i = 1; i < words.size(); ++i) mesh.owner.push_back(number(words[i]));
  words = wordsOf(folder, "neighbour");
  for (size_t i = 1; i < words.size(); ++i) mesh.neighbour.push_back(number(words[i]));
  words = wordsOf(folder, "boundary");
  for (size_t i = 1; i + 6 < words.size(); i += 7) {
    mesh.patches.push_back({words[i], words[i + 2], number(words[i + 4]), number(words[i + 6]), {}});
    if (i + 9 >= words.size() || words[i + 7] != "inGroups") continue;
    mesh.patches.back().group = words[i + 9];
    i += 3;
  }
  REQUIRE(mesh.patches.size() == number(words[0]));
  if (!std::filesystem::exists(folder.path("polyMesh/cellZones"))) return mesh;
  words = wordsOf(folder, "cellZones");
  for (size_t i = 1; i < words.size(); i += 6 + mesh.zones.back().second) mesh.zones.push_back({words[i], number(words[i + 5])});
  return mesh;
}

/// Faces in OpenFOAM's order, patches that follow each other, closed cells, and no point without a face.
void requireSound(const PolyMesh& mesh) {
  REQUIRE(mesh.owner.size() == mesh.faces.size());
  for (size_t f = 0; f < mesh.neighbour.size(); ++f) {
    REQUIRE(mesh.owner[f] < mesh.neighbour[f]);
    if (f > 0) REQUIRE(std::pair(mesh.owner[f - 1], mesh.neighbour[f - 1]) <= std::pair(mesh.owner[f], mesh.neighbour[f]));
  }
  size_t next = mesh.neighbour.size();
  for (const PolyMesh::Patch& patch : mesh.patches) {
    REQUIRE(patch.start == next);
    next += patch.faces;
  }
  REQUIRE(next == mesh.faces.size());

  std::vector<bool> used(mesh.points.size());
  std::vector<std::map<std::pair<size_t, size_t>, int>> edges(mesh.cellCount());
  for (size_t f = 0; f < mesh.faces.size(); ++f) {
    const std::vector<size_t>& face = mesh.faces[f];
    std::vector<size_t> sorted = face;
    std::sort(sorted.begin(), sorted.end());
    REQUIRE(face.size() >= 3);
    REQUIRE(std::adjacent_find(sorted.begin(), sorted.end()) == sorted.end());
    for (size_t i = 0; i < face.size(); ++i) {
      used.at(face[i]) = true;
      const size_t a = face[i], b = face[(i + 1) % face.size()];
      const std::pair<size_t, size_t> edge = std::minmax(a, b);
      edges[mesh.owner[f]][edge] += a < b ? 1 : -1;
      if (f < mesh.neighbour.size()) edges[mesh.neighbour[f]][edge] += a < b ? -1 : 1;
    }
  }
  REQUIRE(std::find(used.begin(), used.end(), false) == used.end());
  for (const auto& ofCell : edges) {
    for (const auto& [edge, sum] : ofCell) REQUIRE(sum == 0);
  }
}

std::vector<double> volumes(const PolyMesh& mesh) {
  std::vector<double> volumes(mesh.cellCount());
  for (size_t f = 0; f < mesh.faces.size(); ++f) {
    double volume = 0;
    const auto& a = mesh.points[mesh.faces[f][0]];
    for (size_t i = 2; i < mesh.faces[f].size(); ++i) {
      const auto &b = mesh.points[mesh.faces[f][i - 1]], &c = mesh.points[mesh.faces[f][i]];
      volume += (a[0] * (b[1] * c[2] - b[2] * c[1]) + a[1] * (b[2] * c[0] - b[0] * c[2]) + a[2] * (b[0] * c[1] - b[1] * c[0])) / 6;
    }
    volumes[mesh.owner[f]] += volume;
    if (f < mesh.neighbour.size()) volumes[mesh.neighbour[f]] -= volume;
  }
  return volumes;
}

PolyMesh writtenPolyMesh(const Cells& cells, const WriteOptions& options = {}) {
  const TemporaryFolder folder;
  writePolyMesh(folder.path("polyMesh"), cells.cutMesh, cells.complex, options);
  PolyMesh mesh = readPolyMesh(folder);
  requireSound(mesh);
  return mesh;
}

/// Two spheres, one in the other, in a grid with grid-faces that have holes.
const Mesh kShell = shapes::merged({shapes::icosphere({0, 0, 0}, 1, 2), shapes::flipped(shapes::icosphere({0, 0, 0}, 0.4, 2))});

std::string vtuOf(const Cells& cells, bool faces, std::span<const Field> fields, const WriteOptions& options = {}) {
  std::string bytes;
  const Sink sink = [&](std::string_view piece) { bytes += piece; };
  if (faces) {
    writeFacesVtu(sink, cells.cutMesh, cells.complex, fields, options);
  } else {
    writeVtu(sink, cells.cutMesh, cells.complex, fields, options);
  }
  return bytes;
}

/// The cells of a polyMesh have the volumes of these cells of the complex, in their order.
void requireVolumes(const PolyMesh& mesh, const CellComplex& complex, const std::vector<uint32_t>& cells) {
  const std::vector<double> found = volumes(mesh);
  REQUIRE(found.size() == cells.size());
  double all = 0;
  for (const double v : complex.cellVolume) all += v;
  for (size_t i = 0; i < found.size(); ++i) REQUIRE(std::fabs(found[i] - complex.cellVolume[cells[i]]) <= 1e-9 * all);
}

/// An array of a .vtu file by its name.
template <class Number>
std::vector<Number> arrayOf(const std::string& vtu, const std::string& name) {
  return vtu_files::Vtu(vtu).array<Number>(name);
}

}  // namespace

TEST_CASE("polyMesh: sound and of the right volumes on all cases", "[cellfiles]") {
  for (const NamedCase& c : caseList()) {
    for (const int levels : {0, 24}) {
      INFO(c.name << " with levels " << levels);
      const Cells cells(c.mesh, c.grid, levels);
      const PolyMesh mesh = writtenPolyMesh(cells);
      std::vector<uint32_t> all(cells.complex.cellCount());
      std::iota(all.begin(), all.end(), 0);
      requireVolumes(mesh, cells.complex, all);
    }
  }
}

namespace {

/// Merged cells, and which of them have a side that is no wall.
struct Merged : Cells {
  std::vector<uint32_t> open;

  Merged(const Mesh& mesh, const Grid& grid, int levels) : Cells(mesh, grid, levels) {
    complex = mergeSmallCells(cutMesh, complex).cells;
    for (uint32_t c = 0; c < complex.cellCount(); ++c) {
      const auto sides = complex.halfFaces(c);
      if (std::any_of(sides.begin(), sides.end(), [&](uint32_t h) { return complex.faceTag[h / 2] != FaceTag::surface; }))
        open.push_back(c);
    }
  }

  WriteOptions allRegions() const { return regions(std::vector<uint8_t>(cutMesh.regionCount, 1)); }
  static WriteOptions regions(std::vector<uint8_t> flags) {
    WriteOptions options;
    options.regions = std::move(flags);
    return options;
  }
  /// Those with a side that is no wall, of one region.
  size_t openCellsOf(uint32_t region) const {
    return size_t(std::count_if(open.begin(), open.end(), [&](uint32_t c) { return complex.cellRegion[c] == region; }));
  }
};

double areaOf(const PolyMesh& mesh, size_t face) {
  std::array<double, 3> sum{};
  const auto& polygon = mesh.faces[face];
  const auto& a = mesh.points[polygon[0]];
  for (size_t i = 2; i < polygon.size(); ++i) {
    const auto &b = mesh.points[polygon[i - 1]], &c = mesh.points[polygon[i]];
    for (size_t d = 0; d < 3; ++d) {
      const size_t e = (d + 1) % 3, f = (d + 2) % 3;
      sum[d] += ((b[e] - a[e]) * (c[f] - a[f]) - (b[f] - a[f]) * (c[e] - a[e])) / 2;
    }
  }
  return std::sqrt(sum[0] * sum[0] + sum[1] * sum[1] + sum[2] * sum[2]);
}

}  // namespace

TEST_CASE("polyMesh: merged cells are sound and of the right volumes on all cases, but for those enclosed by walls", "[cellfiles]") {
  for (const NamedCase& c : caseList()) {
    for (const int levels : {0, 24}) {
      INFO(c.name << " with levels " << levels);
      const Merged cells(c.mesh, c.grid, levels);
      requireVolumes(writtenPolyMesh(cells, cells.allRegions()), cells.complex, cells.open);
      writtenPolyMesh(cells);
    }
  }
}

TEST_CASE("polyMesh: of merged cells, no face is only as wide as rounding, where sheets pass planes by that much", "[cellfiles]") {
  const double below = 4 - 0x1p-50, above = 4 + 0x1p-50;
  const std::pair<const char*, Mesh> sheets[] = {
      {"over an edge", shapes::quad({1.5, 4.25, below}, {6.5, 4.25, below}, {6.5, 4.25, 6.5}, {1.5, 4.25, 6.5})},
      {"over a corner", shapes::quad({below, 4.25, below}, {6.5, 4.25, below}, {6.5, 4.25, 6.5}, {below, 4.25, 6.5})},
      {"over both sides", shapes::quad({1.5, below, below}, {6.5, above, below}, {6.5, below, 6.5}, {1.5, above, 6.5})},
      {"slanted", shapes::quad({1.5, below, 1.25}, {6.5, above, 1.75}, {6.25, above, 6.5}, {1.75, below, 6.25})},
  };
  for (const auto& [name, sheet] : sheets) {
    CAPTURE(name);
    const Merged cells(sheet, Grid::box({0, 0, 0}, {8, 8, 8}, {8, 8, 8}), 0);
    const auto isFlat = [](double area) { return area < 1e-12; };
    CHECK(std::count_if(cells.complex.faceArea.begin(), cells.complex.faceArea.end(), isFlat) > 0);
    const PolyMesh mesh = writtenPolyMesh(cells);
    double walls = 0, volume = 0;
    for (size_t f = 0; f < mesh.faces.size(); ++f) {
      CHECK(!isFlat(areaOf(mesh, f)));
      if (f >= mesh.patch("surface").start) walls += areaOf(mesh, f);
    }
    for (const double v : volumes(mesh)) volume += v;
    CHECK(volume == Approx(512).epsilon(1e-12));
    double sides = 0;
    for (size_t f = 0; f < cells.complex.faceCount(); ++f)
      sides += cells.complex.faceTag[f] == FaceTag::surface ? 2 * cells.complex.faceArea[f] : 0;
    CHECK(walls == Approx(sides).epsilon(1e-12));
  }
}

TEST_CASE("polyMesh: of merged cells, a flat sheet that ends in the middle of cells is moved off their centroids", "[cellfiles]") {
  const auto heightsOf = [](double z, bool isFlipped) {
    const Mesh sheet = shapes::quad({0.5, 0.5, z}, {3.5, 0.5, z}, {3.5, 3.5, z}, {0.5, 3.5, z});
    const Merged cells(isFlipped ? shapes::flipped(sheet) : sheet, Grid::box({0, 0, 0}, {4, 4, 4}, {4, 4, 4}), 0);
    const PolyMesh mesh = writtenPolyMesh(cells);
    double area = 0;
    std::set<double> heights;
    for (size_t f = mesh.patch("surface").start; f < mesh.faces.size(); ++f) {
      area += areaOf(mesh, f);
      for (const size_t v : mesh.faces[f]) heights.insert(mesh.points[v][2]);
    }
    CHECK(area == Approx(2 * 9));
    return heights;
  };
  CHECK(heightsOf(1.5, false) == std::set<double>{1.5, 1.5 + 0x1p-42});  // the middle of the sheet stays
  CHECK(heightsOf(1.5, true) == std::set<double>{1.5, 1.5 + 0x1p-42});
  CHECK(heightsOf(1.375, false) == std::set<double>{1.375});
}

namespace {

/// How much of a flat face's area an edge and a point make, where that is least; negative where the edge is seen from behind. Edges at the
/// point don't count, and those between vertices that are one but for rounding.
double leastSeen(const PolyMesh& mesh, size_t face, const std::array<double, 3>& point) {
  const auto& polygon = mesh.faces[face];
  const auto twice = [&](const auto& a, const auto& b, const auto& c, size_t d) {
    const size_t e = (d + 1) % 3, f = (d + 2) % 3;
    return (b[e] - a[e]) * (c[f] - a[f]) - (b[f] - a[f]) * (c[e] - a[e]);
  };
  double least = 1;
  for (size_t d = 0; d < 3; ++d) {
    double area = 0;
    for (size_t i = 2; i < polygon.size(); ++i)
      area += twice(mesh.points[polygon[0]], mesh.points[polygon[i - 1]], mesh.points[polygon[i]], d);
    if (area == 0) continue;
    for (size_t i = 0; i < polygon.size(); ++i) {
      const auto &a = mesh.points[polygon[i]], &b = mesh.points[polygon[(i + 1) % polygon.size()]];
      const double length = std::hypot(b[0] - a[0], b[1] - a[1], b[2] - a[2]);
      if (a != point && b != point && length > 1e-12) least = std::min(least, twice(point, a, b, d) / area);
    }
  }
  return least;
}

/// Of the triangles about the mean of the vertices, by their areas.
std::array<double, 3> centreOf(const PolyMesh& mesh, size_t face) {
  const auto& polygon = mesh.faces[face];
  std::array<double, 3> mean{}, centre{};
  for (const size_t v : polygon)
    for (size_t d = 0; d < 3; ++d) mean[d] += mesh.points[v][d] / double(polygon.size());
  double sum = 0;
  for (size_t i = 0; i < polygon.size(); ++i) {
    PolyMesh triangle;
    triangle.points = {mean, mesh.points[polygon[i]], mesh.points[polygon[(i + 1) % polygon.size()]]};
    triangle.faces = {{0, 1, 2}};
    const double area = areaOf(triangle, 0);
    for (size_t d = 0; d < 3; ++d)
      for (const auto& p : triangle.points) centre[d] += area * p[d] / 3;
    sum += area;
  }
  for (double& x : centre) x /= sum;
  return centre;
}

}  // namespace

TEST_CASE("polyMesh: of merged cells, faces of the grid are divided if their centre does not see them as a whole, or no vertex does",
          "[cellfiles]") {
  const Mesh cubes = shapes::merged({shapes::cube(1.125, 2.75), shapes::cube(3.375, 4.375)});  // faces that are thin L's
  for (const Mesh& mesh : {cubes, kShell}) {
    const Merged cells(mesh, Grid::box({-2, -2, -2}, {6, 6, 6}, {8, 8, 8}), 0);
    const PolyMesh written = writtenPolyMesh(cells, cells.allRegions());
    requireVolumes(written, cells.complex, cells.open);
    for (size_t f = 0; f < written.patch("surface").start; ++f) {
      CHECK(leastSeen(written, f, centreOf(written, f)) > 0);
      const auto& face = written.faces[f];
      CHECK(std::any_of(face.begin(), face.end(), [&](size_t v) { return leastSeen(written, f, written.points[v]) > 0; }));
    }
  }
}

TEST_CASE("polyMesh: of merged cells, one that is enclosed by walls is left out", "[cellfiles]") {
  const Mesh pocket = shapes::cube(1.25, 1.75);
  const Grid grid = Grid::box({0, 0, 0}, {4, 4, 4}, {4, 4, 4});
  CHECK(writtenPolyMesh(Cells(pocket, grid, 0)).cellCount() == 65);
  const PolyMesh mesh = writtenPolyMesh(Merged(pocket, grid, 0));
  CHECK(mesh.cellCount() == 64);
  CHECK(mesh.patches.back().name == "surface");
  // Only what is outside has walls.
  CHECK(mesh.patches.back().faces == 12);
}

TEST_CASE("polyMesh: of merged cells, regions that no side of the grid bounds are left out unless they are asked for", "[cellfiles]") {
  const Merged cells(kShell, Grid::box({-2, -2, -2}, {2, 2, 2}, {16, 16, 16}), 2);
  REQUIRE(cells.cutMesh.regionCount == 3);
  const PolyMesh around = writtenPolyMesh(cells), all = writtenPolyMesh(cells, cells.allRegions());
  CHECK(around.cellCount() == cells.openCellsOf(0));
  CHECK(around.zones.empty());
  CHECK(all.cellCount() == cells.open.size());
  CHECK(all.zones.size() == 3);
  CHECK(writtenPolyMesh(cells, Merged::regions({0, 1, 1})).cellCount() == cells.openCellsOf(1) + cells.openCellsOf(2));
  double volume = 0;
  for (const double v : volumes(around)) volume += v;
  double expected = 0;
  for (const uint32_t c : cells.open) expected += cells.complex.cellRegion[c] == 0 ? cells.complex.cellVolume[c] : 0;
  CHECK(volume == Approx(expected).epsilon(1e-12));
  CHECK(around.patch("surface").faces < all.patch("surface").faces);
  // Cells that are not merged are not for solvers.
  CHECK(writtenPolyMesh(Cells(kShell, Grid::box({-2, -2, -2}, {2, 2, 2}, {16, 16, 16}), 2)).zones.size() == 3);
}

TEST_CASE("polyMesh: of merged cells, an inside that reaches a side of the grid, or that is all there is, stays", "[cellfiles]") {
  const Merged duct(shapes::box({-1, 1.3, 1.3}, {5, 2.7, 2.7}), Grid::box({0, 0, 0}, {4, 4, 4}, {8, 8, 8}), 0);
  CHECK(writtenPolyMesh(duct).cellCount() == duct.open.size());
  CHECK(writtenPolyMesh(duct).zones.size() == 2);
  // Triangles lie in all sides.
  const Merged full(shapes::merged({shapes::cube(0, 4), shapes::flipped(shapes::cube(1.2, 2.8))}),
                    Grid::box({0, 0, 0}, {4, 4, 4}, {8, 8, 8}), 0);
  CHECK(writtenPolyMesh(full).cellCount() == full.open.size());
  CHECK(writtenPolyMesh(full).zones.size() == 2);
}

TEST_CASE("polyMesh: patches of the box's sides and of both sides of the surface", "[cellfiles]") {
  const Cells cells(shapes::quad({0.5, 0.5, 1.5}, {2.5, 0.5, 1.5}, {2.5, 2.5, 1.5}, {0.5, 2.5, 1.5}),
                    Grid::box({0, 0, 0}, {3, 3, 3}, {3, 3, 3}), 0);
  const PolyMesh mesh = writtenPolyMesh(cells);
  std::vector<std::string> names;
  for (const PolyMesh::Patch& patch : mesh.patches) names.push_back(patch.name + ' ' + patch.type);
  CHECK(names ==
        std::vector<std::string>{"xMin patch", "xMax patch", "yMin patch", "yMax patch", "zMin patch", "zMax patch", "surface wall"});
  CHECK(mesh.patch("xMin").faces == 9);
  size_t pieces = 0;
  for (const FaceTag tag : cells.complex.faceTag) pieces += tag == FaceTag::surface;
  CHECK(mesh.patch("surface").faces == 2 * pieces);
  CHECK(mesh.zones.empty());
}

TEST_CASE("polyMesh: a patch for each group, with both sides of its pieces", "[cellfiles]") {
  const Mesh sheet = shapes::quad({0.5, 0.5, 1.5}, {2.5, 0.5, 1.5}, {2.5, 2.5, 1.5}, {0.5, 2.5, 1.5});
  const Mesh mesh = shapes::merged({shapes::cube(0.25, 2), sheet, shapes::cube(1, 2.75)});  // which cross
  TriangleGroups groups{{"first", "sheet", "second", "nothing"}, std::vector<uint32_t>(12, 0)};
  groups.triangleGroup.resize(14, 1);
  groups.triangleGroup.resize(26, 2);
  const Cells cells(mesh, Grid::box({0, 0, 0}, {3, 3, 3}, {3, 3, 3}), 0);
  WriteOptions options;
  options.groups = &groups;
  const PolyMesh grouped = writtenPolyMesh(cells, options), plain = writtenPolyMesh(cells);
  CHECK(grouped.patches.size() == 10);
  const size_t all = plain.patch("surface").faces;
  CHECK(grouped.patch("first").faces + grouped.patch("sheet").faces + grouped.patch("second").faces == all);
  CHECK(grouped.patch("nothing").faces == 0);
  std::map<std::string, size_t> expected;
  for (const int32_t group : arrayOf<int32_t>(vtuOf(cells, true, {}, options), "group")) {
    if (group >= 0) expected[groups.names[size_t(group)]] += 2;
  }
  CHECK(expected.size() == 3);
  for (const auto& [name, faces] : expected) {
    CHECK(grouped.patch(name).faces == faces);
    CHECK(grouped.patch(name).type == "wall");
    CHECK(grouped.patch(name).group == "surface");
  }
  CHECK(grouped.faces.size() == plain.faces.size());
  CHECK(plain.patch("surface").group.empty());
}

TEST_CASE("polyMesh: a face that several groups have is in that of the lowest triangle", "[cellfiles]") {
  const Mesh cube = shapes::cube(0.5, 1.5);
  const Mesh mesh = shapes::merged({cube, shapes::flipped(cube), Mesh{{0.5, 0.5, 0.5, 1, 1, 1, 1.5, 1.5, 1.5}, {0, 1, 2}}});
  TriangleGroups groups{{"cube", "twin", "no area"}, std::vector<uint32_t>(12, 0)};
  groups.triangleGroup.resize(24, 1);
  groups.triangleGroup.push_back(2);
  const Cells cells(mesh, Grid::box({0, 0, 0}, {2, 2, 2}, {2, 2, 2}), 0);
  WriteOptions options;
  options.groups = &groups;
  const PolyMesh polyMesh = writtenPolyMesh(cells, options);
  CHECK(polyMesh.patch("cube").faces == writtenPolyMesh(cells).patch("surface").faces);
  CHECK(polyMesh.patch("twin").faces == 0);
  CHECK(polyMesh.patch("no_area").faces == 0);
}

TEST_CASE("polyMesh: names of groups become words of their own", "[cellfiles]") {
  const Mesh mesh = shapes::cube(0.5, 1.5);
  TriangleGroups groups{{"a b", "a_b", "a/{\"\";}b", "xMin", "inner", "2nd", "frt-fairing:001%1", "T\xc3\xbcr", "a_b_2", "", "surface"},
                        {}};
  for (uint32_t t = 0; t < mesh.triangleCount(); ++t) groups.triangleGroup.push_back(t % uint32_t(groups.names.size()));
  WriteOptions options;
  options.groups = &groups;
  const PolyMesh polyMesh = writtenPolyMesh(Cells(mesh, Grid::box({0, 0, 0}, {2, 2, 2}, {2, 2, 2}), 0), options);
  std::vector<std::string> names;
  for (size_t i = 6; i < polyMesh.patches.size(); ++i) {
    names.push_back(polyMesh.patches[i].name);
    CHECK(polyMesh.patches[i].group.empty());  // one of them is called surface
  }
  CHECK(names == std::vector<std::string>{"a_b_3", "a_b", "a_b_4", "xMin_2", "inner_2", "_2nd", "frt-fairing:001%1", "T_r", "a_b_2", "_",
                                          "surface"});
}

TEST_CASE("polyMesh: groups of another mesh are refused", "[cellfiles]") {
  const Cells cells(kShell, Grid::around(kShell, 5), 2);
  const TemporaryFolder folder;
  const TriangleGroups few{{"a"}, {0, 0}}, unknown{{"a"}, std::vector<uint32_t>(kShell.triangleCount(), 1)};
  for (const TriangleGroups* groups : {&few, &unknown}) {
    WriteOptions options;
    options.groups = groups;
    CHECK(refusal([&] { writePolyMesh(folder.path("a"), cells.cutMesh, cells.complex, options); }).first == Status::badArgument);
    CHECK(refusal([&] { vtuOf(cells, true, {}, options); }).first == Status::badArgument);
  }
}

TEST_CASE("polyMesh: a zone per region, or the cells of some regions only", "[cellfiles]") {
  const Cells cells(kShell, Grid::around(kShell, 6), 2);
  REQUIRE(cells.cutMesh.regionCount == 3);
  const PolyMesh all = writtenPolyMesh(cells);
  REQUIRE(all.zones.size() == 3);
  for (uint32_t r = 0; r < 3; ++r) {
    WriteOptions options;
    options.regions.assign(3, 0);
    options.regions[r] = 1;
    const PolyMesh one = writtenPolyMesh(cells, options);
    CHECK(all.zones[r] == std::pair("region" + std::to_string(r), one.cellCount()));
    CHECK(one.zones.empty());
    double expected = 0;
    for (size_t c = 0; c < cells.complex.cellCount(); ++c) expected += cells.complex.cellRegion[c] == r ? cells.complex.cellVolume[c] : 0;
    const std::vector<double> found = volumes(one);
    CHECK(std::accumulate(found.begin(), found.end(), 0.0) == Approx(expected));
  }
}

TEST_CASE("polyMesh: without untouched cells there is a patch towards them", "[cellfiles]") {
  const Cells cells(kShell, Grid::around(kShell, 12), 0);
  WriteOptions options;
  options.untouched = false;
  const PolyMesh mesh = writtenPolyMesh(cells, options);
  CHECK(mesh.cellCount() == cells.cutMesh.cellCount());
  CHECK(mesh.patch("inner").faces > 0);
}

TEST_CASE("polyMesh: written over another one, or not at all", "[cellfiles]") {
  const Cells cells(kShell, Grid::around(kShell, 6), 2), other(kShell, Grid::around(kShell, 5), 2);
  const TemporaryFolder folder;
  writePolyMesh(folder.path("polyMesh"), cells.cutMesh, cells.complex);
  WriteOptions inside;
  inside.regions = {1, 0, 0};
  writePolyMesh(folder.path("polyMesh"), cells.cutMesh, cells.complex, inside);
  CHECK(readPolyMesh(folder).zones.empty());
  folder.write("file", "");
  CHECK_THROWS_AS(writePolyMesh(folder.path("file"), cells.cutMesh, cells.complex), FileError);
  CHECK(refusal([&] { writePolyMesh(folder.path("a"), cells.cutMesh, other.complex); }).first == Status::badArgument);
  WriteOptions cancelled;
  cancelled.progress = [](const Progress& progress) { return progress.stageIndex < 2; };
  std::filesystem::create_directory(folder.path("b"));
  for (const char* name : {"b", "b/c/polyMesh/", "case/constant/polyMesh"})
    CHECK(refusal([&] { writePolyMesh(folder.path(name), cells.cutMesh, cells.complex, cancelled); }).first == Status::cancelled);
  CHECK(std::filesystem::is_empty(folder.path("b")));
  CHECK(!std::filesystem::exists(folder.path("case")));
}

TEST_CASE("cells and faces are written as .vtu with fields", "[cellfiles]") {
  const Cells cells(kShell, Grid::around(kShell, 3), 2);
  std::vector<double> perCell(cells.complex.cellCount()), perFace(3 * cells.complex.faceCount());
  std::iota(perCell.begin(), perCell.end(), 0.0);
  std::iota(perFace.begin(), perFace.end(), 0.0);
  const Field ofCells[] = {{"pressure", perCell}}, ofFaces[] = {{"velocity", perFace}};

  const std::string cellFile = vtuOf(cells, false, ofCells);
  CHECK(arrayOf<double>(cellFile, "pressure") == perCell);
  CHECK(arrayOf<double>(cellFile, "volume") == cells.complex.cellVolume);
  CHECK(arrayOf<int32_t>(cellFile, "grid_cell") == cells.complex.cellCorner);
  WriteOptions cutOnly;
  cutOnly.untouched = false;
  perCell.resize(cells.complex.cutCells);
  CHECK(arrayOf<double>(vtuOf(cells, false, ofCells, cutOnly), "pressure") == perCell);

  const std::string faceFile = vtuOf(cells, true, ofFaces);
  const std::vector<int32_t> face = arrayOf<int32_t>(faceFile, "face");
  const std::vector<double> velocity = arrayOf<double>(faceFile, "velocity");
  REQUIRE(velocity.size() == 3 * face.size());
  CHECK(face.size() > cells.complex.faceCount());  // those with holes are divided
  for (size_t i = 0; i < velocity.size(); ++i) REQUIRE(velocity[i] == double(3 * face[i / 3]) + double(i % 3));
  CHECK(arrayOf<int64_t>(faceFile, "connectivity").size() == size_t(arrayOf<int64_t>(faceFile, "offsets").back()));

  TriangleGroups groups{{"outer", "a<b"}, std::vector<uint32_t>(kShell.triangleCount() / 2, 0)};
  groups.triangleGroup.resize(kShell.triangleCount(), 1);
  WriteOptions grouped;
  grouped.groups = &groups;
  const std::string groupFile = vtuOf(cells, true, ofFaces, grouped);
  const std::vector<int32_t> group = arrayOf<int32_t>(groupFile, "group"), triangle = arrayOf<int32_t>(faceFile, "triangle");
  REQUIRE(group.size() == triangle.size());
  for (size_t i = 0; i < group.size(); ++i) REQUIRE(group[i] == groups.of(triangle[i]));
  CHECK(arrayOf<double>(groupFile, "velocity") == velocity);
  CHECK(groupFile.find("Name=\"group_names\" NumberOfTuples=\"2\" format=\"ascii\">\n111 117 116 101 114 0\n97 60 98 0\n") !=
        std::string::npos);
  CHECK(faceFile.find("group_names") == std::string::npos);

  CHECK(refusal([&] { vtuOf(cells, true, ofCells); }).first == Status::badArgument);
}

TEST_CASE("untouched grid cells and octree cells with six sides are hexahedra; what meets smaller cells or the surface is a polyhedron",
          "[cellfiles]") {
  const Mesh ball = shapes::icosphere({0.1, 0.05, -0.02}, 0.3, 2);
  const Grid grids[] = {Grid::box({-1, -1, -1}, {1, 1, 1}, {11, 12, 13}),
                        Grid::rectilinear({std::vector<double>{-1, -0.5, -0.1, 0, 0.3, 1}, {-1, 0, 0.5, 1}, {-1, -0.3, 0.2, 0.9, 1}})};
  for (const Grid& grid : grids) {
    for (const int levels : {0, 3}) {
      Cells cells(ball, grid, levels);
      for (const bool merged : {false, true}) {
        if (merged) cells.complex = mergeSmallCells(cells.cutMesh, cells.complex).cells;
        const vtu_files::Vtu vtu(vtuOf(cells, false, {}));
        vtu_files::requireMatching(vtu, grid);
        const auto types = vtu.array<uint8_t>("types");
        const auto faces = vtu_files::cellFaces(vtu);
        size_t hexahedra = 0;
        for (size_t c = 0; c < types.size(); ++c) {
          CAPTURE(c);
          const auto isQuad = [](const vtu_files::Polygon& polygon) { return polygon.size() == 4; };
          const bool isBox = c >= cells.complex.cutCells && faces[c].size() == 6 && std::all_of(faces[c].begin(), faces[c].end(), isQuad);
          if (c >= cells.complex.cutCells) REQUIRE(faces[c].size() == cells.complex.halfFaces(c).size());
          REQUIRE(types[c] == (isBox ? 12 : 42));
          hexahedra += isBox;
        }
        CHECK(hexahedra > 5);
        if (levels > 0 && &grid == grids) CHECK(hexahedra < types.size() - cells.complex.cutCells);
      }
    }
  }
}

TEST_CASE("simple cells lack the faces of a sheet that ends in them, and nothing else", "[cellfiles]") {
  const Mesh sheet = shapes::quad({0.5, 0.5, 1.5}, {2.5, 0.5, 1.5}, {2.5, 2.5, 1.5}, {0.5, 2.5, 1.5});
  const Grid grid = Grid::box({0, 0, 0}, {3, 3, 3}, {3, 3, 3});
  WriteOptions simple;
  simple.simpleCells = true;
  const auto mostFacesAtAnEdge = [](const std::vector<std::vector<vtu_files::Polygon>>& cells) {
    long most = 0;
    for (const std::vector<vtu_files::Polygon>& faces : cells) {
      std::map<std::pair<int64_t, int64_t>, long> edges;
      for (const vtu_files::Polygon& face : faces) {
        for (size_t i = 0; i < face.size(); ++i) most = std::max(most, ++edges[std::minmax(face[i], face[(i + 1) % face.size()])]);
      }
    }
    return most;
  };
  for (const bool merged : {false, true}) {
    Cells cells(sheet, grid, 2);
    if (merged) cells.complex = mergeSmallCells(cells.cutMesh, cells.complex).cells;
    std::string ofCut;
    writeVtu([&](std::string_view piece) { ofCut += piece; }, sheet, cells.cutMesh, simple);
    for (const std::string& file : {vtuOf(cells, false, {}, simple), ofCut}) {
      const vtu_files::Vtu vtu(file);
      vtu_files::requireMatching(vtu, grid);
      CHECK(mostFacesAtAnEdge(vtu_files::cellFaces(vtu)) == 2);
    }
    CHECK(mostFacesAtAnEdge(vtu_files::cellFaces(vtu_files::Vtu(vtuOf(cells, false, {})))) == 4);

    const PolyMesh polyMesh = writtenPolyMesh(cells, simple), all = writtenPolyMesh(cells);
    const std::vector<double> found = volumes(polyMesh), expected = volumes(all);
    REQUIRE(found.size() == expected.size());
    for (size_t c = 0; c < found.size(); ++c) REQUIRE(found[c] == Approx(expected[c]).epsilon(1e-14));
    CHECK(polyMesh.neighbour == all.neighbour);
    size_t separating = 0;
    for (size_t f = 0; f < cells.complex.faceCount(); ++f)
      separating += cells.complex.faceTag[f] == FaceTag::surface && cells.complex.faceCells[2 * f] != cells.complex.faceCells[2 * f + 1];
    CHECK(separating > 0);
    CHECK(polyMesh.patch("surface").faces == 2 * separating);
    CHECK(all.patch("surface").faces > 2 * separating);
  }
}

TEST_CASE("cells that are all hexahedra are written without faces", "[cellfiles]") {
  const Grid grid = Grid::box({0, 0, 0}, {1, 1, 1}, {3, 2, 4});
  Cells cells(shapes::cube(5, 6), grid, 0);
  const vtu_files::Vtu vtu(vtuOf(cells, false, {}));
  CHECK_FALSE(vtu.has("faces"));
  CHECK_FALSE(vtu.has("faceoffsets"));
  CHECK(vtu.array<uint8_t>("types") == std::vector<uint8_t>(24, 12));
  CHECK(vtu.array<int64_t>("connectivity").size() == 8 * 24);
}

TEST_CASE("fields are refused without a name of their own that XML can hold", "[cellfiles]") {
  const Cells cells(kShell, Grid::around(kShell, 3), 2);
  const std::vector<double> perCell(cells.complex.cellCount()), perFace(cells.complex.faceCount());
  const TriangleGroups groups{{"all"}, std::vector<uint32_t>(kShell.triangleCount())};
  WriteOptions options;
  options.groups = &groups;
  const auto statusOf = [&](bool faces, const std::vector<std::string>& names) {
    std::vector<Field> fields;
    for (const std::string& name : names) fields.push_back({name, faces ? perFace : perCell});
    return refusal([&] { vtuOf(cells, faces, fields, options); }).first;
  };
  for (const std::string name : {"a<b", "a>b", "a&b", "a\"b", "", "a\nb", "a\tb", "\x7f", "\x1f"}) {
    CAPTURE(name);
    CHECK(statusOf(false, {name}) == Status::badArgument);
    CHECK(statusOf(true, {name}) == Status::badArgument);
  }
  CHECK(statusOf(false, {std::string("a\0b", 3)}) == Status::badArgument);
  CHECK(statusOf(false, {"a", "b", "a"}) == Status::badArgument);
  for (const char* name : {"grid_cell", "level", "region", "winding", "volume"}) CHECK(statusOf(false, {name}) == Status::badArgument);
  for (const char* name : {"face", "tag", "triangle", "cells", "group"}) CHECK(statusOf(true, {name}) == Status::badArgument);
  CHECK(statusOf(false, {"face", "a b", "p'",
                         "gr\xc3\xb6\xc3\x9f"
                         "e"}) == Status::ok);
  CHECK(statusOf(true, {"volume", "region"}) == Status::ok);
}

TEST_CASE("cells of another cut with equal counts are refused by all writers", "[cellfiles]") {
  const Mesh cube = shapes::cube(0.5, 1.5);
  const Cells here(cube, Grid::box({0, 0, 0}, {2, 2, 2}, {2, 2, 2}), 1);
  const Cells there(shapes::translated(cube, {2, 0, 0}), Grid::box({2, 0, 0}, {4, 2, 2}, {2, 2, 2}), 1);
  REQUIRE(here.complex.cellCount() == there.complex.cellCount());
  const TemporaryFolder folder;
  const Sink nowhere = [](std::string_view) {};
  CHECK(refusal([&] { writeVtu(nowhere, here.cutMesh, there.complex, {}, {}); }).first == Status::badArgument);
  CHECK(refusal([&] { writeFacesVtu(nowhere, here.cutMesh, there.complex, {}, {}); }).first == Status::badArgument);
  CHECK(refusal([&] { writeJson(nowhere, here.cutMesh, there.complex, {}); }).first == Status::badArgument);
  CHECK(refusal([&] { writePolyMesh(folder.path("polyMesh"), here.cutMesh, there.complex); }).first == Status::badArgument);
  CHECK(folder.fileCount() == 0);
}

TEST_CASE("Cells as JSON: with the triangles and groups of faces", "[cellfiles]") {
  const Cells cells(shapes::cube(0.5, 1.5), Grid::box({0, 0, 0}, {2, 2, 2}, {2, 2, 2}), 1);
  const TriangleGroups groups{{"a", "b"}, {0, 0, 1, 1, 0, 0, 1, 1, 0, 0, 1, 1}};
  const auto jsonOf = [](const CutMesh& cutMesh, const CellComplex& complex, const WriteOptions& options = {}) {
    std::string text;
    writeJson([&](std::string_view piece) { text += piece; }, cutMesh, complex, options);
    return text;
  };
  const std::string plain = jsonOf(cells.cutMesh, cells.complex);
  WriteOptions options;
  options.groups = &groups;
  const std::string grouped = jsonOf(cells.cutMesh, cells.complex, options);
  const std::string start = "{\"format\":\"mandoline-cell-complex\",\n\"version\":1,\n\"cutVertices\":", end = "}\n";
  CHECK(plain.substr(0, start.size()) == start);
  CHECK(plain.find(",\n\"faceTriangle\":[") != std::string::npos);
  CHECK(grouped ==
        plain.substr(0, plain.size() - end.size()) + ",\n\"groupNames\":[\"a\",\"b\"],\n\"triangleGroup\":[0,0,1,1,0,0,1,1,0,0,1,1]" + end);

  const Cells others(shapes::cube(0.5, 1.5), Grid::box({0, 0, 0}, {2, 2, 2}, {3, 3, 3}), 1);
  CHECK(refusal([&] { jsonOf(others.cutMesh, cells.complex); }).first == Status::badArgument);
  options.untouched = false;
  CHECK(refusal([&] { jsonOf(cells.cutMesh, cells.complex, options); }).first == Status::badArgument);
}

TEST_CASE("Cells as JSON: what no double can hold is null", "[cellfiles]") {
  const Cells cells(shapes::cube(0.5e150, 1.5e150), Grid::box({0, 0, 0}, {2e150, 2e150, 2e150}, {2, 2, 2}), 1);
  std::string text;
  writeJson([&](std::string_view piece) { text += piece; }, cells.cutMesh, cells.complex, {});
  CHECK(text.find("\"cellVolume\":[null,") != std::string::npos);
  CHECK(text.find("nan") == std::string::npos);
  CHECK(text.find("inf") == std::string::npos);
}

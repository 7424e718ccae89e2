// The command line writes closed surfaces of what is inside, as the library makes them, and says what tells inside from outside.
#ifdef MANDOLINE_CLI

#include <optional>

#include "catch.h"
#include "command_line.h"
#include "mandoline/io.h"
#include "mandoline/mandoline.h"
#include "mesh_folder.h"
#include "shapes.h"

using namespace mandoline;

namespace {

std::string fileOf(const Mesh& mesh) {
  std::string text;
  writeMesh([&](std::string_view piece) { text += piece; }, FileFormat::obj, mesh);
  return text;
}

Mesh openBox() {
  Mesh mesh = shapes::box({9, 1, 1}, {11, 3, 3});
  mesh.triangles.resize(mesh.triangles.size() - 3);
  return mesh;
}

/// A closed box, one with a triangle turned, and one without a triangle.
Mesh village() {
  Mesh turned = shapes::box({5, 1, 1}, {7, 3, 3});
  std::swap(turned.triangles[0], turned.triangles[1]);
  return shapes::merged({shapes::cube(1, 3), turned, openBox()});
}

const std::vector<std::string> kGrid = {"--box", "0,0,0,12,4,4", "--cells", "12,4,4"};

Outcome inGrid(const TemporaryFolder& folder, std::vector<std::string> words) {
  words.insert(words.end(), kGrid.begin(), kGrid.end());
  return run(folder, words);
}

}  // namespace

TEST_CASE("Command line: the boundary of what is inside is closed, and the library's", "[cli]") {
  const TemporaryFolder folder;
  const Mesh mesh = village();
  const std::string path = folder.write("village.obj", fileOf(mesh)), solid = folder.path("solid.obj");
  const Grid grid = Grid::box({0, 0, 0}, {12, 4, 4}, {12, 4, 4});
  const CutMesh estimated = estimateInside(mesh, cut(mesh, grid).mesh);
  const auto check = [&](const std::vector<uint8_t>& isInside) {
    const Mesh written = readMesh(solid), expected = boundary(estimated, isInside);
    CHECK(written.positions == expected.positions);
    CHECK(written.triangles == expected.triangles);
    CHECK(shapes::openEdges(written) == 0);
    return shapes::signedVolume(written);
  };
  const Outcome o = inGrid(folder, {"boundary", path, "-o", solid, "--report", "-"});
  REQUIRE(o.exitCode == 0);
  const std::vector<uint8_t> isInside = insideRegions(estimated, {WindingRule::nonZero}).isInside;
  CHECK(check(isInside) == 24);
  CHECK(
      contains(o.err,
               "Note: 1 of 3 parts not consistently oriented: inside by parity; 1 of 3 parts open, with 3 open edges around 1 hole: inside "
               "by an estimate\n"));
  const std::string report = inOneLine(o.out);
  CHECK(contains(report, "\"status\": \"ok\""));
  CHECK(contains(report, "\"parts\": {\"winding\": 1, \"parity\": 1, \"open\": 1, \"openEdges\": 3, \"holes\": 1}"));
  CHECK(contains(report, "\"inside\": {\"by\": \"estimate\", \"complete\": true}, \"triangles\": " +
                             std::to_string(readMesh(solid).triangleCount()) + "}"));

  REQUIRE(inGrid(folder, {"boundary", path, "--only", "outside", "-o", solid}).exitCode == 0);
  std::vector<uint8_t> isOutside;
  for (const uint8_t is : isInside) isOutside.push_back(!is);
  CHECK(check(isOutside) == 12 * 4 * 4 - 24);
  const Outcome one = inGrid(folder, {"boundary", path, "--only", "region=0", "--inside-threshold", "0.5", "-o", solid});
  REQUIRE(one.exitCode == 0);
  std::vector<uint8_t> isFirst(estimated.regionCount, 0);
  isFirst[0] = 1;
  check(isFirst);
  CHECK(contains(one.out, "Boundary of 1 of " + std::to_string(estimated.regionCount) + " regions\nTriangles written: "));
}

TEST_CASE("Command line: the boundary goes to standard output and into every format of meshes", "[cli]") {
  const TemporaryFolder folder;
  const std::string path = folder.write("open.obj", fileOf(openBox()));
  const Outcome o = inGrid(folder, {"boundary", path, "-o", "-", "--format", "off"});
  REQUIRE(o.exitCode == 0);
  CHECK(contains(o.err, "Boundary of "));
  const Mesh written = readMesh(std::span(o.out.data(), o.out.size()), "a.off");
  CHECK(written.triangleCount() > 0);
  CHECK(shapes::openEdges(written) == 0);
  for (const std::string name : {"a.stl", "a.ply", "a.off"}) {
    REQUIRE(inGrid(folder, {"boundary", path, "-o", folder.path(name)}).exitCode == 0);
    CHECK(readMesh(folder.path(name)).triangleCount() == written.triangleCount());
  }
}

TEST_CASE("Command line: where nothing is inside there is no boundary, and the report says why", "[cli]") {
  const TemporaryFolder folder;
  const std::string sheet = folder.write("sheet.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n"), stl = folder.path("a.stl");
  const Outcome o = run(folder, {"boundary", sheet, "-o", stl, "--report", "-"});
  CHECK(o.exitCode == 1);
  const std::string message =
      "Nothing is inside: 1 of 1 part open, with 3 open edges around 1 hole: inside by an estimate. With a lower --inside-threshold more "
      "counts as inside.";
  CHECK(o.err == "mandoline: " + sheet + ": nothingInside: " + message + "\n");
  CHECK(contains(o.out, "\"status\": \"nothingInside\",\n  \"message\": \"" + message + "\""));
  CHECK(contains(o.out, "\"triangles\": 0\n}"));
  CHECK_FALSE(std::filesystem::exists(stl));
  const std::string cube = folder.write("cube.obj", fileOf(shapes::cube(1, 3)));
  const Outcome apart = run(folder, {"boundary", cube, "--box", "7,7,7,8,8,8", "-o", stl});
  CHECK(apart.exitCode == 1);
  CHECK(contains(apart.err, "nothingInside: Nothing is inside.\n"));
  const Outcome only = run(folder, {"boundary", cube, "--only", "cut", "-o", stl});
  CHECK(only.exitCode == 2);
  CHECK(contains(only.err, "--only cut: a boundary is that of whole regions"));
}

TEST_CASE("Command line: of a mesh that is open, or has one side, it is told what can be done", "[cli]") {
  const TemporaryFolder folder;
  const std::string strip = folder.write("strip.obj", fileOf(shapes::moebius({0, 0, 0}, 1, 0.4, 12))), obj = folder.path("a.obj");
  const Outcome turned = run(folder, {"cut", strip, "--cells", "6", "--orient"});
  CHECK(turned.exitCode == 0);
  CHECK(contains(turned.out, "Oriented: 0 triangles turned; 1 one-sided patch can't be oriented\n"));
  CHECK(contains(turned.out, "around 1 hole: left out)\n"));
  CHECK(contains(turned.out, "\n  --inside-threshold 0.5 estimates what is inside of open parts\n"));
  const Outcome estimated = run(folder, {"cut", strip, "--cells", "6", "--inside-threshold", "1"});
  CHECK(estimated.exitCode == 0);
  CHECK_FALSE(contains(estimated.out, "--inside-threshold"));
  CHECK(contains(run(folder, {"info", strip}).out, "--orient turns one of them, but for one-sided surfaces\n"));
  const Outcome resolved = run(folder, {"resolve", strip, "--rule", "odd", "-o", obj});
  CHECK(resolved.exitCode == 1);
  CHECK(contains(resolved.err, "around 1 hole: left out. 'mandoline boundary' closes it by an estimate.\n"));
  CHECK(run(folder, {"boundary", strip, "--cells", "6", "-o", obj}).exitCode == 0);
  CHECK(shapes::openEdges(readMesh(obj)) == 0);
  for (const std::string threshold : {"nan", "2", "-1", "0", "inf", "half"}) {
    const Outcome o = run(folder, {"boundary", strip, "--inside-threshold", threshold, "-o", obj});
    CHECK(o.exitCode == 2);
    CHECK(contains(o.err, "--inside-threshold needs a number above 0 and at most 1, not '" + threshold + "'"));
  }
}

TEST_CASE("Command line: a file without triangles is told by every command", "[cli]") {
  const TemporaryFolder folder;
  const std::string empty = folder.write("empty.obj", ""), point = folder.write("point.obj", "v 0 0 0\n"), stl = folder.path("a.stl");
  for (const std::string command : {"cut", "info", "boundary", "resolve"}) {
    const std::vector<std::string> output = {"-o", command == "info" ? folder.path("a.obj") : stl};
    const auto on = [&](const std::string& mesh) {
      std::vector<std::string> words = {command, mesh};
      words.insert(words.end(), output.begin(), output.end());
      return run(folder, words);
    };
    const Outcome none = on(empty), without = on(point);
    CHECK(none.exitCode == 2);
    CHECK(contains(none.err, "empty.obj: the file is empty"));
    CHECK(without.exitCode == (command == "info" ? 0 : 1));
    CHECK(contains(without.err, command == "info" ? "" : "point.obj: emptyMesh: The mesh has no triangles."));
  }
}

TEST_CASE("Command line: boundaries of ten open scans are closed", "[scans]") {
  const std::optional<std::filesystem::path> meshes = meshFolder();
  if (!meshes) return;
  const TemporaryFolder folder;
  const std::string solid = folder.path("solid.obj");
  size_t scans = 0;
  for (const auto& entry : std::filesystem::directory_iterator(*meshes)) {
    if (scans == 10 || entry.path().extension() != ".gz") continue;
    const Mesh mesh = readMesh(entry.path().string());
    if (mesh.triangleCount() > 30000 || mesh.triangleCount() < 1000 || inspect(mesh).openEdges == 0) continue;
    const Outcome o = run(folder, {"boundary", entry.path().string(), "--cells", "20", "-o", solid, "--report", "-"});
    if (!contains(inOneLine(o.out), "\"by\": \"estimate\", \"complete\": true")) continue;
    if (contains(o.out, "nothingInside")) continue;  // a flat sheet
    ++scans;
    INFO(entry.path().filename().string());
    CHECK(o.exitCode == 0);
    const Mesh written = readMesh(solid);
    CHECK(written.triangleCount() > 0);
    CHECK(shapes::openEdges(written) == 0);
  }
  CHECK(scans == 10);
}

#endif

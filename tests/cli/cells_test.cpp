// Which cells mandoline cut writes, and what becomes of them: regions, octree cells, refined and merged ones, patches.
#ifdef MANDOLINE_CLI

#include "catch.h"
#include "command_line.h"
#include "cubes.h"
#include "mandoline/io.h"
#include "shapes.h"

TEST_CASE("Command line: only some cells are written", "[cli]") {
  const TemporaryFolder folder;
  const std::string mesh = folder.write("cube.obj", kCube), vtu = folder.path("a.vtu");
  const auto cells = [&](const std::string& only) {
    const Outcome o = run(folder, {"cut", mesh, "--cells", "4", "--box", "0,0,0,4,4,4", "--only", only, "-o", vtu});
    CAPTURE(o.err);
    REQUIRE(o.exitCode == 0);
    const std::string text = folder.read("a.vtu");
    return std::stoi(text.substr(text.find("NumberOfCells=\"") + 15));
  };
  REQUIRE(cells("inside") == 8);
  REQUIRE(cells("outside") == 56);
  REQUIRE(cells("region=0") == 56);
  REQUIRE(cells("region=0,region=1") == 64);
  REQUIRE(cells("cut") == 32);
  REQUIRE(cells("cut,outside") == 24);
  const Outcome none = run(folder, {"cut", mesh, "--only", "region=2", "-o", vtu});
  REQUIRE(none.exitCode == 2);
  REQUIRE(contains(none.err, "--only: there is no region 2; there are 2"));
  const std::string sheet = folder.write("sheet.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n");
  const Outcome open = run(folder, {"cut", sheet, "--only", "inside", "-o", vtu});
  REQUIRE(open.exitCode == 2);
  REQUIRE(
      contains(open.err, "--only inside: nothing is inside (1 of 1 part open, with 3 open edges around 1 hole: inside by an estimate)"));
  const std::vector<std::string> nothing[] = {{"cut", mesh, "--only", "inside,region=0", "-o", vtu},
                                              {"cut", mesh, "--only", "cut", "--box", "7,7,7,8,8,8", "-o", vtu},
                                              {"slice", mesh, "--heights", "2", "--only", "outside,region=1", "-o", folder.path("a.svg")}};
  std::filesystem::remove(vtu);
  for (const std::vector<std::string>& words : nothing) {
    const Outcome o = run(folder, words);
    CHECK(o.exitCode == 2);
    CHECK(contains(o.err, "--only selects nothing of the "));
    CHECK_FALSE(std::filesystem::exists(words.back()));
  }
}

TEST_CASE("Command line: what is inside of a mesh that is not closed, and by what", "[cli]") {
  const TemporaryFolder folder;
  using namespace shapes;
  Mesh turned = box({5, 1, 1}, {7, 3, 3});
  std::swap(turned.triangles[0], turned.triangles[1]);
  Mesh open = box({9, 1, 1}, {11, 3, 3});
  open.triangles.resize(open.triangles.size() - 3);
  const Mesh village = merged({cube(1, 3), turned, open});
  std::string text;
  mandoline::writeMesh([&](std::string_view piece) { text += piece; }, mandoline::FileFormat::obj, village);
  const std::string mesh = folder.write("village.obj", text), report = folder.path("report.json"), svg = folder.path("village.svg");
  const std::vector<std::string> grid = {"--box", "0,0,0,12,4,4", "--cells", "12,4,4"};
  const auto inGrid = [&](std::vector<std::string> words) {
    words.insert(words.end(), grid.begin(), grid.end());
    return run(folder, words);
  };
  const std::string note = "1 of 3 parts not consistently oriented: inside by parity; 1 of 3 parts open, with 3 open edges around 1 hole: ";
  const Outcome plain = inGrid({"cut", mesh, "--report", report});
  REQUIRE(plain.exitCode == 0);
  const std::string exact = inOneLine(folder.read("report.json"));
  for (const char* part : {"\"parts\": {\"winding\": 1, \"parity\": 1, \"open\": 1, \"openEdges\": 3, \"holes\": 1}",
                           "\"inside\": {\"by\": \"parity\", \"complete\": false}",
                           "\"partWinding\": 1, \"parity\": 1, \"insideness\": null, \"inside\": true",
                           "\"partWinding\": 0, \"parity\": 1, \"insideness\": null, \"inside\": true"}) {
    CHECK(contains(exact, part));
  }
  const Outcome sliced = inGrid({"slice", mesh, "--heights", "2.125", "-o", svg});
  REQUIRE(sliced.exitCode == 0);
  CHECK(contains(sliced.err, "Note: " + note + "inside by an estimate"));
  CHECK(contains(folder.read("village.svg"), "<path data-region="));
  const Outcome estimated = inGrid({"cut", mesh, "--inside-threshold", "0.5", "--validate", "--report", report});
  REQUIRE(estimated.exitCode == 0);
  CHECK(contains(inOneLine(folder.read("report.json")), "\"inside\": {\"by\": \"estimate\", \"complete\": true}"));
  CHECK(inGrid({"cut", mesh, "--inside-threshold", "0"}).exitCode == 2);
  const Outcome resolved = run(folder, {"resolve", mesh, "--rule", "positive", "-o", folder.path("solid.obj")});
  REQUIRE(resolved.exitCode == 0);
  CHECK(contains(resolved.err, "Note: " + note + "left out"));
  CHECK(contains(resolved.err, "Triangles written: 24"));
}

TEST_CASE("Command line: one file for each region", "[cli]") {
  const TemporaryFolder folder;
  const std::string mesh = folder.write("cube.obj", kCube);
  const auto cut = [&](std::vector<std::string> words) {
    words.insert(words.begin(), {"cut", mesh, "--cells", "4", "--box", "0,0,0,4,4,4", "-o"});
    return run(folder, words);
  };
  REQUIRE(cut({folder.path("part-{region}.stl")}).exitCode == 0);
  for (const std::string part : {"part-0.stl", "part-1.stl"}) {
    const Outcome info = run(folder, {"info", folder.path(part), "--report", "-"});
    REQUIRE(contains(info.out, "\"oriented\": true"));
    REQUIRE(contains(info.out, "\"max\": [3, 3, 3]"));
  }
  REQUIRE(cut({folder.path("only-{region}.ply"), "--only", "inside"}).exitCode == 0);
  REQUIRE_FALSE(std::filesystem::exists(folder.path("only-0.ply")));
  REQUIRE(contains(run(folder, {"info", folder.path("only-1.ply")}).out, "yes, consistently oriented"));
  const Outcome clash = cut({folder.path("x-{region}.stl"), folder.path("x-1.stl")});
  REQUIRE(clash.exitCode == 2);
  REQUIRE(contains(clash.err, "are the same file"));
}

TEST_CASE("Command line: octree cells, OpenFOAM and saved cut-meshes", "[cli]") {
  const TemporaryFolder folder;
  const std::string mesh = folder.write("cube.obj", kCube);
  const std::string vtu = folder.path("a.vtu"), foam = folder.path("case/constant/polyMesh/"), saved = folder.path("a.mcm");
  const Outcome o = run(folder, {"cut", mesh, "--cells", "12", "--coarsen", "2", "-o", vtu, foam, saved});
  REQUIRE(o.err.empty());
  REQUIRE(o.exitCode == 0);
  CHECK(contains(folder.read("a.vtu"), "Name=\"level\""));
  for (const char* name : {"points", "faces", "owner", "neighbour", "boundary", "cellZones"}) {
    CHECK(contains(folder.read(std::string("case/constant/polyMesh/") + name), "FoamFile"));
  }
  CHECK(mandoline::readCutMesh(saved).regionCount == 2);
  const std::string graded = folder.path("graded.vtu");
  REQUIRE(run(folder, {"cut", mesh, "--cells", "12", "--coarsen", "2,2", "-o", graded}).exitCode == 0);
  CHECK(folder.read("graded.vtu").size() > folder.read("a.vtu").size());
  REQUIRE(run(folder, {"cut", mesh, "--only", "outside", "-o", foam}).exitCode == 0);
  CHECK(!std::filesystem::exists(foam + "cellZones"));
}

TEST_CASE("Command line: cells refined where the mesh bends and in boxes", "[cli]") {
  const TemporaryFolder folder;
  const std::string mesh = folder.write("cube.obj", kCube), vtu = folder.path("a.vtu"), foam = folder.path("polyMesh");
  const auto cells = [&](std::vector<std::string> words) {
    words.insert(words.begin(), {"flow", mesh, "--wind", "1,0,0", "--cells", "10", "--merge", "0", "-o", vtu, "--report", "-"});
    const Outcome o = run(folder, words);
    REQUIRE(o.exitCode == 0);
    const std::string out = inOneLine(o.out);
    return std::stoul(out.substr(out.find("\"cells\": ", out.find("\"cutCells\"")) + 9));
  };
  const size_t plain = cells({}), bent = cells({"--refine", "1"}), all = cells({"--refine", "1,0"});
  CHECK(plain < bent);
  CHECK(bent < all);
  const size_t inBox = cells({"--refine-box", "0,0,0,1.1,1.1,1.1,2"});
  CHECK(plain < inBox);
  CHECK(inBox < cells({"--refine-box", "0,0,0,1.1,1.1,1.1,2", "--refine-box=2,2,2,4,4,4,1"}));
  const Outcome o =
      run(folder, {"cut", mesh, "--cells", "8", "--refine", "1", "--coarsen", "1", "--merge", "0.2", "--only", "all", "-o", foam, vtu});
  CHECK(o.err.empty());
  CHECK(o.exitCode == 0);
  CHECK(contains(folder.read("polyMesh/faces"), "FoamFile"));
  const std::string obj = folder.path("lines.obj");
  CHECK(run(folder, {"flow", mesh, "--wind", "1,0,0", "--cells", "8", "--refine", "1", "--streamlines", "9", "-o", obj}).exitCode == 0);
  CHECK(contains(folder.read("lines.obj"), "\nl "));
}

TEST_CASE("Command line: small cells merged, and how many stay small", "[cli]") {
  const TemporaryFolder folder;
  const std::string mesh = folder.write("cube.obj", kCube), vtu = folder.path("a.vtu"), foam = folder.path("polyMesh");
  const auto inGrid = [&](std::vector<std::string> words) {
    words.insert(words.end(), {"--origin", "-0.9,-0.9,-0.9", "--spacing", "1", "--cells", "5"});
    return run(folder, words);
  };
  // The cube from 1 to 3 has cells of 0.1, 1 and 0.9 along each axis.
  const Outcome o = inGrid({"cut", mesh, "--merge", "0.2", "-o", vtu, foam, "--report", "-"});
  REQUIRE(o.exitCode == 0);
  CHECK(contains(inOneLine(o.out), "\"merge\": {\"before\": 151, \"after\": "));
  CHECK(contains(inOneLine(o.out), "\"pockets\": 0}"));
  CHECK(contains(inGrid({"cut", mesh, "--merge", "0.2", "-o", vtu}).out, "Merging of small cells"));
  CHECK(contains(inOneLine(inGrid({"cut", mesh, "-o", vtu, "--report", "-"}).out), "\"merge\": null"));
  const auto flow = [&](std::vector<std::string> words) {
    words.insert(words.begin(), {"flow", mesh, "--wind", "1,0,0", "-o", vtu, "--report", "-"});
    return inOneLine(inGrid(words).out);
  };
  CHECK(contains(flow({}), "\"merge\": {\"before\": 151, "));
  CHECK(contains(flow({"--merge", "0"}), "\"merge\": null"));
  CHECK(contains(flow({"--merge", "0"}), "\"cells\": 151, "));
}

TEST_CASE("Command line: polyMeshes of merged cells are without what no side of the grid bounds, unless all is asked for", "[cli]") {
  const TemporaryFolder folder;
  const std::string mesh = folder.write("cube.obj", kCube), foam = folder.path("polyMesh"), vtu = folder.path("a.vtu");
  const auto cut = [&](std::vector<std::string> words) {
    words.insert(words.begin(), {"cut", mesh, "--origin", "-0.9,-0.9,-0.9", "--spacing", "1", "--cells", "5", "--report", "-", "-o", foam});
    const Outcome o = run(folder, words);
    CAPTURE(o.err);
    REQUIRE(o.exitCode == 0);
    return o.err;
  };
  const auto hasInside = [&] { return contains(folder.read("polyMesh/cellZones"), "region1\n"); };
  const std::string note = "polyMesh is without 1 of 2 regions: no side of the grid bounds them";
  CHECK_FALSE(contains(cut({"--merge", "0.2", "--only", "all"}), "Note:"));
  CHECK(hasInside());
  std::filesystem::remove_all(foam);
  CHECK(contains(cut({"--merge", "0.2"}), note));
  CHECK_FALSE(std::filesystem::exists(folder.path("polyMesh/cellZones")));
  CHECK_FALSE(contains(cut({"--merge", "0.2", "--only", "inside"}), note));
  CHECK_FALSE(contains(cut({}), note));
  CHECK(hasInside());
  const Outcome flow = run(folder, {"flow", mesh, "--wind", "1,0,0", "--cells", "8", "--only", "all", "-o", vtu});
  CHECK(flow.exitCode == 2);
  CHECK(contains(flow.err, "--only all: only cut leaves regions out, of polyMeshes"));
}

TEST_CASE("Command line: groups of the input are patches, and stay through resolve", "[cli]") {
  const TemporaryFolder folder;
  const std::string mesh = folder.write("cubes.obj", "g left\n" + kCube + "g right side\n" + kCrossingCube);
  const Outcome cut = run(folder, {"cut", mesh, "--cells", "5", "-o", folder.path("polyMesh"), "--report", "-"});
  REQUIRE(cut.exitCode == 0);
  const std::string groups = "\"groups\": [{\"name\": \"left\", \"triangles\": 12}, {\"name\": \"right\", \"triangles\": 12}]";
  CHECK(contains(cut.out, groups));
  CHECK(contains(run(folder, {"info", mesh, "--report", "-"}).out, groups));
  CHECK(contains(run(folder, {"info", mesh}).out, "12  right\n"));
  CHECK(contains(folder.read("polyMesh/boundary"), "left\n{\n    type wall;"));
  CHECK(contains(folder.read("polyMesh/boundary"), "right\n{\n    type wall;"));
  CHECK(folder.read("polyMesh/boundary").find("surface\n{") == std::string::npos);
  REQUIRE(run(folder, {"cut", mesh, "--cells", "5", "--faces", "-o", folder.path("faces.vtu")}).exitCode == 0);
  CHECK(contains(folder.read("faces.vtu"), "Name=\"group\""));
  CHECK(contains(folder.read("faces.vtu"), "Name=\"group_names\""));

  REQUIRE(run(folder, {"resolve", mesh, "-o", folder.path("resolved.obj")}).exitCode == 0);
  const auto [resolved, kept] = mandoline::readGroupedMesh(folder.path("resolved.obj"));
  CHECK(resolved.triangleCount() > 24);
  CHECK(kept.names == std::vector<std::string>{"left", "right"});
  for (size_t t = 0; t < resolved.triangleCount(); ++t) {  // each on the cube of its group
    bool lies = false;
    for (size_t d = 0; d < 3; ++d) {
      for (const double plane : {1.0, 3.0}) {
        bool all = true;
        for (size_t i = 0; i < 3; ++i) {
          all = all && resolved.positions[3 * size_t(resolved.triangles[3 * t + i]) + d] == plane + double(kept.triangleGroup[t]);
        }
        lies = lies || all;
      }
    }
    REQUIRE(lies);
  }
  REQUIRE(run(folder, {"resolve", mesh, "--rule", "positive", "-o", folder.path("solid.obj")}).exitCode == 0);
  CHECK(mandoline::readGroupedMesh(folder.path("solid.obj")).groups.empty());
}

#endif

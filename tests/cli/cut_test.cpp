// mandoline cut: its report and its files.
#ifdef MANDOLINE_CLI

#include "catch.h"
#include "command_line.h"
#include "cubes.h"

TEST_CASE("Command line: a cut writes its report and every file", "[cli]") {
  const TemporaryFolder folder;
  const std::string mesh = folder.write("cube.obj", kCube);
  const Outcome o = run(folder, {"cut", mesh, "--cells", "4", "--box", "0,0,0,4,4,4", "--validate", "--report", "-", "-o",
                                 folder.path("a.json"), folder.path("a.vtu"), "-o", folder.path("a.obj"), "--threads", "1"});
  CAPTURE(o.out, o.err);
  REQUIRE(o.exitCode == 0);
  REQUIRE(o.err.empty());
  REQUIRE(o.out.substr(0, 2) == "{\n");
  for (const std::string part :
       {"\"status\": \"ok\"", "\"cells\": [4, 4, 4]", "\"origin\": [0, 0, 0]", "\"spacing\": [1, 1, 1]", "\"cells\": 64", "\"regions\": 2",
        "{\"id\": 0, \"winding\": 0, \"volume\": 56,", "{\"id\": 1, \"winding\": 1, \"volume\": 8,",
        "{\"stage\": \"input\", \"ms\": ", "\"totalMs\": ", "\"exactFallbacks\": ", "\"peakMemoryBytes\": ", "\"validation\": {",
        "\"pass\": true", "\"checks\": [", "\"closed\": true"}) {
    REQUIRE(contains(o.out, part));
  }
  REQUIRE_FALSE(contains(o.out, "\"pass\": false"));
  for (const std::string name : {"a.json", "a.vtu", "a.obj"}) REQUIRE(folder.read(name).size() > 100);
  REQUIRE(folder.fileCount() == 7);  // the mesh, its three products and the standard streams
}

TEST_CASE("Command line: without --report the report is text", "[cli]") {
  const TemporaryFolder folder;
  const std::string mesh = folder.write("cube.obj", kCube);
  const Outcome o = run(folder, {"cut", mesh, "--cells", "4,4,4", "--box", "0,0,0,4,4,4", "--validate"});
  REQUIRE(o.exitCode == 0);
  REQUIRE(o.err.empty());
  for (const std::string part : {"8 vertices, 12 triangles", "4 x 4 x 4 cells", "Regions", "56", "Stages", "Validation: pass"})
    REQUIRE(contains(o.out, part));
  const Outcome quiet = run(folder, {"cut", mesh, "--report", folder.path("report.json")});
  REQUIRE(quiet.exitCode == 0);
  REQUIRE(quiet.out.empty());
  REQUIRE(contains(folder.read("report.json"), "\"validation\": null"));
}

TEST_CASE("Command line: of volumes that doubles can't hold the report has none", "[cli]") {
  const TemporaryFolder folder;
  const std::string mesh = folder.write("far.obj", "v 0 0 0\nv 1e104 0 0\nv 0 1e104 0\nv 0 0 1e104\nf 1 3 2\nf 1 2 4\nf 1 4 3\nf 2 3 4\n");
  const std::string text = run(folder, {"cut", mesh, "--cells", "4"}).out;
  CHECK(contains(text, "         1       yes               -\n"));
  CHECK_FALSE(contains(text, "nan"));
  CHECK(contains(run(folder, {"cut", mesh, "--cells", "4", "--report", "-"}).out, "{\"id\": 0, \"winding\": 1, \"volume\": null,"));
}

TEST_CASE("Command line: default grids", "[cli]") {
  const TemporaryFolder folder;
  const std::string mesh = folder.write("cube.obj", kCube);
  REQUIRE(contains(run(folder, {"cut", mesh, "--report", "-"}).out, "\"cells\": [32, 32, 32]"));
  const std::string counts = run(folder, {"cut", mesh, "--cells", "3,4,5", "--report", "-"}).out;
  REQUIRE(contains(counts, "\"cells\": [3, 4, 5]"));
  REQUIRE(contains(counts, "\"origin\": [0.9, 0.9, 0.9]"));
}

TEST_CASE("Command line: a mesh that can't be cut exits with 1 and reports why", "[cli]") {
  const TemporaryFolder folder;
  const std::string mesh = folder.write("nan.obj", "v 0 0 0\nv 1 0 0\nv 0 nan 0\nf 1 2 3\n");
  const Outcome o = run(folder, {"cut", mesh, "--report", folder.path("report.json"), "-o", folder.path("a.json")});
  REQUIRE(o.exitCode == 1);
  REQUIRE(o.out.empty());
  REQUIRE(contains(o.err, "mandoline: " + mesh + ": nonFiniteCoordinate: "));
  REQUIRE(contains(folder.read("report.json"), "\"status\": \"nonFiniteCoordinate\""));
  REQUIRE(contains(folder.read("report.json"), "\"element\": 2,"));
  REQUIRE_FALSE(std::filesystem::exists(folder.path("a.json")));
  const Outcome text = run(folder, {"cut", folder.write("empty.obj", "v 0 0 0\n")});
  REQUIRE(text.exitCode == 1);
  REQUIRE(contains(text.out, "Not cut: emptyMesh"));
}

TEST_CASE("Command line: reports that can't be written exit with 2, but do not keep files from it", "[cli]") {
  const TemporaryFolder folder;
  const std::string mesh = folder.write("cube.obj", kCube);
  const Outcome o = run(folder, {"cut", mesh, "--report", "/dev/full", "-o", folder.path("a.json")});
  REQUIRE(o.exitCode == 2);
  REQUIRE(contains(o.err, "mandoline: /dev/full: can't be written: No space left on device"));
  REQUIRE(std::filesystem::exists(folder.path("a.json")));
}

TEST_CASE("Command line: where there is no folder for the report, nothing else is done", "[cli]") {
  const TemporaryFolder folder;
  const std::string mesh = folder.write("cube.obj", kCube), report = folder.path("none/report.json"), obj = folder.path("a.obj");
  std::vector<std::vector<std::string>> commands{{"cut", mesh, "-o", obj},
                                                 {"cut", mesh, "--stream", "-o", folder.path("pieces")},
                                                 {"slice", mesh, "--heights", "2", "-o", obj},
                                                 {"boundary", mesh, "-o", obj},
                                                 {"info", mesh, "-o", obj},
                                                 {"resolve", mesh, "-o", obj},
                                                 {"cut", folder.path("missing.obj")}};
#ifdef MANDOLINE_HAVE_OPERATORS
  commands.push_back({"flow", mesh, "--cells", "6", "--wind", "1,0,0", "-o", obj});
  commands.push_back({"flow", mesh, "--cells", "6", "--wind", "1,0,0", "--steps", "1", "-o", folder.path("a.vtu")});
#endif
  for (std::vector<std::string>& words : commands) {
    words.insert(words.end(), {"--report", report});
    const Outcome o = run(folder, words);
    CAPTURE(words);
    CHECK(o.exitCode == 2);
    CHECK(o.err == "mandoline: " + report + ": there is no folder " + folder.path("none") + "\n");
    CHECK(o.out.empty());
  }
  CHECK(folder.fileCount() == 4);  // the mesh and the standard streams
  CHECK(contains(run(folder, {"cut", mesh, "--report", folder.path("")}).err, ": is a directory\n"));
}

TEST_CASE("Command line: a file that can't be written does not keep others from it", "[cli]") {
  const TemporaryFolder folder;
  const std::string mesh = folder.write("cube.obj", kCube), full = folder.path("full.obj"), other = folder.path("other.obj");
  std::filesystem::create_symlink("/dev/full", full);
  std::vector<std::vector<std::string>> commands{{"cut", mesh}, {"slice", mesh, "--heights", "2"}, {"resolve", mesh}, {"make", "box"}};
#ifdef MANDOLINE_HAVE_OPERATORS
  commands.push_back({"flow", mesh, "--cells", "6", "--wind", "1,0,0"});
#endif
  for (std::vector<std::string>& words : commands) {
    words.insert(words.end(), {"-o", full, other});
    const Outcome o = run(folder, words);
    CAPTURE(words, o.err);
    CHECK(o.exitCode == 2);
    CHECK(contains(o.err, "mandoline: " + full + ": can't be written"));
    CHECK(std::filesystem::remove(other));
  }
}

TEST_CASE("Command line: a file that would be larger than the system allows is not left unfinished", "[cli]") {
  const TemporaryFolder folder;
  const std::string mesh = folder.write("cube.obj", kCube), file = folder.path("a.vtu");
  const Outcome o = runProgram(folder, {"sh", "-c", "ulimit -f 16; exec \"$0\" \"$@\"", MANDOLINE_CLI, "cut", mesh, "-o", file});
  CAPTURE(o.err);
  CHECK(o.exitCode == 2);
  CHECK(contains(o.err, "mandoline: " + file + ": can't be written: File too large"));
  CHECK_FALSE(std::filesystem::exists(file));
  CHECK_FALSE(std::filesystem::exists(file + ".part"));
}

TEST_CASE("Command line: grids by box, origin and planes", "[cli]") {
  const TemporaryFolder folder;
  const std::string mesh = folder.write("cube.obj", kCube);
  const auto report = [&](std::vector<std::string> words) {
    words.insert(words.begin(), {"cut", mesh, "--report", "-"});
    const Outcome o = run(folder, words);
    CAPTURE(o.err);
    REQUIRE(o.exitCode == 0);
    return o.out;
  };
  const std::string oneNumber = report({"--box", "0,0,0,4,4,8", "--cells", "4"});
  REQUIRE(contains(oneNumber, "\"cells\": [2, 2, 4]"));
  REQUIRE(contains(oneNumber, "\"spacing\": [2, 2, 2]"));
  REQUIRE(contains(report({"--box", "0,0,0,8,4,0.5", "--cells", "4"}), "\"cells\": [4, 2, 1]"));
  const std::string regular = report({"--origin", "0,0,-1", "--spacing", "1,1,2", "--cells", "4,4,3"});
  REQUIRE(contains(regular, "\"cells\": [4, 4, 3]"));
  REQUIRE(contains(regular, "\"origin\": [0, 0, -1]"));
  REQUIRE(contains(regular, "\"spacing\": [1, 1, 2]"));
  REQUIRE(contains(report({"--origin=0,0,0", "--spacing=0.5", "--cells=8"}), "\"spacing\": [0.5, 0.5, 0.5]"));
  const std::string planes = report({"--planes", "0,1.5,4/0,4/-1,0,2,9"});
  REQUIRE(contains(planes, "\"cells\": [2, 1, 3]"));
  REQUIRE(contains(planes, "\"spacing\": null"));
  REQUIRE(contains(planes, "\"volume\": 8,"));
  const std::string file = folder.write("planes.txt", "0, 1.5, 4\r\n\n0, 4\r\n-1, 0, 2, 9");
  REQUIRE(contains(report({"--planes", '@' + file}), "\"cells\": [2, 1, 3]"));
}

TEST_CASE("Command line: a file that can't be read is reported, too", "[cli]") {
  const TemporaryFolder folder;
  const std::string none = folder.path("none.obj"), out = folder.path("out.obj");
  const std::vector<std::string> ways[] = {
      {"cut", none}, {"info", none}, {"slice", none, "--heights", "1", "-o", folder.path("out.svg")}, {"resolve", none, "-o", out}};
  for (std::vector<std::string> words : ways) {
    words.insert(words.end(), {"--report", "-"});
    const Outcome o = run(folder, words);
    CHECK(o.exitCode == 2);
    CHECK(o.out == "{\n  \"status\": \"badFile\",\n  \"message\": \"" + none +
                       ": No such file or directory.\",\n  \"element\": null,\n  \"element2\": null,\n  \"path\": \"" + none +
                       "\",\n  \"mesh\": null\n}\n");
  }
}

TEST_CASE("Command line: a grid that is too large is told as it was asked for", "[cli]") {
  const TemporaryFolder folder;
  const std::string mesh = folder.write("cube.obj", kCube);
  const auto refused = [&](const std::string& cells) {
    const Outcome o = run(folder, {"cut", mesh, "--cells", cells});
    CHECK(o.exitCode == 1);
    return o.err;
  };
  CHECK(contains(refused("123456789"), "gridTooLarge: "));
  CHECK(contains(refused("123456789"), "Asked for were 123456789 cells along the longest side."));
  CHECK(contains(refused("4,123456789,5"), "Asked for were 4 x 123456789 x 5 cells."));
  CHECK(contains(refused("1,32768,32768"), "Asked for were 1 x 32768 x 32768 cells."));
  const auto reported = [&](std::vector<std::string> words) {
    words.insert(words.begin(), {"cut", mesh, "--report", "-"});
    return run(folder, words).out;
  };
  CHECK(contains(reported({"--cells", "123456789"}), "\"cells\": [123456789, 123456789, 123456789]"));
  CHECK(contains(reported({"--cells", "4,123456789,5"}), "\"cells\": [4, 123456789, 5]"));
  CHECK(contains(reported({"--cells", "123456789", "--box", "0,0,0,4,2,1"}), "\"cells\": [123456789, 61728395, 30864197]"));
  const std::string flat = folder.write("flat.obj", "v 0 0 0\nv 4 0 0\nv 0 1 0\nf 1 2 3\n");
  const Outcome around = run(folder, {"cut", flat, "--cells", "123456789", "--margin", "0", "--report", "-"});
  CHECK(contains(around.out, "\"cells\": [123456789, 30864198, 1]"));
  CHECK(contains(run(folder, {"cut", mesh, "--cells", "4,123456789,5"}).out, "Grid of 4 x 123456789 x 5 cells"));
}

TEST_CASE("Command line: all reports begin with the same members", "[cli]") {
  const TemporaryFolder folder;
  const std::string mesh = folder.write("cube.obj", kCube), obj = folder.path("a.obj");
  std::vector<std::vector<std::string>> ways = {{"cut", mesh, "--cells", "4"},
                                                {"info", mesh},
                                                {"slice", mesh, "--heights", "2", "--cells", "4", "-o", obj},
                                                {"boundary", mesh, "--cells", "4", "-o", obj},
                                                {"resolve", mesh, "-o", obj}};
#ifdef MANDOLINE_HAVE_OPERATORS
  ways.push_back({"flow", mesh, "--wind", "1,0,0", "--cells", "4", "-o", obj});
#endif
  std::string head;
  for (std::vector<std::string> words : ways) {
    words.insert(words.end(), {"--report", "-"});
    const std::string out = run(folder, words).out, here = out.substr(0, out.find("\"groups\": []\n  },\n"));
    CAPTURE(words, out);
    CHECK(here.size() < out.size());
    if (head.empty()) head = here;
    CHECK(here == head);
  }
  CHECK(contains(head, "\"path\": \"" + mesh + "\",\n  \"mesh\": {\n    \"vertices\": 8,"));
}

TEST_CASE("Command line: intersections are null in the report where nobody looked for them", "[cli]") {
  const TemporaryFolder folder;
  const std::string mesh = folder.write("two.obj", kCube + kCrossingCube);
  const auto report = [&](std::vector<std::string> words) {
    words.insert(words.begin(), {"cut", mesh, "--report", "-", "--cells"});
    return run(folder, words).out;
  };
  CHECK(contains(report({"4"}), "\"intersections\": {\n    \"pairs\": "));
  for (const std::vector<std::string>& words :
       {std::vector<std::string>{"4", "--intersections", "assume-none"}, {"4", "--intersections", "refuse"}, {"99999999"}}) {
    CHECK(contains(report(words), "\"intersections\": null"));
  }
}

#endif

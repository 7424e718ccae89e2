// The command line, run as users run it: exit codes, messages, reports and files.
#ifdef MANDOLINE_CLI

#include <random>
#include <sstream>

#include "catch.h"
#include "command_line.h"
#include "mandoline/io.h"
#include "shapes.h"

namespace {

const std::string kCube =
    "v 1 1 1\nv 3 1 1\nv 3 3 1\nv 1 3 1\nv 1 1 3\nv 3 1 3\nv 3 3 3\nv 1 3 3\n"
    "f 4 3 2 1\nf 5 6 7 8\nf 1 2 6 5\nf 2 3 7 6\nf 3 4 8 7\nf 4 1 5 8\n";

/// To follow kCube in a file; the cubes overlap in [2, 3]^3.
const std::string kCrossingCube =
    "v 2 2 2\nv 4 2 2\nv 4 4 2\nv 2 4 2\nv 2 2 4\nv 4 2 4\nv 4 4 4\nv 2 4 4\n"
    "f 12 11 10 9\nf 13 14 15 16\nf 9 10 14 13\nf 10 11 15 14\nf 11 12 16 15\nf 12 9 13 16\n";

}  // namespace

TEST_CASE("Command line: help and version", "[cli]") {
  const TemporaryFolder folder;
  const std::vector<std::string> ways[] = {{"--help"}, {"-h"}, {"cut", "--help"}, {"info", "-h"}, {"help"}, {"help", "cut"}};
  for (const auto& words : ways) {
    const Outcome o = run(folder, words);
    REQUIRE(o.exitCode == 0);
    REQUIRE(contains(o.out, "mandoline cut MESH"));
    REQUIRE(o.err.empty());
  }
  const Outcome version = run(folder, {"--version"});
  REQUIRE(version.exitCode == 0);
  REQUIRE(version.out.substr(0, 10) == "mandoline ");
}

TEST_CASE("Command line: wrong usage exits with 2", "[cli]") {
  const TemporaryFolder folder;
  const std::string mesh = folder.write("cube.obj", kCube);
  struct Case {
    std::vector<std::string> words;
    std::string message;
  };
  const Case cases[] = {
      {{}, "a command is missing"},
      {{"dice", mesh}, "unknown command 'dice'"},
      {{"slice", mesh, "--heights", "1"}, "-o is missing"},
      {{"slice", mesh, "-o", folder.path("a.svg")}, "slice needs --heights or --layers"},
      {{"slice", mesh, "--heights", "1", "--layers", "2", "-o", folder.path("a.svg")}, "slice needs --heights or --layers"},
      {{"slice", mesh, "--heights", "1,b", "-o", folder.path("a.svg")}, "--heights needs H1,H2,..., not '1,b'"},
      {{"slice", mesh, "--layers", "0", "-o", folder.path("a.svg")}, "--layers needs a number of layers, not '0'"},
      {{"slice", mesh, "--axis", "w", "-o", folder.path("a.svg")}, "--axis needs x, y or z, not 'w'"},
      {{"slice", mesh, "--normal", "0,0,0", "-o", folder.path("a.svg")}, "--normal needs a vector that is not zero"},
      {{"slice", mesh, "--heights", "1", "--only", "cut", "-o", folder.path("a.svg")}, "--only cut: outlines have no cells"},
      {{"slice", mesh, "--heights", "1", "-o", folder.path("a.stl")}, "a.stl: outlines are written as .svg, .dxf or .obj"},
      {{"slice", mesh, "--heights", "1", "-o", mesh}, "are the same file"},
      {{"slice", mesh, "--heights", "1", "-o", folder.path("none/a.svg")}, "a.svg: there is no folder"},
      {{"slice", mesh, "--heights", "1", "-o", folder.path("a-{region}.svg")}, "a-{region}.svg: only cut writes a file for each region"},
      {{"resolve", mesh, "-o", folder.path("none/a.obj")}, "a.obj: there is no folder"},
      {{"make"}, "the shape is missing"},
      {{"make", "torus"}, "-o is missing"},
      {{"make", "torus", "-o", folder.path("a.vtu")}, "a.vtu: a mesh is written as .obj, .stl, .ply or .off"},
      {{"make", "torus", "-o", folder.path("none/a.obj")}, "a.obj: there is no folder"},
      {{"make", "pretzel", "-o", folder.path("a.obj")}, "there are the shapes box, sphere, torus and torus-knot, not 'pretzel'"},
      {{"make", "torus", "knot", "-o", folder.path("a.obj")}, "one shape at a time"},
      {{"cut"}, "the mesh is missing"},
      {{"info"}, "the mesh is missing"},
      {{"cut", mesh, mesh}, "one mesh at a time"},
      {{"cut", mesh, "--colour"}, "unknown option '--colour'"},
      {{"cut", mesh, ""}, "unknown option ''"},
      {{"info", mesh, "--cells", "3"}, "--cells is an option of cut, slice, boundary and flow"},
      {{"cut", mesh, "--wind", "1,0,0"}, "--wind is an option of flow"},
      {{"cut", mesh, "--merge", "0.6", "-o", folder.path("a.vtu")}, "--merge needs a number from 0 to 0.5, not '0.6'"},
      {{"cut", mesh, "--unite-walls", "100", "-o", folder.path("a.vtu")}, "--unite-walls needs an angle from 0 to 90 degrees, not '100'"},
      {{"cut", mesh, "--unite-walls", "20", "-o", folder.path("a.mcm")}, "--unite-walls: only .vtu and .json files and polyMesh folders"},
      {{"cut", mesh, "--merge", "0.2", "-o", folder.path("a.obj")}, "--merge: only .vtu and .json files and polyMesh folders"},
      {{"info", mesh, "--only"}, "--only is an option of cut, slice, boundary and flow"},
      {{"cut", mesh, "--cels", "3"}, "unknown option '--cels': did you mean --cells?"},
      {{"cut", mesh, "-cells", "3"}, "unknown option '-cells': did you mean --cells?"},
      {{"info", mesh, "--widn", "3"}, "unknown option '--widn': did you mean --wind?"},
      {{"cutt", mesh}, "unknown command 'cutt': did you mean cut?"},
      {{"cut", mesh, "--cells", "3", "--cells=4"}, "--cells is given twice"},
      {{"cut", mesh, "--validate", "--validate"}, "--validate is given twice"},
      {{"cut", mesh, "--cells"}, "--cells needs a value"},
      {{"cut", mesh, "--cells="}, "--cells needs a value"},
      {{"cut", mesh, "--cells=3x"}, "--cells needs N or NX,NY,NZ, not '3x'"},
      {{"cut", mesh, "--colour=red"}, "unknown option '--colour'"},
      {{"cut", mesh, "--validate=yes"}, "--validate takes no value"},
      {{"cut", mesh, "--cells", "3x"}, "--cells needs N or NX,NY,NZ, not '3x'"},
      {{"cut", mesh, "--cells", " 3"}, "--cells needs N or NX,NY,NZ, not ' 3'"},
      {{"cut", mesh, "--cells", "3.5"}, "--cells needs"},
      {{"cut", mesh, "--cells", "3,3"}, "--cells needs"},
      {{"cut", mesh, "--cells", "3,,3"}, "--cells needs"},
      {{"cut", mesh, "--cells", "3,3,3,"}, "--cells needs"},
      {{"cut", mesh, "--cells", "99999999999999999999"}, "--cells needs"},
      {{"cut", mesh, "--cells", "0"}, "--cells needs numbers of at least 1"},
      {{"cut", mesh, "--cells", "3,-3,3"}, "--cells needs numbers of at least 1"},
      {{"cut", mesh, "--box", "0,0,0,1,1"}, "--box needs X0,Y0,Z0,X1,Y1,Z1"},
      {{"cut", mesh, "--box", "0,0,0,1,1,one"}, "--box needs X0,Y0,Z0,X1,Y1,Z1"},
      {{"cut", mesh, "--box", "0,0,0,1,0,1"}, "--box needs a box that is not empty"},
      {{"cut", mesh, "--box", "0,0,0,1,nan,1"}, "--box needs a box that is not empty"},
      {{"cut", mesh, "--box", "0,0,0,1,inf,1"}, "--box needs a box that is not empty"},
      {{"cut", mesh, "--snap-tolerance", "0.5"}, "--snap-tolerance needs"},
      {{"cut", mesh, "--snap-tolerance", "-1"}, "--snap-tolerance needs"},
      {{"cut", mesh, "--snap-tolerance", "nan"}, "--snap-tolerance needs"},
      {{"cut", mesh, "--threads", "-1"}, "--threads needs"},
      {{"cut", mesh, "--threads", "two"}, "--threads needs"},
      {{"cut", mesh, "-o"}, "-o needs a value"},
      {{"cut", mesh, "--planes", "0,1,2/0,1/0,x"}, "the z planes must be numbers, not '0,x'"},
      {{"cut", mesh, "--planes", "0,1,2/0,1"}, "--planes needs X0,X1,"},
      {{"cut", mesh, "--planes", "0,1,2/0,1,1/0,1"}, "the y planes must ascend"},
      {{"cut", mesh, "--planes", "0/0,1,1/0,1"}, "the x planes must be at least two"},
      {{"cut", mesh, "--planes", "0,1/0,1/0,inf"}, "the z planes must be numbers"},
      {{"cut", mesh, "--planes", '@' + folder.path("none")}, "none: can't be read"},
      {{"cut", mesh, "--planes", '@' + folder.write("two.txt", "0,1\n0,1\n")}, "two.txt: needs three lines"},
      {{"cut", mesh, "--planes", "0,1/0,1/0,1", "--cells", "3"}, "--planes tells the number of cells"},
      {{"cut", mesh, "--margin", "-1"}, "--margin needs a number from 0 to 1e6, not '-1'"},
      {{"cut", mesh, "--margin", "nan"}, "--margin needs a number from 0 to 1e6, not 'nan'"},
      {{"slice", mesh, "--margin", "1", "--box", "0,0,0,1,1,1"}, "--margin is for grids around the mesh"},
      {{"cut", mesh, "--planes", "0,1/0,1/0,1", "--box", "0,0,0,1,1,1"}, "only one of --box, --planes, and --origin"},
      {{"cut", mesh, "--origin", "0,0,0", "--spacing", "1", "--cells", "3", "--box", "0,0,0,1,1,1"}, "only one of --box"},
      {{"cut", mesh, "--origin", "0,0,0", "--cells", "3"}, "--origin and --spacing need each other"},
      {{"cut", mesh, "--origin", "0,0,0", "--spacing", "1"}, "--origin and --spacing need --cells"},
      {{"cut", mesh, "--origin", "0,0", "--spacing", "1", "--cells", "3"}, "--origin needs X,Y,Z, not '0,0'"},
      {{"cut", mesh, "--origin", "0,0,0", "--spacing", "1,1", "--cells", "3"}, "--spacing needs S or SX,SY,SZ, not '1,1'"},
      {{"cut", mesh, "--origin", "0,0,0", "--spacing", "1,0,1", "--cells", "3"}, "--spacing needs numbers above 0"},
      {{"cut", mesh, "--only", "within"}, "--only needs cut, inside, outside or region=K, not 'within'"},
      {{"cut", mesh, "--only", "region="}, "--only needs cut, inside, outside or region=K, not 'region='"},
      {{"cut", mesh, "--only", "region=-1"}, "--only needs cut, inside, outside or region=K"},
      {{"cut", mesh, "--only", "cut", "-o", folder.path("a.json")}, "a.json: .json files always have everything"},
      {{"cut", mesh, "-o", folder.path("{region}.json")}, ".json files always have everything"},
      {{"cut", mesh, "--coarsen", "x"}, "--coarsen needs a number of levels, or LEVELS,LAYERS, not 'x'"},
      {{"cut", mesh, "--coarsen", "2,-1"}, "--coarsen needs a number of levels, or LEVELS,LAYERS, not '2,-1'"},
      {{"cut", mesh, "--refine", "1.5"}, "--refine needs a number of levels from 0 to 24, or LEVELS,DEGREES up to 180, not '1.5'"},
      {{"cut", mesh, "--refine", "1,200"}, "--refine needs a number of levels from 0 to 24, or LEVELS,DEGREES up to 180, not '1,200'"},
      {{"cut", mesh, "--refine-box", "0,0,0,1,1,1"}, "--refine-box needs X0,Y0,Z0,X1,Y1,Z1,LEVELS"},
      {{"cut", mesh, "--refine-box", "0,0,0,1,0,1,2"}, "--refine-box needs X0,Y0,Z0,X1,Y1,Z1,LEVELS"},
      {{"cut", mesh, "--refine", "1", "-o", folder.path("a.obj")},
       "--refine: only .vtu and .json files and polyMesh folders have all cells"},
      {{"cut", mesh, "--refine", "1", "--snap-tolerance", "0.1"}, "--refine and --refine-box do not go with --snap-tolerance"},
      {{"cut", mesh, "--refine", "1", "--inside-threshold", "0.4"}, "--refine and --refine-box do not go with --inside-threshold"},
      {{"cut", mesh, "--faces", "-o", folder.path("a.obj")}, "--faces: only .vtu files have faces instead of cells"},
      {{"cut", mesh, "--simple-cells", "-o", folder.path("a.obj")}, "--simple-cells: only .vtu files and polyMesh folders"},
      {{"flow", mesh, "--wind", "1,0,0", "--simple-cells", "-o", folder.path("a.obj")}, "--simple-cells: only .vtu files have cells"},
      {{"cut", mesh, "--faces", "--simple-cells", "-o", folder.path("a.vtu")}, "--simple-cells does not go with --faces"},
      {{"cut", mesh, "--coarsen", "2", "-o", folder.path("a.obj")}, "--coarsen: only .vtu and .json files and polyMesh folders have cells"},
      {{"cut", mesh, "-o", "-"}, "-o - needs --format"},
      {{"cut", mesh, "-o", "-", "--format", "exe"}, "--format needs an extension such as vtu, not 'exe'"},
      {{"cut", mesh, "-o", "-", "--format", "off"}, "--format needs json, mcm, vtu, obj, stl or ply, not off"},
      {{"cut", mesh, "-o", folder.path("a.vtu"), "--format", "vtu"}, "--format is for -o -"},
      {{"cut", mesh, "-o", folder.path("a.off")}, "a.off: the extension must be .json, .mcm, .vtu, .obj, .stl or .ply"},
      {{"cut", mesh, "-o", folder.path("none/a.obj")}, "a.obj: there is no folder"},
      {{"cut", mesh, "-o", mesh}, "the mesh " + mesh + " and -o " + mesh + " are the same file"},
      {{"cut", "-o", folder.path("a.obj"), mesh}, "the mesh is missing"},
  };
  for (const Case& c : cases) {
    const Outcome o = run(folder, c.words);
    CAPTURE(c.words);
    REQUIRE(o.exitCode == 2);
    REQUIRE(o.out.empty());
    REQUIRE(o.err.substr(0, 11) == "mandoline: ");
    REQUIRE(contains(o.err, c.message));
  }
  REQUIRE(folder.read("cube.obj") == kCube);
}

TEST_CASE("Command line: unreadable files exit with 2 and are named with the line", "[cli]") {
  const TemporaryFolder folder;
  const std::string none = folder.path("none.obj"), bad = folder.write("bad.obj", "v 0 0 0\nv 1 zero 0\n");
  for (const std::string command : {"cut", "info"}) {
    REQUIRE(run(folder, {command, none}).exitCode == 2);
    REQUIRE(run(folder, {command, none}).err == "mandoline: " + none + ": No such file or directory\n");
    REQUIRE(run(folder, {command, bad}).exitCode == 2);
    REQUIRE(run(folder, {command, bad}).err == "mandoline: " + bad + ": line 2: expected a number, found 'zero'\n");
  }
}

TEST_CASE("Command line: values after an equals sign", "[cli]") {
  const TemporaryFolder folder;
  const std::string mesh = folder.write("cube.obj", kCube), json = folder.path("cut.json");
  REQUIRE(run(folder, {"cut", mesh, "--cells", "4", "--box", "-1,0,0,4,4,4", "-o", json}).exitCode == 0);
  const std::string apart = folder.read("cut.json");
  REQUIRE(run(folder, {"cut", "--box=-1,0,0,4,4,4", "--cells=4", mesh, "-o", json}).exitCode == 0);
  REQUIRE(folder.read("cut.json") == apart);
}

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

TEST_CASE("Command line: reports and files that can't be written exit with 2", "[cli]") {
  const TemporaryFolder folder;
  const std::string mesh = folder.write("cube.obj", kCube), report = folder.path("none/report.json");
  const Outcome o = run(folder, {"cut", mesh, "--report", report, "-o", folder.path("a.json")});
  REQUIRE(o.exitCode == 2);
  REQUIRE(contains(o.err, "mandoline: " + report + ": can't be written: No such file or directory"));
  REQUIRE(std::filesystem::exists(folder.path("a.json")));
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

TEST_CASE("Command line: misspelt options are errors that suggest the name", "[cli]") {
  const TemporaryFolder folder;
  const std::string mesh = folder.write("cube.obj", kCube);
  const std::string cut = "cells margin box origin spacing planes snap-tolerance intersections orient threads only report format";
  const std::pair<std::string, std::string> commands[] = {
      {"cut", cut + " validate coarsen refine refine-box merge unite-walls faces"},
      {"slice", cut + " axis normal heights layers"},
      {"flow", cut + " coarsen refine refine-box merge unite-walls faces wind far-field corrections streamlines steps viscosity"},
      {"info", "threads report format"},
      {"resolve", "rule orient threads report format"}};
  std::mt19937 random(7);
  for (int i = 0; i < 200; ++i) {
    const auto& [command, names] = commands[random() % 5];
    std::vector<std::string> options;
    std::istringstream words(names);
    for (std::string word; words >> word;) options.push_back("--" + word);
    const std::string option = options[random() % options.size()];
    std::string misspelt = option;
    while (std::find(options.begin(), options.end(), misspelt) != options.end()) {
      misspelt = option;
      const size_t at = 2 + random() % (option.size() - 2);
      const char letter = char('a' + random() % 26);
      const auto wrong = random() % 4;
      if (wrong == 0) misspelt.erase(at, 1);
      if (wrong == 1) misspelt.insert(at, 1, letter);
      if (wrong == 2) misspelt[at] = letter;
      if (wrong == 3 && at + 1 < misspelt.size()) std::swap(misspelt[at], misspelt[at + 1]);
    }
    const Outcome o = run(folder, {command, mesh, misspelt, "1", "-o", folder.path("a.obj")});
    CAPTURE(command, misspelt);
    REQUIRE(o.exitCode == 2);
    REQUIRE(contains(o.err, "unknown option '" + misspelt + "': did you mean " + option + "?"));
  }
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
  const Outcome o = run(folder, {"cut", mesh, "--cells", "8", "--refine", "1", "--coarsen", "1", "--merge", "0.2", "-o", foam, vtu});
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

TEST_CASE("Command line: standard input and output", "[cli]") {
  const TemporaryFolder folder;
  const std::string mesh = folder.write("cube.obj", kCube);
  REQUIRE(run(folder, {"cut", mesh, "--cells", "3", "-o", folder.path("a.vtu"), folder.path("a.json")}).exitCode == 0);
  for (const std::string format : {"vtu", "json"}) {
    const Outcome piped = run(folder, {"cut", "-", "--cells", "3", "-o", "-", "--format", format}, kCube);
    CAPTURE(piped.err);
    REQUIRE(piped.exitCode == 0);
    REQUIRE(piped.out == folder.read("a." + format));
    REQUIRE(contains(piped.err, "standard input: 8 vertices, 12 triangles"));
  }
  REQUIRE(contains(run(folder, {"info", "-"}, kCube).out, "standard input: 8 vertices, 12 triangles"));
  REQUIRE(run(folder, {"info", "-"}, "v 0 zero 0\n").err == "mandoline: standard input: line 1: expected a number, found 'zero'\n");
  REQUIRE(run(folder, {"info", "-"}).err == "mandoline: standard input: the file is empty\n");
  const Outcome resolved = run(folder, {"resolve", "-", "-o", "-", "--format", "obj"}, kCube);
  CAPTURE(resolved.err);
  REQUIRE(resolved.exitCode == 0);
  REQUIRE(contains(run(folder, {"info", "-"}, resolved.out).out, "8 vertices, 12 triangles"));
  const Outcome made = run(folder, {"make", "box", "-o", "-", "--format", "obj"});
  REQUIRE(made.exitCode == 0);
  REQUIRE(contains(run(folder, {"info", "-"}, made.out).out, "8 vertices, 12 triangles"));
  std::string large = kCube;
  for (int i = 0; i < 20000; ++i) large += "# a comment to fill the pipe\n";
  REQUIRE(contains(run(folder, {"info", "-"}, large).out, "8 vertices, 12 triangles"));
}

TEST_CASE("Command line: a file named twice is an error", "[cli]") {
  const TemporaryFolder folder;
  const std::string mesh = folder.write("cube.obj", kCube), other = folder.path("./cube.obj"), linked = folder.path("link.obj");
  std::filesystem::create_hard_link(mesh, folder.path("hard.obj"));
  std::filesystem::create_symlink(mesh, linked);
  std::filesystem::create_directory(folder.path("sub"));
  const std::string vtu = folder.path("a.vtu"), sameVtu = folder.path("sub/../a.vtu");
  const std::vector<std::string> cases[] = {{"cut", mesh, "-o", other},
                                            {"cut", mesh, "-o", linked},
                                            {"cut", mesh, "-o", folder.path("hard.obj")},
                                            {"cut", mesh, "--report", other},
                                            {"info", mesh, "--report", linked},
                                            {"cut", mesh, "-o", vtu, vtu},
                                            {"cut", mesh, "-o", vtu, "-o", sameVtu},
                                            {"cut", mesh, "--report", sameVtu, "-o", vtu},
                                            {"make", "box", "-o", folder.path("b.obj"), folder.path("sub/../b.obj")}};
  for (const auto& words : cases) {
    const Outcome o = run(folder, words);
    CAPTURE(words, o.err);
    REQUIRE(o.exitCode == 2);
    REQUIRE(contains(o.err, "are the same file"));
  }
  const Outcome output = run(folder, {"cut", mesh, "--report", "-", "-o", "-", "--format", "vtu"});
  REQUIRE(output.exitCode == 2);
  REQUIRE(contains(output.err, "both are standard output"));
  REQUIRE(folder.read("cube.obj") == kCube);
  REQUIRE_FALSE(std::filesystem::exists(vtu));
  REQUIRE(run(folder, {"cut", mesh, "-o", folder.path("sub/cube.obj")}).exitCode == 0);  // another one of that name
}

TEST_CASE("Command line: Ctrl-C while cutting leaves nothing behind", "[cli]") {
  for (const int number : {SIGINT, SIGTERM}) {
    const TemporaryFolder folder;
    const std::string mesh = folder.write("cube.obj", kCube);
    int waits = 0;
    const Signal signal{number, [&] { return ++waits > 1000; }};  // a slow machine begins to cut within a second
    const Outcome o = run(folder, {"cut", mesh, "--cells", "500", "--report", "-", "-o", folder.path("a.json")}, "", signal);
    REQUIRE(o.exitCode == 128 + number);
    REQUIRE(o.out.empty());
    REQUIRE(folder.fileCount() == 4);  // the mesh and the standard streams
  }
}

TEST_CASE("Command line: Ctrl-C while writing removes the unfinished file", "[cli]") {
  const TemporaryFolder folder;
  const std::string mesh = folder.write("cube.obj", kCube), part = folder.path("a.vtu.part");
  const Signal signal{SIGINT, [&] { return std::filesystem::exists(part); }};
  const Outcome o = run(folder, {"cut", mesh, "--cells", "150", "-o", folder.path("a.vtu")}, "", signal);
  REQUIRE(o.exitCode == 130);
  REQUIRE(o.err == "mandoline: interrupted\n");
  REQUIRE(folder.fileCount() == 4);
}

TEST_CASE("Command line: outlines at heights", "[cli]") {
  const TemporaryFolder folder;
  const std::string mesh = folder.write("cube.obj", kCube);
  const auto slice = [&](std::vector<std::string> words) {
    words.insert(words.begin(), {"slice", mesh, "-o", "-", "--format"});
    const Outcome o = run(folder, words);
    CAPTURE(o.err);
    REQUIRE(o.exitCode == 0);
    return o.out;
  };
  const auto count = [](const std::string& text, const std::string& part) {
    size_t n = 0;
    for (size_t at = text.find(part); at != std::string::npos; at = text.find(part, at + 1)) ++n;
    return n;
  };
  // Its sides are two triangles each, so that a square has eight points.
  const std::string svg = slice({"svg", "--heights", "1.5,2,9"});
  REQUIRE(contains(svg, "viewBox=\"1 -3 2 2\""));
  for (const std::string height : {"1.5", "2", "9"}) REQUIRE(contains(svg, "<g data-height=\"" + height + "\">"));
  REQUIRE(count(svg, "<path data-region=\"1\"") == 2);
  REQUIRE(count(svg, "L") == 14);
  REQUIRE(count(svg, "Z\"/>") == 2);
  const std::string dxf = slice({"dxf", "--heights", "1.5,2,9"});
  REQUIRE(count(dxf, "0\nPOLYLINE\n8\nregion_1\n66\n1\n70\n9\n") == 2);
  REQUIRE(count(dxf, "0\nVERTEX\n") == 16);
  REQUIRE(contains(dxf, "\n30\n1.5\n"));
  REQUIRE(dxf.ends_with("0\nENDSEC\n0\nEOF\n"));
  const std::string obj = slice({"obj", "--normal", "0,0,2", "--heights", "2"});
  REQUIRE(obj.starts_with("g height_2_region_1\nv "));
  REQUIRE(count(obj, "\nv ") == 8);
  REQUIRE(obj.ends_with("l 1 2 3 4 5 6 7 8 1\n"));
  const std::string layers = slice({"svg", "--axis", "x", "--layers", "4", "--cells", "5"});
  for (const std::string height : {"1.25", "1.75", "2.25", "2.75"}) REQUIRE(contains(layers, "data-height=\"" + height + "\""));
  const std::string outside = slice({"svg", "--heights", "2", "--only", "outside", "--box", "0,0,0,4,4,4"});
  REQUIRE(contains(outside, "viewBox=\"0 -4 4 4\""));
  REQUIRE(count(outside, "<path") == 1);
  REQUIRE(count(outside, "M") == 2);  // the box, and the hole in it
}

TEST_CASE("Command line: outlines of sheets are open lines", "[cli]") {
  const TemporaryFolder folder;
  const std::string sheet = folder.write("sheet.obj", "v 0 0 0\nv 4 0 0\nv 0 0 4\nf 1 2 3\n"), obj = folder.path("a.obj");
  const Outcome o = run(folder, {"slice", sheet, "--heights", "1", "-o", obj, folder.path("a.dxf")});
  CAPTURE(o.err);
  REQUIRE(o.exitCode == 0);
  REQUIRE(contains(folder.read("a.dxf"), "\n70\n8\n"));
  REQUIRE(folder.read("a.obj").find("l 5 6\n") != std::string::npos);  // after the four points of the box
}

TEST_CASE("Command line: made shapes are closed", "[cli]") {
  const TemporaryFolder folder;
  for (const std::string shape : {"box", "sphere", "torus", "torus-knot"}) {
    for (const std::string extension : {".obj", ".stl", ".ply", ".off"}) {
      const std::string path = folder.path(shape + extension);
      REQUIRE(run(folder, {"make", shape, "-o", path}).exitCode == 0);
      REQUIRE(contains(run(folder, {"info", path}).out, "yes, consistently oriented"));
    }
  }
}

TEST_CASE("Command line: crossing cubes are resolved, refused or left alone, and their pairs counted", "[cli]") {
  const TemporaryFolder folder;
  const std::string mesh = folder.write("cubes.obj", kCube + kCrossingCube);
  const std::vector<std::string> grid = {"cut", mesh, "--cells", "5", "--box", "0,0,0,5,5,5", "--report", "-", "--intersections"};
  const auto cutWith = [&](const std::string& what) {
    std::vector<std::string> words = grid;
    words.push_back(what);
    return run(folder, words);
  };
  const Outcome resolved = cutWith("resolve");
  REQUIRE(resolved.exitCode == 0);
  for (const std::string part : {"\"winding\": 0, \"volume\": 110,", "\"winding\": 1, \"volume\": 7,", "\"winding\": 2, \"volume\": 1,",
                                 "\"crossing\": 6", "\"touching\": 12", "\"curves\": 1", "\"madeVertices\": 6"}) {
    REQUIRE(contains(resolved.out, part));
  }
  const Outcome refused = cutWith("refuse");
  REQUIRE(refused.exitCode == 1);
  REQUIRE(contains(refused.err, mesh + ": selfIntersection: Triangles 2 and "));
  REQUIRE(contains(refused.err, " pairs that do."));
  REQUIRE(contains(cutWith("assume-none").out, "\"intersections\": null"));
  REQUIRE(contains(cutWith("never").err, "--intersections needs resolve, refuse or assume-none, not 'never'"));
  REQUIRE(contains(run(folder, {"info", mesh}).out, " crossing, "));
  REQUIRE(contains(run(folder, {"info", mesh, "--report", "-"}).out, "\"first\": [2, "));
  REQUIRE(contains(run(folder, {"info", folder.write("cube.obj", kCube)}).out, "intersecting pairs    0\n"));
}

#ifdef MANDOLINE_HAVE_OPERATORS
TEST_CASE("Command line: flow writes cells with velocities, and streamlines", "[cli]") {
  const TemporaryFolder folder;
  const std::string mesh = folder.write("cube.obj", kCube);
  const Outcome o = run(folder, {"flow", mesh, "--wind", "1,0,0.25", "--cells", "8", "--coarsen", "1", "--streamlines", "7", "-o",
                                 folder.path("flow.vtu"), folder.path("lines.obj")});
  CAPTURE(o.err);
  REQUIRE(o.exitCode == 0);
  REQUIRE(contains(o.out, "status                converged\n"));
  for (const std::string part : {"Name=\"phi\"", "Name=\"velocity\"", "Name=\"pressure_coefficient\""})
    REQUIRE(contains(folder.read("flow.vtu"), part));
  const std::string lines = folder.read("lines.obj");
  size_t count = 0;
  for (size_t i = lines.find("\nl "); i != std::string::npos; i = lines.find("\nl ", i + 1)) ++count;
  REQUIRE(count == 7);
  const Outcome piped =
      run(folder, {"flow", "-", "--wind", "1,0,0.25", "--cells", "8", "--coarsen", "1", "-o", "-", "--format", "vtu"}, kCube);
  CAPTURE(piped.err);
  REQUIRE(piped.exitCode == 0);
  REQUIRE(piped.out == folder.read("flow.vtu"));
  const Outcome reported = run(folder, {"flow", mesh, "--wind", "2,0,0", "--report", folder.path("r.json"), "-o", folder.path("flow.vtu")});
  REQUIRE(reported.exitCode == 0);
  REQUIRE(reported.out.empty());
  const std::string wide = folder.path("wide.vtu");
  REQUIRE(run(folder, {"flow", mesh, "--wind", "2,0,0", "--margin", "0.5", "-o", wide}).exitCode == 0);
  REQUIRE(folder.read("wide.vtu") == folder.read("flow.vtu"));
  for (const std::string part : {"\"status\": \"ok\",", "\"wind\": [\n    2,\n    0,", "\"residuals\": [\n    1,", "\"throttled\": []\n"})
    REQUIRE(contains(folder.read("r.json"), part));
  REQUIRE(run(folder, {"flow", mesh, "--wind", "2,0,0", "--cells", "4", "--faces", "-o", folder.path("faces.vtu")}).exitCode == 0);
  for (const std::string part : {"normal_velocity", "area", "normal", "tag", "triangle", "cells"})
    REQUIRE(contains(folder.read("faces.vtu"), "Name=\"" + part + "\""));
  REQUIRE(
      contains(run(folder, {"flow", mesh, "--wind", "2,0,0", "--faces", "-o", folder.path("lines.obj")}).err, "--faces: only .vtu files"));
  const Outcome unbounded =
      run(folder, {"flow", mesh, "--wind", "2,0,0", "--far-field", "--report", folder.path("r.json"), "-o", folder.path("flow.vtu")});
  REQUIRE(unbounded.exitCode == 0);
  REQUIRE(folder.read("wide.vtu") != folder.read("flow.vtu"));
  const Outcome reaching =
      run(folder, {"flow", mesh, "--wind", "2,0,0", "--far-field", "--box", "0,0,0,2,4,4", "-o", folder.path("flow.vtu")});
  REQUIRE(reaching.exitCode == 1);
  REQUIRE(contains(reaching.err, "With the far field no wall may reach a side of the box, but face "));
  REQUIRE(contains(run(folder, {"flow", mesh, "-o", folder.path("flow.vtu")}).err, "flow needs --wind"));
  REQUIRE(contains(run(folder, {"flow", mesh, "--wind", "1,0", "-o", folder.path("flow.vtu")}).err, "--wind needs X,Y,Z, not '1,0'"));
  REQUIRE(contains(run(folder, {"flow", mesh, "--wind", "1,0,0", "-o", folder.path("flow.stl")}).err,
                   "flow.stl: a flow is written as .vtu or .obj"));
}

TEST_CASE("Command line: a flow in steps, with forces per group", "[cli]") {
  const TemporaryFolder folder;
  const std::string mesh = folder.write("cube.obj", kCube), vtu = folder.path("flow.vtu");
  const std::vector<std::string> words = {"flow", mesh, "--wind", "1,0,0", "--cells", "6", "--steps", "3", "-o", vtu};
  const Outcome o = run(folder, words);
  CAPTURE(o.err);
  REQUIRE(o.exitCode == 0);
  for (const std::string part : {"steps                 3\n", "status                converged\n", "force: of pressure "})
    CHECK(contains(o.out, part));
  for (const std::string part : {"velocity", "pressure"}) CHECK(contains(folder.read("flow.vtu"), "Name=\"" + part + "\""));
  const auto with = [&](const std::vector<std::string>& more) {
    std::vector<std::string> all = words;
    all.insert(all.end(), more.begin(), more.end());
    return run(folder, all);
  };
  const Outcome reported = with({"--viscosity", "0.1", "--unite-walls", "30", "--report", "-"});
  CAPTURE(reported.err);
  REQUIRE(reported.exitCode == 0);
  for (const std::string part : {"\"steps\": 3,", "\"largestDivergence\": ", "\"forces\": [", "\"viscous\": [", "\"group\": null"})
    CHECK(contains(reported.out, part));
  CHECK(contains(with({"--viscosity", "-1"}).err, "--viscosity needs a number of at least 0"));
  for (const std::vector<std::string>& of : {std::vector<std::string>{"--streamlines", "5"}, {"--far-field"}, {"--corrections", "0"}})
    CHECK(contains(with(of).err, "without --steps"));
  CHECK(contains(run(folder, {"flow", mesh, "--wind", "1,0,0", "--steps", "0", "-o", vtu}).err, "--steps needs a number of steps"));
  CHECK(contains(run(folder, {"flow", mesh, "--wind", "1,0,0", "--viscosity", "1", "-o", vtu}).err, "--viscosity is for --steps"));
  CHECK(contains(run(folder, {"flow", mesh, "--wind", "1,0,0", "--steps", "2", "-o", folder.path("a.obj")}).err, "written as .vtu"));
}

TEST_CASE("Command line: wrong outputs of a flow are told before it is solved", "[cli]") {
  const TemporaryFolder folder;
  const std::string mesh = folder.write("cube.obj", kCube), flow = folder.path("flow.vtu");
  const auto message = [&](const std::vector<std::string>& outputs) {
    std::vector<std::string> words{"flow", mesh, "--wind", "1,0,0", "--report", folder.path("r.json"), "-o"};
    words.insert(words.end(), outputs.begin(), outputs.end());
    const Outcome o = run(folder, words);
    CHECK(o.exitCode == 2);
    CHECK_FALSE(std::filesystem::exists(folder.path("r.json")));
    return o.err;
  };
  CHECK(contains(message({folder.path("none/a.vtu"), flow}), "a.vtu: there is no folder"));
  CHECK(contains(message({folder.path("a-{region}.vtu")}), "a-{region}.vtu: only cut writes a file for each region"));
  CHECK(contains(message({flow, "--streamlines", "5"}), "--streamlines: only .obj files have streamlines"));
  CHECK(
      contains(message({folder.path("lines.obj"), "--streamlines", "0"}), "--streamlines needs a number of lines of at least 1, not '0'"));
  CHECK(contains(message({flow, "--corrections", "-1"}), "--corrections needs a number of at least 0, not '-1'"));
  CHECK(contains(message({folder.path("lines.obj"), "--only", "inside"}), "--only: only .vtu files have a part of the cells"));
}

TEST_CASE("Command line: flow reports a mesh that can't be cut", "[cli]") {
  const TemporaryFolder folder;
  const std::string mesh = folder.write("point.obj", "v 0 0 0\n"), report = folder.write("report.json", "old");
  const Outcome o = run(folder, {"flow", mesh, "--wind", "1,0,0", "--report", report, "-o", folder.path("flow.vtu")});
  CHECK(o.exitCode == 1);
  CHECK(contains(o.err, "mandoline: " + mesh + ": emptyMesh: "));
  CHECK(contains(folder.read("report.json"), "\"status\": \"emptyMesh\""));
  CHECK_FALSE(std::filesystem::exists(folder.path("flow.vtu")));
}

TEST_CASE("Command line: a flow that doubles can't hold is written, and its report does not hide that", "[cli]") {
  const TemporaryFolder folder;
  const Outcome o = run(folder, {"flow", folder.write("cube.obj", kCube), "--wind", "1.7e308,1,0", "--cells", "6", "--report", "-", "-o",
                                 folder.path("lines.obj"), folder.path("flow.vtu")});
  CAPTURE(o.out, o.err);
  CHECK(o.exitCode == 1);
  CHECK(contains(o.out, "\"status\": \"breakdown\""));
  CHECK(contains(o.out, "\"largestSpeed\": null"));
  CHECK(std::filesystem::exists(folder.path("flow.vtu")));  // though there are no streamlines where speeds are not finite
}
#endif

TEST_CASE("Command line: info tells what kind of mesh it is", "[cli]") {
  const TemporaryFolder folder;
  const Outcome closed = run(folder, {"info", folder.write("cube.obj", kCube)});
  REQUIRE(closed.exitCode == 0);
  for (const std::string part : {"8 vertices, 12 triangles", "(1, 1, 1) to (3, 3, 3)", "yes, consistently oriented"})
    REQUIRE(contains(closed.out, part));
  // Three triangles on one edge, a pair that disagrees, a duplicate, two without area, an unwelded and an unreferenced vertex.
  const std::string mesh =
      folder.write("odd.obj",
                   "v 0 0 0\nv 1 0 0\nv 0 1 0\nv 0 -1 0\nv 0 0 1\nv 1 0 1\nv 0 0 0\nv 9 9 9\nv 10 0 0\nv 11 0 0\nv 10 1 0\nv 11 1 0\n"
                   "v 0.3 0.1 0\nv 0.6 0.2 0\nv 0.9 0.3 0\n"
                   "f 1 2 3\nf 2 7 4\nf 1 2 5\nf 9 10 11\nf 10 11 12\nf 11 9 10\nf 5 5 6\nf 13 14 15\n");
  const Outcome odd = run(folder, {"info", mesh, "--report", "-"});
  REQUIRE(odd.exitCode == 0);
  for (const std::string part :
       {"\"vertices\": 15", "\"triangles\": 8", "\"status\": \"ok\"", "\"min\": [0, -1, 0]", "\"max\": [11, 1, 1]", "\"closed\": false",
        "\"oriented\": false", "\"nonManifoldEdges\": 2", "\"inconsistentEdges\": 2", "\"components\": 3", "\"duplicateTriangles\": 1",
        "\"weldedVertices\": 1", "\"unreferencedVertices\": 1", "\"nonFiniteVertices\": 0"}) {
    REQUIRE(contains(odd.out, part));
  }
}

TEST_CASE("Command line: info tells where a mesh has defects, and writes them as lines", "[cli]") {
  const TemporaryFolder folder;
  const std::string mesh = folder.write("open.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nv 1 1 0.5\nf 1 2 3\nf 2 3 4\n");
  const Outcome o = run(folder, {"info", mesh, "-o", folder.path("defects.obj")});
  REQUIRE(o.exitCode == 0);
  for (const std::string part :
       {"Defects in 1 place\n", "4 edges are open", "1 edge is run through the same way by both triangles: --orient",
        "place 0 of component 0, from (0, 0, 0) to (1, 1, 0.5)",
        "inconsistent edge from (1, 0, 0) to (0, 1, 0) in place 0, triangles 0 1"}) {
    CHECK(contains(o.out, part));
  }
  CHECK(folder.read("defects.obj") == "v 0 0 0\nv 1 0 0\nv 0 1 0\nv 1 1 0.5\ng open\nl 1 2\nl 1 3\nl 2 4\nl 3 4\ng inconsistent\nl 2 3\n");
  const std::string json = run(folder, {"info", mesh, "--report", "-"}).out;
  CHECK(contains(json,
                 "{\"kind\": \"inconsistent\", \"place\": 0, \"vertices\": [1, 2], \"triangles\": [0, 1], \"from\": [1, 0, 0], "
                 "\"to\": [0, 1, 0]}"));
  CHECK(contains(json, "\"places\": [\n    {\"component\": 0, \"min\": [0, 0, 0], \"max\": [1, 1, 0.5]}\n  ]"));
  CHECK(contains(json, "\"components\": [\n    {\"closed\": false, \"oriented\": false}\n  ]"));
  const Outcome none = run(folder, {"info", folder.write("cube.obj", kCube), "-o", folder.path("none.obj")});
  CHECK(none.exitCode == 0);
  CHECK_FALSE(contains(none.out, "Defects"));
  CHECK(folder.read("none.obj").empty());
}

TEST_CASE("Command line: info lists the first 10000 of the components, places and defects, and tells how many there are", "[cli]") {
  const TemporaryFolder folder;
  constexpr size_t kTriangles = 10001;
  std::string soup;
  for (size_t t = 0; t < kTriangles; ++t) {
    const std::string x = std::to_string(2 * t);
    soup += "v " + x + " 0 0\nv " + x + " 1 0\nv " + x + " 0 1\nf -3 -2 -1\n";
  }
  const std::string mesh = folder.write("soup.obj", soup), json = run(folder, {"info", mesh, "--report", "-"}).out;
  const auto count = [&](const std::string& part) {
    size_t found = 0;
    for (size_t at = json.find(part); at != std::string::npos; at = json.find(part, at + 1)) ++found;
    return found;
  };
  CHECK(count("\"components\": 10001") == 1);
  CHECK(count("\"placeCount\": 10001,\n  \"defectCount\": 30003,") == 1);
  CHECK(count("\n    {\"closed\": ") == 10000);
  CHECK(count("\n    {\"component\": ") == 10000);
  CHECK(count("\n    {\"kind\": ") == 10000);
  CHECK(contains(run(folder, {"info", mesh}).out, "--report FILE.json tells of the first 10000\n"));
}

TEST_CASE("Command line: --orient turns triangles, and the report tells how many", "[cli]") {
  const TemporaryFolder folder;
  std::string turned = kCube;
  turned.replace(turned.find("f 4 3 2 1"), 9, "f 1 2 3 4");
  const std::string mesh = folder.write("turned.obj", turned), file = folder.path("a.obj");
  CHECK(contains(run(folder, {"cut", mesh, "--cells", "4", "--report", "-"}).out, "\"orientation\": null"));
  const std::string json = run(folder, {"cut", mesh, "--cells", "4", "--orient", "--report", "-"}).out;
  CHECK(contains(json, "\"orientation\": {\"turnedTriangles\": 2, \"outward\": 1, \"inward\": 0, \"unknown\": 0, \"nonOrientable\": 0}"));
  CHECK(contains(json, "\"winding\": 1, \"volume\": 8,"));
  const std::vector<std::string> ways[] = {{"slice", mesh, "--heights", "2", "--only", "inside"}, {"resolve", mesh, "--rule", "positive"}};
  for (std::vector<std::string> words : ways) {
    words.insert(words.end(), {"-o", file, "--report", "-"});
    CHECK(contains(run(folder, words).err, "inside by parity"));
    words.push_back("--orient");
    const Outcome o = run(folder, words);
    CHECK(o.exitCode == 0);
    CHECK_FALSE(contains(o.err, "inside by"));
    CHECK(contains(o.out, "\"turnedTriangles\": 2"));
  }
}

TEST_CASE("Command line: heights at which nothing is cut are told", "[cli]") {
  const TemporaryFolder folder;
  const std::string mesh = folder.write("cube.obj", kCube);
  const Outcome some = run(folder, {"slice", mesh, "--heights", "2,7", "-o", folder.path("some.svg"), "--report", "-"});
  CHECK(some.exitCode == 0);
  CHECK(contains(some.err, "Nothing is cut at height 7: the mesh reaches from 1 to 3 along the normal."));
  CHECK(contains(some.out, "{\"height\": 2, \"polygons\": 1, \"slits\": 0},\n    {\"height\": 7, \"polygons\": 0, \"slits\": 0}"));
  CHECK(contains(some.out, "\"status\": \"ok\""));
  const Outcome none = run(folder, {"slice", mesh, "--heights", "-2,7", "-o", folder.path("none.svg"), "--report", "-"});
  CHECK(none.exitCode == 1);
  CHECK(contains(none.err, "Nothing is cut at heights -2 7"));
  CHECK(contains(none.out, "\"status\": \"nothingCut\""));
  CHECK_FALSE(std::filesystem::exists(folder.path("none.svg")));
}

#endif

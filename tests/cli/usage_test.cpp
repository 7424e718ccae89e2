// How the command line is used: help, options, standard streams, and what is wrong with a call.
#ifdef MANDOLINE_CLI

#include <algorithm>
#include <random>
#include <sstream>

#include "catch.h"
#include "command_line.h"
#include "cubes.h"

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

TEST_CASE("Command line: help that can't be written exits with 2", "[cli]") {
  if (!std::filesystem::exists("/dev/full")) return;
  const TemporaryFolder folder;
  for (const std::string word : {"--help", "--version"}) {
    const Outcome o = runProgram(folder, {"/bin/sh", "-c", std::string(MANDOLINE_CLI) + " " + word + " > /dev/full"});
    CHECK(o.exitCode == 2);
    CHECK(contains(o.err, "standard output: can't be written"));
  }
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
      {{"slice", mesh, "--heights", "1", "--layers", "2", "-o", folder.path("a.svg")}, "only one of --heights and --layers"},
      {{"slice", mesh, "--axis", "x", "--normal", "1,0,0", "--layers", "2", "-o", folder.path("a.svg")}, "only one of --axis and --normal"},
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
      {{"cut", mesh, "--only", "within"}, "--only needs cut, inside, outside, region=K or all, not 'within'"},
      {{"cut", mesh, "--only", "region="}, "--only needs cut, inside, outside, region=K or all, not 'region='"},
      {{"cut", mesh, "--only", "region=-1"}, "--only needs cut, inside, outside, region=K or all"},
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

#endif

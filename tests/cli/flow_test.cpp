// mandoline flow: its files, its report, and flows in steps.
#if defined(MANDOLINE_CLI) && defined(MANDOLINE_HAVE_OPERATORS)

#include "catch.h"
#include "command_line.h"
#include "cubes.h"

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

// The command line, run as users run it: exit codes, messages, reports and files.
#ifdef MANDOLINE_CLI

#include <fcntl.h>
#include <sys/wait.h>
#include <unistd.h>

#include <csignal>
#include <vector>

#include "catch.h"
#include "temporary_folder.h"

namespace {

const std::string kCube =
    "v 1 1 1\nv 3 1 1\nv 3 3 1\nv 1 3 1\nv 1 1 3\nv 3 1 3\nv 3 3 3\nv 1 3 3\n"
    "f 4 3 2 1\nf 5 6 7 8\nf 1 2 6 5\nf 2 3 7 6\nf 3 4 8 7\nf 4 1 5 8\n";

struct Outcome {
  int exitCode = -1;
  std::string out, err;
};

/// A child process with its outputs in files of the folder. Interrupted with Ctrl-C's signal after so many milliseconds, if any.
Outcome run(const TemporaryFolder& folder, std::vector<std::string> words, int interruptAfterMs = 0) {
  words.insert(words.begin(), MANDOLINE_CLI);
  std::vector<char*> arguments;
  for (std::string& word : words) arguments.push_back(word.data());
  arguments.push_back(nullptr);
  const std::string out = folder.path("stdout"), err = folder.path("stderr");
  const pid_t child = fork();
  if (child == 0) {
    dup2(open(out.c_str(), O_WRONLY | O_CREAT | O_TRUNC, 0600), STDOUT_FILENO);
    dup2(open(err.c_str(), O_WRONLY | O_CREAT | O_TRUNC, 0600), STDERR_FILENO);
    std::signal(SIGINT, SIG_DFL);
    execv(MANDOLINE_CLI, arguments.data());
    _exit(127);
  }
  REQUIRE(child > 0);
  if (interruptAfterMs > 0) {
    usleep(useconds_t(interruptAfterMs) * 1000);
    kill(child, SIGINT);
  }
  int status = 0;
  waitpid(child, &status, 0);
  return {WIFEXITED(status) ? WEXITSTATUS(status) : -WTERMSIG(status), folder.read("stdout"), folder.read("stderr")};
}

bool contains(const std::string& text, const std::string& part) {
  CAPTURE(text, part);
  return text.find(part) != std::string::npos;
}

}  // namespace

TEST_CASE("Command line: help and version", "[cli]") {
  const TemporaryFolder folder;
  const std::vector<std::string> ways[] = {{"--help"}, {"-h"}, {"cut", "--help"}, {"info", "-h"}};
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
      {{"slice", mesh}, "unknown command 'slice'"},
      {{"cut"}, "the mesh is missing"},
      {{"info"}, "the mesh is missing"},
      {{"cut", mesh, mesh}, "one mesh at a time"},
      {{"cut", mesh, "--colour"}, "unknown option '--colour'"},
      {{"cut", mesh, ""}, "unknown option ''"},
      {{"info", mesh, "--cells", "3"}, "unknown option '--cells'"},
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
      {{"cut", mesh, "-o", folder.path("a.stl")}, "a.stl: the extension must be .json, .vtu or .obj"},
      {{"cut", mesh, "-o", folder.path("none/a.obj")}, "a.obj: there is no folder"},
      {{"cut", mesh, "-o", mesh}, "would overwrite the mesh"},
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
        "{\"id\": 0, \"winding\": 0, \"volume\": 56}", "{\"id\": 1, \"winding\": 1, \"volume\": 8}",
        "\"total\": ", "\"exactFallbacks\": ", "\"peakMemoryBytes\": ", "\"validation\": [", "\"pass\": true"}) {
    REQUIRE(contains(o.out, part));
  }
  REQUIRE_FALSE(contains(o.out, "\"pass\": false"));
  for (const std::string name : {"a.json", "a.vtu", "a.obj"}) REQUIRE(folder.read(name).size() > 100);
  REQUIRE(folder.fileCount() == 6);  // the mesh, its three products, stdout and stderr
}

TEST_CASE("Command line: without --report the report is text", "[cli]") {
  const TemporaryFolder folder;
  const std::string mesh = folder.write("cube.obj", kCube);
  const Outcome o = run(folder, {"cut", mesh, "--cells", "4,4,4", "--box", "0,0,0,4,4,4", "--validate"});
  REQUIRE(o.exitCode == 0);
  REQUIRE(o.err.empty());
  for (const std::string part : {"8 vertices, 12 triangles", "4 x 4 x 4 cells", "Regions", "56", "Timings", "Validation: pass"})
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
  REQUIRE(contains(run(folder, {"cut", mesh, "--box", "0,0,0,4,4,8", "--cells", "2", "--report", "-"}).out, "\"spacing\": [2, 2, 4]"));
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

TEST_CASE("Command line: Ctrl-C cancels the cut and still reports", "[cli]") {
  const TemporaryFolder folder;
  const std::string mesh = folder.write("cube.obj", kCube);
  const Outcome o = run(folder, {"cut", mesh, "--cells", "300", "--report", "-", "-o", folder.path("a.json")}, 100);
  REQUIRE(o.exitCode == 1);
  REQUIRE(contains(o.out, "\"status\": \"cancelled\""));
  REQUIRE_FALSE(std::filesystem::exists(folder.path("a.json")));
}

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
       {"\"vertices\": 15", "\"triangles\": 8", "\"low\": [0, -1, 0]", "\"high\": [11, 1, 1]", "\"closed\": false", "\"oriented\": false",
        "\"nonManifoldEdges\": 2", "\"inconsistentEdges\": 2", "\"components\": 3", "\"duplicateTriangles\": 1", "\"weldedVertices\": 1",
        "\"unreferencedVertices\": 1", "\"nonFiniteVertices\": 0"}) {
    REQUIRE(contains(odd.out, part));
  }
}

#endif

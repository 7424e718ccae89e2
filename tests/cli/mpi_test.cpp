// mandoline-mpi: the command line in several processes.
#ifdef MANDOLINE_MPI

#include <cstdlib>
#include <fstream>
#include <map>
#include <sstream>
#include <tuple>

#include "catch.h"
#include "command_line.h"
#include "mandoline/io.h"
#include "same_bits.h"
#include "shapes.h"
#include "vtu_files.h"

namespace {

namespace fs = std::filesystem;

/// What MPI is to take of a test. What takes two minutes hangs.
std::vector<std::string> wordsFor(int processes, const std::vector<std::string>& words) {
  for (const auto& [name, value] : {std::pair("OMPI_ALLOW_RUN_AS_ROOT", "1"),
                                    {"OMPI_ALLOW_RUN_AS_ROOT_CONFIRM", "1"},
                                    {"OMPI_MCA_rmaps_base_oversubscribe", "1"},
                                    {"OMPI_MCA_hwloc_base_binding_policy", "none"}}) {
    setenv(name, value, 1);
  }
  std::vector<std::string> all = {"timeout",         "--foreground", "--kill-after=9",          "120",
                                  MANDOLINE_MPIEXEC, "-n",           std::to_string(processes), MANDOLINE_MPI};
  all.insert(all.end(), words.begin(), words.end());
  return all;
}

Outcome runRanks(const TemporaryFolder& folder, int processes, const std::vector<std::string>& words, const Signal& signal = {}) {
  return runProgram(folder, wordsFor(processes, words), "", signal);
}

constexpr int kHangs = 124;  // timeout's exit code

std::string meshFile(const TemporaryFolder& folder, const mandoline::Mesh& mesh) {
  mandoline::writeMesh(folder.path("mesh.ply"), mesh);
  return folder.path("mesh.ply");
}

size_t countOf(const std::string& text, const std::string& part) {
  size_t count = 0;
  for (size_t at = text.find(part); at != std::string::npos; at = text.find(part, at + 1)) ++count;
  return count;
}

/// The files of the folder other than those of the streams.
std::vector<std::string> names(const TemporaryFolder& folder) {
  std::vector<std::string> names;
  for (const fs::directory_entry& file : fs::directory_iterator(folder.path(""))) {
    const std::string name = file.path().filename().string();
    if (!name.starts_with("std")) names.push_back(name);
  }
  std::sort(names.begin(), names.end());
  return names;
}

/// What a report tells that does not depend on the machine.
std::string facts(const std::string& report) {
  const std::string text = inOneLine(report);
  const size_t stages = text.find("\"stages\"");
  REQUIRE(stages != std::string::npos);
  std::string facts = text.substr(0, stages);
  const size_t intersections = facts.find("\"ms\"");  // how long finding them took
  REQUIRE(intersections != std::string::npos);
  return facts.substr(0, intersections) + facts.substr(facts.find('}', intersections));
}

/// The numbers that a report has under a name.
std::vector<double> numbersOf(const std::string& report, const std::string& name) {
  std::vector<double> numbers;
  const std::string key = "\"" + name + "\": ";
  for (size_t at = report.find(key); at != std::string::npos; at = report.find(key, at + 1))
    numbers.push_back(std::strtod(report.c_str() + at + key.size(), nullptr));
  return numbers;
}

using Names = std::vector<std::string>;
/// Grid cell, region, volume, level, how many vertices, and the sums of their coordinates.
using Cells = std::vector<std::tuple<int32_t, int32_t, int32_t, int32_t, double, int32_t, int64_t, std::array<double, 3>>>;

Cells cellsOf(const std::string& text) {
  const vtu_files::Vtu vtu(text);
  const auto gridCells = vtu.array<int32_t>("grid_cell"), regions = vtu.array<int32_t>("region");
  const auto volumes = vtu.array<double>("volume"), points = vtu.array<double>("Points");
  const auto vertices = vtu.array<int64_t>("connectivity"), ends = vtu.array<int64_t>("offsets");
  const auto levels = vtu.has("level") ? vtu.array<int32_t>("level") : std::vector<int32_t>(volumes.size());
  Cells cells;
  for (size_t c = 0; c < volumes.size(); ++c) {
    const int64_t begin = c > 0 ? ends[c - 1] : 0;
    std::array<double, 3> sums{};
    for (int64_t i = begin; i < ends[c]; ++i) {
      for (size_t d = 0; d < 3; ++d) sums[d] += points[3 * size_t(vertices[size_t(i)]) + d];
    }
    cells.emplace_back(gridCells[3 * c], gridCells[3 * c + 1], gridCells[3 * c + 2], regions[c], volumes[c], levels[c], ends[c] - begin,
                       sums);
  }
  return cells;
}

/// The process that has a file open for writing, or maps the program and has a word on its command line.
pid_t findRank(const std::string& word) {
  for (const fs::directory_entry& process : fs::directory_iterator("/proc")) {
    const pid_t pid = pid_t(std::atoi(process.path().filename().c_str()));
    std::error_code error;
    if (pid <= 0 || fs::read_symlink(process.path() / "exe", error) != fs::canonical(MANDOLINE_MPI)) continue;
    std::ifstream file(process.path() / "cmdline", std::ios::binary);
    const std::string line{std::istreambuf_iterator<char>(file), std::istreambuf_iterator<char>()};
    if (line.find(word) != std::string::npos) return pid;
  }
  return 0;
}

}  // namespace

TEST_CASE("Several processes report and write what one does", "[mpi]") {
  const TemporaryFolder folder;
  const std::string mesh = meshFile(folder, shapes::merged({shapes::icosphere({0, 0, 0}, 1, 3), shapes::cube(0.5, 1.5)}));
  REQUIRE(run(folder, {"cut", mesh, "--cells", "20", "--report", folder.path("one.txt"), "-o", folder.path("one.json"),
                       folder.path("one.mcm"), folder.path("one.vtu")})
              .exitCode == 0);
  for (const int processes : {1, 2, 3}) {
    CAPTURE(processes);
    const Outcome reduced = runRanks(folder, processes, {"cut", mesh, "--cells", "20", "--report", folder.path("reduced.txt")});
    CAPTURE(reduced.err);
    REQUIRE(reduced.exitCode == 0);
    CHECK(facts(folder.read("reduced.txt")) == facts(folder.read("one.txt")));
    CHECK(countOf(folder.read("reduced.txt"), "\"bytesSent\"") == size_t(processes));
    const Outcome whole = runRanks(folder, processes,
                                   {"cut", mesh, "--cells", "20", "--validate", "--report", folder.path("whole.txt"), "-o",
                                    folder.path("some.json"), folder.path("some.mcm"), folder.path("some.vtu")});
    REQUIRE(whole.exitCode == 0);
    CHECK(facts(folder.read("whole.txt")) == facts(folder.read("one.txt")));
    CHECK(contains(folder.read("whole.txt"), "\"pass\": true"));
    for (const char* extension : {".json", ".mcm", ".vtu"}) {
      const bool areSame = folder.read(std::string("some") + extension) == folder.read(std::string("one") + extension);
      CHECK(areSame);
    }
  }
}

TEST_CASE("The pieces of several processes have the cells of one, some of them none", "[mpi]") {
  const TemporaryFolder folder;
  const std::string mesh = meshFile(folder, shapes::icosphere({0, 0, 0}, 1, 2));
  for (const std::string cells : {"9", "2"}) {
    const Names kinds[] = {{},
                           {"--only", "cut"},
                           {"--coarsen", "2,0"},
                           {"--coarsen", "2,0", "--merge", "0.2", "--only", "region=0"},
                           {"--unite-walls", "30", "--only", "cut"}};
    for (const Names& options : kinds) {
      Names words = {"cut", mesh, "--cells", cells, "-o", folder.path("one.vtu")};
      words.insert(words.end(), options.begin(), options.end());
      REQUIRE(run(folder, words).exitCode == 0);
      Cells one = cellsOf(folder.read("one.vtu")), several;
      for (const int processes : {1, 3, 5}) {  // of two layers most get nothing
        CAPTURE(cells, options, processes);
        words[5] = folder.path("some.pvtu");
        const Outcome outcome = runRanks(folder, processes, words);
        CAPTURE(outcome.err);
        REQUIRE(outcome.exitCode == 0);
        several.clear();
        const std::string joined = folder.read("some.pvtu");
        for (int rank = 0; rank < processes; ++rank) {
          const std::string name = "some_" + std::to_string(rank) + ".vtu";
          REQUIRE(fs::exists(folder.path(name)) == (joined.find("<Piece Source=\"" + name + "\"/>") != std::string::npos));
          if (!fs::exists(folder.path(name))) continue;
          const Cells piece = cellsOf(folder.read(name));
          several.insert(several.end(), piece.begin(), piece.end());
          fs::remove(folder.path(name));
        }
        std::sort(one.begin(), one.end());
        std::sort(several.begin(), several.end());
        const bool areSame = several == one;
        CHECK(areSame);
      }
    }
  }
}

TEST_CASE("A folder of the pieces of several processes is read as the whole, or refused", "[mpi]") {
  const TemporaryFolder folder;
  const std::string mesh = meshFile(folder, shapes::merged({shapes::icosphere({0, 0, 0}, 1, 2), shapes::cube(0.5, 1.5)}));
  REQUIRE(run(folder, {"cut", mesh, "--cells", "9", "-o", folder.path("one.mcm")}).exitCode == 0);
  const mandoline::CutMesh one = mandoline::readCutMesh(folder.path("one.mcm"));
  const std::string pieces = folder.path("a.mcm/");
  const auto refusal = [&] {
    try {
      mandoline::readCutMesh(pieces);
    } catch (const mandoline::FileError& error) {
      return std::string(error.what());
    }
    return std::string();
  };
  for (const int processes : {1, 3, 20}) {  // of nine layers most get nothing
    CAPTURE(processes);
    const Outcome outcome = runRanks(folder, processes, {"cut", mesh, "--cells", "9", "-o", pieces, folder.path("some.mcm")});
    CAPTURE(outcome.err);
    REQUIRE(outcome.exitCode == 0);
    CHECK(differences(mandoline::readCutMesh(pieces), one).empty());
    const bool areSame = folder.read("some.mcm") == folder.read("one.mcm");
    CHECK(areSame);
  }
  CHECK(mandoline::readRankPiece(folder.path("a.mcm/piece_19.mcm")).cutMesh.cellCount() <= one.cellCount());
  const Outcome fewer = runRanks(folder, 3, {"cut", mesh, "--cells", "9", "-o", pieces});
  CHECK(fewer.exitCode == 2);
  CHECK(contains(fewer.err, "a.mcm/piece_3.mcm: is there already, of a cut in more pieces"));
  CHECK(differences(mandoline::readCutMesh(pieces), one).empty());
  fs::remove_all(pieces);
  REQUIRE(runRanks(folder, 3, {"cut", mesh, "--cells", "9", "-o", pieces}).exitCode == 0);
  fs::rename(folder.path("a.mcm/piece_1.mcm"), folder.path("b.mcm"));
  CHECK(contains(refusal(), "a.mcm/piece_2.mcm: Layers "));
  CHECK(contains(refusal(), " of the grid are in no piece."));
  CHECK(mandoline::readCutMesh(folder.path("b.mcm")).cellCount() < one.cellCount());
  fs::copy(folder.path("one.mcm"), folder.path("a.mcm/piece_1.mcm"));
  CHECK(contains(refusal(), "a.mcm/piece_1.mcm: has a whole cut-mesh, not a piece of one"));
  fs::remove_all(pieces);
  CHECK(contains(refusal(), "a.mcm"));
}

TEST_CASE("Each process reads a binary mesh, and the first sends one that others can't read", "[mpi]") {
  const TemporaryFolder folder;
  for (const char* place : {"here", "there"}) fs::create_directories(folder.path(place));
  const mandoline::Mesh mesh = shapes::merged({shapes::icosphere({0, 0, 0}, 1, 3), shapes::cube(0.5, 1.5)});
  const mandoline::Mesh another = shapes::cube(0, 1);
  for (const std::string name : {"mesh.ply", "mesh.stl", "mesh.obj"}) {
    CAPTURE(name);
    const std::string here = folder.path("here/" + name), there = folder.path("there/" + name);
    const auto runBoth = [&](const std::string& report) {
      std::vector<std::string> words = wordsFor(1, {});
      words.pop_back();
      for (const char* place : {"here", "there"}) {
        words.insert(words.end(), {"-wdir", folder.path(place), MANDOLINE_MPI, "cut", name, "--cells", "9", "--report", report});
        if (place == std::string("here")) words.insert(words.end(), {":", "-n", "1"});
      }
      return runProgram(folder, words);
    };
    mandoline::writeMesh(here, mesh);
    mandoline::writeMesh(there, mesh);
    REQUIRE(runBoth(folder.path("both.txt")).exitCode == 0);
    fs::remove(there);
    REQUIRE(runBoth(folder.path("first.txt")).exitCode == 0);
    CHECK(facts(folder.read("both.txt")) == facts(folder.read("first.txt")));
    const double sent = numbersOf(folder.read("first.txt"), "bytesSent").at(0) - numbersOf(folder.read("both.txt"), "bytesSent").at(0);
    const mandoline::Mesh read = mandoline::readMesh(here);
    const size_t bytes = sizeof(double) * read.positions.size() + sizeof(uint32_t) * read.triangles.size();
    CHECK((sent >= double(bytes)) == (name != "mesh.obj"));
    if (name == "mesh.obj") continue;
    mandoline::writeMesh(there, another);
    const Outcome other = runBoth(folder.path("other.txt"));
    CHECK(other.exitCode == 1);
    CHECK(contains(other.err, "rank 1: mesh." + name.substr(5) + ": badArgument: Process 1 has another mesh than process 0."));
    CHECK(countOf(other.err, "mandoline-mpi: ") == 1);
  }
}

TEST_CASE("A plan tells what the processes of a cut then have", "[mpi]") {
  const TemporaryFolder folder;
  const std::string mesh = meshFile(folder, shapes::icosphere({0, 0, 0}, 1, 6));
  const std::string planned = folder.path("plan.txt"), cut = folder.path("cut.txt");
  REQUIRE(runRanks(folder, 1, {"plan", mesh, "--cells", "60", "--threads", "1", "--ranks", "1,2,4,8", "--report", planned}).exitCode == 0);
  const auto plan = [&](const std::string& name, size_t i) { return numbersOf(folder.read("plan.txt"), name).at(i); };
  for (size_t i = 0; i < 4; ++i) {
    const int processes = 1 << i;
    CAPTURE(processes);
    REQUIRE(runRanks(folder, processes, {"cut", mesh, "--cells", "60", "--threads", "1", "--report", cut}).exitCode == 0);
    std::string report = folder.read("cut.txt");
    report = report.substr(report.find("\"ranks\""));
    const auto most = [&](const std::string& name) {
      const std::vector<double> numbers = numbersOf(report, name);
      REQUIRE(numbers.size() == size_t(processes));
      return *std::max_element(numbers.begin(), numbers.end());
    };
    CHECK(plan("ranks", i) == processes);
    CHECK(plan("ranksWithWork", i) == processes);
    CHECK(plan("workBalance", i) >= 1);
    CHECK(plan("workBalance", i) <= 1.1);
    CHECK(plan("cutCells", i) == most("cutCells"));
    CHECK(std::fabs(plan("bytesSent", i) - most("bytesSent")) <= 0.15 * most("bytesSent"));
    CHECK(std::fabs(plan("memoryBytes", i) - most("peakMemoryBytes")) <= 0.15 * most("peakMemoryBytes"));
  }
}

TEST_CASE("A plan for more processes than there are layers says that some have no work", "[mpi]") {
  const TemporaryFolder folder;
  const std::string mesh = meshFile(folder, shapes::icosphere({0, 0, 0}, 1, 3));
  const Outcome outcome = runRanks(folder, 1, {"plan", mesh, "--cells", "20", "--ranks=3,100000"});
  CAPTURE(outcome.err);
  REQUIRE(outcome.exitCode == 0);
  CHECK(contains(outcome.out, "have no work"));
  REQUIRE(runRanks(folder, 2, {"plan", mesh, "--cells", "20", "--ranks", "3,100000", "--report", folder.path("plan.txt")}).exitCode == 0);
  CHECK(numbersOf(folder.read("plan.txt"), "ranksWithWork") == std::vector<double>{3, 20});
  const std::pair<Names, std::string> bad[] = {
      {{}, "--ranks is missing"},
      {{"--ranks", "0"}, "--ranks needs numbers of processes from 1 to 100000, not '0'"},
      {{"--ranks", "2,x"}, "--ranks needs numbers"},
      {{"--ranks", "100001"}, "--ranks needs numbers"},
      {{"--ranks", "2", "--ranks=3"}, "--ranks is given twice"},
      {{"--ranks", "2", "--merge", "0.2"}, "--merge and --unite-walls: a plan is that of cut alone"},
      {{"--ranks", "2", "-o", folder.path("a.vtu")}, "-o: a plan is that of cut alone"},
      {{"--ranks", "2", "--report", mesh}, "the mesh " + mesh + " and --report " + mesh + " are the same file"}};
  for (const auto& [more, message] : bad) {
    Names words = {"plan", mesh, "--cells", "20"};
    words.insert(words.end(), more.begin(), more.end());
    const Outcome refused = runRanks(folder, 2, words);
    CAPTURE(message, refused.err);
    CHECK(refused.exitCode == 2);
    CHECK(contains(refused.err, message));
    CHECK(countOf(refused.err, "mandoline-mpi: ") == 1);
  }
}

TEST_CASE("What several processes can't do is said once", "[mpi]") {
  const TemporaryFolder folder;
  const std::string mesh = meshFile(folder, shapes::merged({shapes::cube(0, 2), shapes::cube(1, 3)}));
  const std::string truncated = folder.write("truncated.ply", folder.read("mesh.ply").substr(0, 400));
  const mandoline::Mesh cube = shapes::cube(0, 1);
  mandoline::writeMesh(folder.path("mesh.stl"), cube);
  const std::string shortened = folder.write("short.stl", folder.read("mesh.stl").substr(0, 300));
  mandoline::Mesh bad = shapes::cube(0, 1);
  bad.positions[5] = std::numeric_limits<double>::quiet_NaN();
  mandoline::writeMesh(folder.path("bad.ply"), bad);
  const std::string pvtu = folder.path("a.pvtu"), polyMesh = folder.path("case/constant/polyMesh"), names = "mandoline-mpi: ";
  const std::tuple<Names, std::string, int> cases[] = {
      {{}, "a command is missing", 2},
      {{"info", mesh}, "several processes cut", 2},
      {{"cut", mesh, "--stream", "-o", folder.path("a")}, "--stream: one process alone streams", 2},
      {{"cut", mesh, "--snap-tolerance", "0.1"}, "--snap-tolerance: several processes do not snap", 2},
      {{"cut", mesh, "-o", pvtu, "--faces"}, ".pvtu files do not go with --faces", 2},
      {{"cut", mesh, "-o", pvtu, "--only", "inside"}, ".pvtu files do not go with --only inside", 2},
      {{"cut", mesh, "-o", pvtu, "--only", "region=9"}, "there is no region 9", 2},
      {{"cut", mesh, "-o", folder.path("none/a.pvtu")}, "there is no folder", 2},
      {{"cut", mesh, "-o", folder.path("polyMesh")}, "several processes write CASE/constant/polyMesh", 2},
      {{"cut", mesh, "-o", folder.path("a.mcm/"), "--only", "cut"}, ".mcm files always have everything", 2},
      {{"cut", mesh, "-o", folder.path("a.mcm/"), "--inside-threshold", "0.5"}, "pieces do not go with --inside-threshold", 2},
      {{"cut", mesh, "-o", folder.path("a.mcm/"), "--coarsen", "1"}, "--coarsen: only .vtu and .json files", 2},
      {{"cut", mesh, "-o", mesh + "/a.mcm/"}, mesh + "/a.mcm/: can't be written: Not a directory", 2},
      {{"cut", mesh, "-o", pvtu, "--refine", "1"}, ".pvtu files do not go with --refine", 2},
      {{"cut", mesh, "-o", polyMesh, "--refine", "1"}, "polyMeshes of several processes do not go with --refine", 2},
      {{"cut", mesh, "-o", polyMesh, "--only", "cut"}, "polyMeshes of several processes do not go with --only", 2},
      {{"cut", mesh, "--box", "5,5,5,6,6,6", "--cells", "2", "-o", pvtu, "--only", "cut"}, "--only selects nothing", 2},
      {{"cut", folder.path("none.ply")}, "rank 0: " + folder.path("none.ply"), 2},
      {{"cut", truncated}, "rank 0: " + truncated, 2},
      {{"cut", shortened}, "rank 0: " + shortened, 2},
      {{"cut", folder.path("bad.ply")}, "rank 0: " + folder.path("bad.ply") + ": nonFiniteCoordinate: ", 1},
      {{"cut", mesh, "--intersections", "refuse"}, "rank 0: " + mesh + ": selfIntersection: Triangles", 1},
      {{"cut", mesh, "--cells", "99999999"}, "gridTooLarge", 1},
  };
  const Names before = ::names(folder);
  for (const auto& [words, message, exitCode] : cases) {
    CAPTURE(message);
    const Outcome outcome = runRanks(folder, 3, words);
    CHECK(outcome.exitCode == exitCode);
    CHECK(contains(outcome.err, message));
    CHECK(countOf(outcome.err, names) == 1);
    CHECK(::names(folder) == before);
  }
}

TEST_CASE("A disk that is full for one process leaves no pieces", "[mpi]") {
  const TemporaryFolder folder;
  const std::string mesh = meshFile(folder, shapes::icosphere({0, 0, 0}, 1, 3));
  for (const std::string full : {"a_0.vtu", "a_1.vtu", "a.pvtu", "a.mcm/piece_0.mcm", "a.mcm/piece_1.mcm"}) {
    CAPTURE(full);
    const bool isMcm = full.ends_with(".mcm");
    if (isMcm) fs::create_directory(folder.path("a.mcm"));
    fs::create_symlink("/dev/full", folder.path(full));
    const Outcome outcome = runRanks(folder, 3, {"cut", mesh, "--cells", "12", "-o", folder.path(isMcm ? "a.mcm/" : "a.pvtu")});
    CHECK(outcome.exitCode == 2);
    const std::string rank = contains(full, "_1.") ? "rank 1: " : "rank 0: ";
    CHECK(contains(outcome.err, rank + folder.path(full) + ": can't be written: No space left on device"));
    CHECK(countOf(outcome.err, "mandoline-mpi: ") == 1);
    fs::remove(folder.path(full));
    CHECK(names(folder) == Names{"mesh.ply"});
  }
}

TEST_CASE("A process that is killed while it reads, prepares or cuts ends all", "[mpi]") {
  const TemporaryFolder folder;
  const std::string mesh = meshFile(folder, shapes::icosphere({0, 0, 0}, 1, 7)), pvtu = folder.path("a.pvtu");
  for (const int milliseconds : {0, 50, 100, 200, 400}) {
    CAPTURE(milliseconds);
    const auto ready = [&] {
      const auto process = findRank(pvtu);
      if (process == 0) return false;
      usleep(useconds_t(1000 * milliseconds));
      kill(process, SIGKILL);
      return true;
    };
    const Outcome outcome = runRanks(folder, 3, {"cut", mesh, "--cells", "400", "-o", pvtu}, {SIGCHLD, ready});
    CHECK(outcome.exitCode != 0);
    CHECK(outcome.exitCode != kHangs);
    CHECK(names(folder) == Names{"mesh.ply"});
  }
}

TEST_CASE("A process that is killed, or Ctrl-C, ends all and leaves no files", "[mpi]") {
  const TemporaryFolder folder;
  const std::string mesh = meshFile(folder, shapes::icosphere({0, 0, 0}, 1, 4)), pvtu = folder.path("a.pvtu");
  const auto isWriting = [&] { return fs::exists(folder.path("a_0.vtu.part")) || fs::exists(folder.path("a_1.vtu.part")); };
  for (const bool isKilled : {true, false}) {
    CAPTURE(isKilled);
    const auto ready = [&] {
      if (!isWriting()) return false;
      const auto process = findRank(pvtu);
      if (process == 0) return false;
      if (isKilled) kill(process, SIGKILL);
      return true;
    };
    // Of a process that was killed mpirun learns by itself. Of Ctrl-C it tells the others a second later: till then they go on.
    const Signal signal{isKilled ? SIGCHLD : SIGINT, ready};
    const Outcome outcome = runRanks(folder, 2, {"cut", mesh, "--cells", "350", "-o", pvtu}, signal);
    CHECK(outcome.exitCode != 0);
    CHECK(outcome.exitCode != kHangs);
    CHECK(names(folder) == Names{"mesh.ply"});
  }
}

namespace {

/// The items of a list in a polyMesh: a line each.
Names itemsIn(const TemporaryFolder& folder, const std::string& file) {
  std::istringstream lines(folder.read(file));
  Names items;
  bool isBegun = false;
  for (std::string line; std::getline(lines, line);) {
    if (isBegun && line != ")") items.push_back(line);
    isBegun |= line == "(";
  }
  return items;
}
std::vector<int64_t> numbersIn(const TemporaryFolder& folder, const std::string& file) {
  std::vector<int64_t> numbers;
  for (const std::string& item : itemsIn(folder, file)) numbers.push_back(std::stoll(item));
  return numbers;
}
std::vector<std::vector<int64_t>> facesIn(const TemporaryFolder& folder, const std::string& file) {
  std::vector<std::vector<int64_t>> faces;
  for (const std::string& item : itemsIn(folder, file)) {
    std::istringstream numbers(item.substr(item.find('(') + 1));
    faces.emplace_back();
    for (int64_t number = 0; numbers >> number;) faces.back().push_back(number);
  }
  return faces;
}

/// A polyMesh put together from those of several processes, by their addressing.
struct WholeMesh {
  std::map<int64_t, std::string> points;
  std::map<int64_t, std::vector<int64_t>> faces;
  std::map<int64_t, int64_t> owners, neighbours;
  std::map<int64_t, int> cells;  ///< how many processes have it

  void add(const TemporaryFolder& folder, const std::string& part) {
    const auto numbers = [&](const std::string& file) { return numbersIn(folder, part + file); };
    const std::vector<int64_t> pointsOf = numbers("pointProcAddressing"), facesOf = numbers("faceProcAddressing"),
                               cellsOf = numbers("cellProcAddressing"), owner = numbers("owner"), neighbour = numbers("neighbour");
    const Names positions = itemsIn(folder, part + "points");
    auto loops = facesIn(folder, part + "faces");
    REQUIRE(positions.size() == pointsOf.size());
    REQUIRE(loops.size() == facesOf.size());
    for (size_t p = 0; p < positions.size(); ++p) REQUIRE(points.try_emplace(pointsOf[p], positions[p]).first->second == positions[p]);
    for (const int64_t cell : cellsOf) ++cells[cell];
    for (size_t f = 0; f < loops.size(); ++f) {
      const int64_t face = std::abs(facesOf[f]) - 1;
      for (int64_t& v : loops[f]) v = pointsOf[size_t(v)];
      if (facesOf[f] < 0) std::reverse(loops[f].begin() + 1, loops[f].end());  // seen from the other side, with the same first vertex
      REQUIRE(faces.try_emplace(face, loops[f]).first->second == loops[f]);
      (facesOf[f] < 0 ? neighbours : owners)[face] = cellsOf[size_t(owner[f])];
      if (f < neighbour.size()) neighbours[face] = cellsOf[size_t(neighbour[f])];
    }
  }
};

template <class Item>
std::vector<Item> inOrder(const std::map<int64_t, Item>& items) {
  std::vector<Item> all;
  for (const auto& [number, item] : items) {
    REQUIRE(number == int64_t(all.size()));
    all.push_back(item);
  }
  return all;
}

/// Compares cases of some numbers of processes with the polyMesh of one.
void compareCases(const std::string& file, const Names& options, const std::vector<int>& numbers) {
  const TemporaryFolder folder;
  const std::string one = "one/constant/polyMesh/", pieces = "pieces/constant/polyMesh";
  Names words = {"cut", file, "-o", folder.path(one), "--report", folder.path("one.txt")};
  words.insert(words.end(), options.begin(), options.end());
  REQUIRE(run(folder, words).exitCode == 0);
  words[3] = folder.path(pieces), words[5] = folder.path("some.txt");
  for (const int processes : numbers) {
    CAPTURE(words, processes);
    const Outcome outcome = runRanks(folder, processes, words);
    CAPTURE(outcome.err);
    REQUIRE(outcome.exitCode == 0);
    WholeMesh whole;
    for (int rank = 0; rank < processes; ++rank) whole.add(folder, "pieces/processor" + std::to_string(rank) + "/constant/polyMesh/");
    CHECK(inOrder(whole.points) == itemsIn(folder, one + "points"));
    CHECK(inOrder(whole.faces) == facesIn(folder, one + "faces"));
    CHECK(inOrder(whole.owners) == numbersIn(folder, one + "owner"));
    CHECK(inOrder(whole.neighbours) == numbersIn(folder, one + "neighbour"));
    for (const int count : inOrder(whole.cells)) REQUIRE(count == 1);
    const bool isMerged = std::find(words.begin(), words.end(), "--merge") != words.end();
    REQUIRE(numbersOf(folder.read("one.txt"), "before").size() == size_t(isMerged));
    for (const char* count : {"before", "after", "pockets"})
      CHECK(numbersOf(folder.read("some.txt"), count) == numbersOf(folder.read("one.txt"), count));
    if (processes == 3) {  // those of a finer case are in the way of a coarser one
      words[5] = folder.path("two.txt");
      const Outcome coarser = runRanks(folder, 2, words);
      words[5] = folder.path("some.txt");
      CHECK(coarser.exitCode == 2);
      CHECK(contains(coarser.err, "processor2: is there already, of a case in more parts"));
      for (int rank = 0; rank < 3; ++rank)
        CHECK(fs::exists(folder.path("pieces/processor" + std::to_string(rank) + "/constant/polyMesh/points")));
    }
    fs::remove_all(folder.path("pieces"));
  }
}

}  // namespace

TEST_CASE("Decomposed cases are the polyMesh of one process, by their addressing", "[mpi]") {
  const TemporaryFolder folder;
  // The ball lies in planes of the grid, and has a hole and a slit; the cube makes vertices.
  mandoline::Mesh mesh = shapes::merged({shapes::icosphere({0, 0, 0}, 1, 2), shapes::cube(0, 1.5), shapes::cube(-0.5, 0.5)});
  mesh.triangles.resize(mesh.triangles.size() - 3);
  // Octree cells of the margin reach into the layers of several processes; of two layers some get nothing.
  const Names grids[] = {{"--cells", "2", "--margin", "0"},
                         {"--cells", "5", "--margin", "0"},
                         {"--cells", "8", "--margin", "0"},
                         {"--cells", "6", "--margin", "1", "--coarsen", "2"},
                         {"--cells", "8", "--margin", "0.8", "--coarsen", "9,0"}};
  for (const Names& options : grids) compareCases(meshFile(folder, mesh), options, {1, 2, 3, 4});
}

TEST_CASE("Decomposed cases have the merged cells and united walls of one process", "[mpi]") {
  const TemporaryFolder folder;
  const mandoline::Mesh mesh = shapes::merged({shapes::icosphere({0, 0, 0}, 1, 2), shapes::cube(0, 1.5), shapes::cube(-0.5, 0.5)});
  const Names grids[] = {{"--cells", "2", "--margin", "0", "--merge", "0.2"},
                         {"--cells", "5", "--margin", "0", "--merge", "0.2"},
                         {"--cells", "6", "--margin", "1", "--coarsen", "2", "--merge", "0.2", "--unite-walls", "30"},
                         {"--cells", "7", "--margin", "0.1", "--merge", "0.5", "--coarsen", "9,0", "--simple-cells"},
                         {"--cells", "8", "--margin", "0", "--unite-walls", "60"}};
  for (const Names& options : grids) compareCases(meshFile(folder, mesh), options, {1, 2, 3, 4});
}

TEST_CASE("Decomposed cases of a sheet that is in a plane of the grid but for rounding collapse the same flat polygons", "[mpi]") {
  const TemporaryFolder folder;
  const std::string mesh = meshFile(folder, shapes::sheet(3, 3, [](int i, int j) {
                                      const double x = (i + j) % 2 ? std::nextafter(0.6, 1) : 0.6;
                                      return shapes::Point{x, 0.4 * i - 0.1, 0.4 * j - 0.1};
                                    }));
  compareCases(mesh, {"--box", "0,0,0,1,1,1", "--cells", "5", "--merge", "0.2"}, {2, 3});
}

TEST_CASE("A disk that is full for one process leaves no case", "[mpi]") {
  const TemporaryFolder folder;
  const std::string mesh = meshFile(folder, shapes::icosphere({0, 0, 0}, 1, 3)), full = "case/processor1/constant/polyMesh/faces";
  fs::create_directories(fs::path(folder.path(full)).parent_path());
  fs::create_symlink("/dev/full", folder.path(full));
  const Outcome outcome = runRanks(folder, 3, {"cut", mesh, "--cells", "12", "-o", folder.path("case/constant/polyMesh")});
  CHECK(outcome.exitCode == 2);
  CHECK(contains(outcome.err, "rank 1: " + folder.path(full) + ": can't be written: No space left on device"));
  CHECK(countOf(outcome.err, "mandoline-mpi: ") == 1);
  CHECK(fs::is_empty(folder.path("case")));
}

TEST_CASE("Without PETSc several processes cut, and say that flows need it", "[mpi]") {
  const TemporaryFolder folder;
  const std::string mesh = meshFile(folder, shapes::cube(0, 2));
  const auto runWithout = [&](const Names& words) {
    Names all = wordsFor(2, words);
    *std::find(all.begin(), all.end(), MANDOLINE_MPI) = MANDOLINE_MPI_WITHOUT_PETSC;
    return runProgram(folder, all);
  };
  const Outcome flow = runWithout({"flow", mesh, "--wind", "1,0,0", "-o", folder.path("a.vtu")});
  CHECK(flow.exitCode == 2);
  CHECK(contains(flow.err, "this program was built without PETSc or Eigen, which flow needs in several processes"));
  CHECK(countOf(flow.err, "mandoline-mpi: ") == 1);
  CHECK(runWithout({"cut", mesh, "--cells", "6", "-o", folder.path("a.pvtu")}).exitCode == 0);
  CHECK(names(folder) == Names{"a.pvtu", "a_0.vtu", "a_1.vtu", "mesh.ply"});
}

#ifdef MANDOLINE_MPI_FLOWS

TEST_CASE("A flow of several processes is that of one, of cells as they are, merged, and octree cells, without corrections and with them",
          "[mpi]") {
  const std::string levels = GENERATE(as<std::string>{}, "0", "2"), fraction = GENERATE(as<std::string>{}, "0", "0.2"),
                    corrections = GENERATE(as<std::string>{}, "0", "8");
  const double most = corrections == "0" ? 1 : 1e4;  // corrections end where so little is missing
  const TemporaryFolder folder;
  const std::string mesh = meshFile(folder, shapes::merged({shapes::icosphere({0, 0, 0}, 1, 2), shapes::cube(0.5, 1.5)}));
  Names words = {"flow",
                 mesh,
                 "--wind",
                 "2,1,0",
                 "--cells",
                 "9",
                 "--merge",
                 fraction,
                 "--corrections",
                 corrections,
                 "--report",
                 folder.path("one.json"),
                 "-o",
                 folder.path("one.vtu"),
                 "--coarsen",
                 levels};
  REQUIRE(run(folder, words).exitCode == 0);
  const vtu_files::Vtu one(folder.read("one.vtu"));
  const auto expected = one.array<double>("phi"), velocity = one.array<double>("velocity");
  words[11] = folder.path("some.json"), words[13] = folder.path("some.vtu");
  for (const int processes : {1, 2, 3}) {
    CAPTURE(processes);
    const Outcome outcome = runRanks(folder, processes, words);
    CAPTURE(outcome.err);
    REQUIRE(outcome.exitCode == 0);
    const vtu_files::Vtu some(folder.read("some.vtu"));
    const auto phi = some.array<double>("phi"), speeds = some.array<double>("velocity");
    REQUIRE(phi.size() == expected.size());
    double off = 0, largest = 0, speedOff = 0;
    for (size_t c = 0; c < phi.size(); ++c) {
      off = std::max(off, std::fabs(phi[c] - expected[c]));
      largest = std::max(largest, std::fabs(expected[c]));
    }
    for (size_t i = 0; i < velocity.size(); ++i) speedOff = std::max(speedOff, std::fabs(velocity[i] - speeds[i]));
    CHECK(off <= most * 1e-9 * largest);
    CHECK(speedOff <= most * 1e-8);
    CHECK(contains(folder.read("some.json"), "\"status\": \"ok\""));
    CHECK(countOf(folder.read("some.json"), "\"bytesSent\"") == size_t(processes));
  }
}

TEST_CASE("What flows through faces of several processes' corrected flow is that of one, also with walls united and in the far field",
          "[mpi]") {
  const Names more = GENERATE(Names{}, Names{"--unite-walls", "30"}, Names{"--far-field", "--unite-walls", "15"});
  const double most = more.size() == 3 ? 1e-3 : 3e-5;  // corrections, and passes of the far field, end where so little is missing
  CAPTURE(more);
  const TemporaryFolder folder;
  const std::string mesh = folder.path("mesh.obj");
  {  // walls of its groups stay apart
    const mandoline::Mesh ball = shapes::icosphere({0, 0, 0}, 1, 2);
    std::ofstream file(mesh);
    for (size_t v = 0; v < ball.positions.size(); v += 3)
      file << "v " << ball.positions[v] << " " << ball.positions[v + 1] << " " << ball.positions[v + 2] << "\n";
    for (size_t t = 0; t < ball.triangles.size(); t += 3) {
      file << "g group" << t % 4 << "\nf";
      for (size_t i = 0; i < 3; ++i) file << " " << ball.triangles[t + i] + 1;
      file << "\n";
    }
  }
  const auto flows = [&](const std::string& file, int processes) {
    Names words = {"flow", mesh, "--wind", "2,1,0", "--cells", "9", "--faces", "-o", folder.path(file)};
    words.insert(words.end(), more.begin(), more.end());
    REQUIRE((processes > 0 ? runRanks(folder, processes, words) : run(folder, words)).exitCode == 0);
    const vtu_files::Vtu vtu(folder.read(file));
    auto flows = vtu.array<double>("normal_velocity");
    const auto area = vtu.array<double>("area");
    for (size_t f = 0; f < flows.size(); ++f) flows[f] *= area[f];
    return flows;
  };
  const auto expected = flows("one.vtu", 0), some = flows("some.vtu", 3);
  REQUIRE(some.size() == expected.size());
  double off = 0, largest = 0;
  for (size_t f = 0; f < some.size(); ++f) {
    off = std::max(off, std::fabs(some[f] - expected[f]));
    largest = std::max(largest, std::fabs(expected[f]));
  }
  CHECK(off <= most * largest);
}

TEST_CASE("What a flow of several processes has not, and walls at the sides in the far field, is said once", "[mpi]") {
  const TemporaryFolder folder;
  const std::string mesh = meshFile(folder, shapes::cube(0, 2));
  const Names flow = {"flow", mesh, "--wind", "1,0,0", "--cells", "6", "-o", folder.path("a.vtu")};
  const std::tuple<Names, int, std::string> cases[] = {
      {{"--refine", "1"}, 2, "--refine: a flow of several processes has none"},
      {{"--steps", "2"}, 2, "--steps: a flow of several processes has none"},
      {{"--far-field", "--margin", "0"}, 1, "With the far field no wall may reach a side of the box, but one does."},
  };
  for (const auto& [options, exitCode, message] : cases) {
    Names words = flow;
    words.insert(words.end(), options.begin(), options.end());
    const Outcome outcome = runRanks(folder, 2, words);
    CAPTURE(message, outcome.err);
    CHECK(outcome.exitCode == exitCode);
    CHECK(contains(outcome.err, message));
    CHECK(countOf(outcome.err, "mandoline-mpi: ") == 1);
  }
}

#endif

#endif

// mandoline-mpi cut and plan: reports, pieces, and what goes wrong.
#ifdef MANDOLINE_MPI

#include <fstream>
#include <tuple>

#include "catch.h"
#include "run_ranks.h"
#include "same_bits.h"
#include "shapes.h"
#include "vtu_files.h"

namespace {

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

#endif

// mandoline-mpi flow.
#ifdef MANDOLINE_MPI

#include "catch.h"
#include "run_ranks.h"
#include "shapes.h"
#include "vtu_files.h"

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

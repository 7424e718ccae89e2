// mandoline-mpi cut -o CASE/constant/polyMesh: decomposed cases of OpenFOAM.
#ifdef MANDOLINE_MPI

#include <map>
#include <sstream>

#include "catch.h"
#include "run_ranks.h"
#include "shapes.h"

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
                         {"--cells", "7", "--margin", "0.1", "--merge", "0.2", "--only", "all"},
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

TEST_CASE("Merged cells of several outputs are made once", "[mpi]") {
  const TemporaryFolder folder;
  const std::string mesh = meshFile(folder, shapes::icosphere({0, 0, 0}, 1, 2));
  const auto bytesSent = [&](const Names& outputs) {
    Names words = {"cut", mesh, "--cells", "6", "--merge", "0.2", "--report", folder.path("report.json")};
    for (const std::string& output : outputs) words.insert(words.end(), {"-o", folder.path(output)});
    const Outcome outcome = runRanks(folder, 2, words);
    CAPTURE(outcome.err);
    REQUIRE(outcome.exitCode == 0);
    const std::vector<double> sent = numbersOf(folder.read("report.json"), "bytesSent");
    REQUIRE(sent.size() == 2);
    return sent[0] + sent[1];
  };
  const auto filesOf = [&](const std::string& suffix) {
    Names texts;
    for (const std::string rank : {"0", "1"}) {
      texts.push_back(folder.read("a" + suffix + "_" + rank + ".vtu"));
      for (const char* file : {"points", "faces", "owner", "neighbour", "boundary", "faceProcAddressing"})
        texts.push_back(folder.read("case" + suffix + "/processor" + rank + "/constant/polyMesh/" + file));
    }
    return texts;
  };
  const double one = bytesSent({"a.pvtu"}), both = bytesSent({"a1.pvtu", "case1/constant/polyMesh"});
  CAPTURE(one, both);
  CHECK(both < 1.2 * one);  // most of it is for the merging
  const Names expected = filesOf("1");
  for (const std::string& text : expected) REQUIRE_FALSE(text.empty());
  CHECK(bytesSent({"case2/constant/polyMesh", "a2.pvtu", "case3/constant/polyMesh", "a3.pvtu"}) < 1.5 * one);
  CHECK(filesOf("2") == expected);
  CHECK(filesOf("3") == expected);
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

#endif

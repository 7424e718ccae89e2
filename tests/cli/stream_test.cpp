// cut --stream: folders of pieces.
#ifdef MANDOLINE_CLI

#include <cstdlib>
#include <cstring>

#include "catch.h"
#include "command_line.h"
#include "mandoline/io.h"
#include "shapes.h"

namespace {

namespace fs = std::filesystem;

/// A folder inside of a temporary one.
struct PieceFolder {
  TemporaryFolder outer;
  std::string path = outer.path("pieces");

  std::string read(const std::string& name) const { return outer.read("pieces/" + name); }
  std::vector<std::string> names() const {
    std::vector<std::string> names;
    for (const fs::directory_entry& file : fs::directory_iterator(path)) names.push_back(file.path().filename().string());
    std::sort(names.begin(), names.end());
    return names;
  }
  std::string writeMesh(const mandoline::Mesh& mesh) const {
    mandoline::writeMesh(outer.path("mesh.ply"), mesh);
    return outer.path("mesh.ply");
  }
};

/// The number after the first `key` of a text.
double numberAfter(const std::string& text, const std::string& key) {
  const size_t at = text.find(key);
  REQUIRE(at != std::string::npos);
  return std::strtod(text.c_str() + at + key.size(), nullptr);
}

size_t cellsOf(const std::string& vtu) { return size_t(numberAfter(vtu, "NumberOfCells=\"")); }

/// The array of a .vtu file that comes last.
std::vector<double> volumesOf(const std::string& vtu) {
  const size_t at = vtu.find("Name=\"volume\""), data = vtu.find("encoding=\"raw\">\n_") + 17;
  const size_t offset = data + size_t(numberAfter(vtu.substr(at), "offset=\"")) + sizeof(uint64_t);
  std::vector<double> volumes(cellsOf(vtu));
  std::memcpy(volumes.data(), vtu.data() + offset, volumes.size() * sizeof(double));
  return volumes;
}

std::string wholeVtu(const PieceFolder& folder, std::vector<std::string> words) {
  words.insert(words.end(), {"-o", folder.outer.path("whole.vtu")});
  REQUIRE(run(folder.outer, words).exitCode == 0);
  return folder.outer.read("whole.vtu");
}

}  // namespace

TEST_CASE("Command line: pieces have the cells of the whole cut", "[cli][stream]") {
  const PieceFolder folder;
  const std::string mesh = folder.writeMesh(shapes::icosphere({0, 0, 0}, 1, 3));
  for (const bool onlyCut : {false, true}) {
    CAPTURE(onlyCut);
    std::vector<std::string> words = {"cut", mesh, "--cells", "140,8,136"};
    if (onlyCut) words.insert(words.end(), {"--only", "cut"});
    std::vector<double> whole = volumesOf(wholeVtu(folder, words)), pieces;
    words.insert(words.end(), {"--stream", "--report", "-", "-o", folder.path});
    const Outcome o = run(folder.outer, words);
    REQUIRE(o.exitCode == 0);
    std::vector<std::string> names = {"cut.pvtu", "cut_0_0_0.vtu", "cut_0_0_128.vtu", "cut_128_0_0.vtu"};
    if (!onlyCut) names.push_back("cut_128_0_128.vtu");  // outside of the sphere; it goes when the folder is written again
    REQUIRE(folder.names() == names);
    const std::string joined = folder.read("cut.pvtu");
    size_t cells = 0;
    for (const std::string& name : folder.names()) {
      if (name == "cut.pvtu") continue;
      CHECK(contains(joined, "<Piece Source=\"" + name + "\"/>"));
      const std::string vtu = folder.read(name);
      cells += cellsOf(vtu);
      for (const char* array : {"grid_cell", "winding", "volume"}) CHECK(contains(vtu, std::string("Name=\"") + array + "\""));
      CHECK(vtu.find("\"region\"") == std::string::npos);
      const std::vector<double> volumes = volumesOf(vtu);
      pieces.insert(pieces.end(), volumes.begin(), volumes.end());
    }
    std::sort(whole.begin(), whole.end());
    std::sort(pieces.begin(), pieces.end());
    CHECK(pieces.size() == whole.size());
    const bool areSame = pieces == whole;
    CHECK(areSame);
    CHECK(numberAfter(o.out, "\"pieces\": ") == double(names.size() - 1));
    CHECK(numberAfter(o.out, "\"cutCells\": ") + numberAfter(o.out, "\"untouchedCells\": ") == double(cells));
    CHECK((numberAfter(o.out, "\"untouchedCells\": ") == 0) == onlyCut);
  }
}

TEST_CASE("Command line: pieces without a cut-cell are left out with --only cut", "[cli][stream]") {
  const PieceFolder folder;
  const std::string mesh = folder.writeMesh(shapes::cube(1.25, 1.75));
  const std::vector<std::string> grid = {"--origin", "0,0,0", "--spacing", "1", "--cells", "300,2,2"};
  std::vector<std::string> words = {"cut", mesh, "--stream", "--only", "cut", "-o", folder.path};
  words.insert(words.end(), grid.begin(), grid.end());
  const Outcome o = run(folder.outer, words);
  REQUIRE(o.exitCode == 0);
  CHECK(contains(o.out, "300 x 2 x 2 cells"));
  CHECK(folder.names() == std::vector<std::string>{"cut.pvtu", "cut_0_0_0.vtu"});
}

TEST_CASE("Command line: nothing is left where --stream --only cut finds no cells", "[cli][stream]") {
  const PieceFolder folder;
  const std::string mesh = folder.writeMesh(shapes::cube(10, 11));
  const Outcome o =
      run(folder.outer, {"cut", mesh, "--stream", "--only", "cut", "--box", "0,0,0,1,1,1", "--cells", "2", "-o", folder.path});
  CHECK(o.exitCode == 2);
  CHECK(contains(o.err, "--only cut selects nothing"));
  CHECK_FALSE(fs::exists(folder.path));
}

TEST_CASE("Command line: what does not go with --stream", "[cli][stream]") {
  const PieceFolder folder;
  const std::string mesh = folder.writeMesh(shapes::cube(1, 2));
  const std::pair<std::vector<std::string>, std::string> cases[] = {
      {{}, "--stream needs -o with one folder"},
      {{"-o", "-", "--format", "vtu"}, "--stream needs -o with one folder"},
      {{"-o", folder.path, folder.outer.path("b")}, "--stream needs -o with one folder"},
      {{"-o", folder.outer.path("a.vtu")}, "a.vtu: --stream writes a folder of .vtu files"},
      {{"-o", folder.outer.path("polyMesh")}, "polyMesh: --stream writes a folder of .vtu files"},
      {{"-o", folder.outer.path("{region}")}, "{region}: --stream writes a folder of .vtu files"},
      {{"-o", folder.path, "--validate"}, "--stream does not go with --validate"},
      {{"-o", folder.path, "--coarsen", "1"}, "--stream does not go with --coarsen"},
      {{"-o", folder.path, "--merge", "0.2"}, "--stream does not go with --merge"},
      {{"-o", folder.path, "--refine", "1"}, "--stream does not go with --refine,"},
      {{"-o", folder.path, "--refine-box", "0,0,0,1,1,1,1"}, "--stream does not go with --refine-box,"},
      {{"-o", folder.path, "--unite-walls", "30"}, "--stream does not go with --unite-walls"},
      {{"-o", folder.path, "--faces"}, "--stream does not go with --faces"},
      {{"-o", folder.path, "--inside-threshold", "0.5"}, "--stream does not go with --inside-threshold"},
      {{"-o", folder.path, "--snap-tolerance", "0.1"}, "--stream does not go with --snap-tolerance"},
      {{"-o", folder.path, "--only", "cut,inside"}, "--stream does not go with --only other than cut"},
      {{"-o", folder.path, "--only", "region=0"}, "--stream does not go with --only other than cut"},
      {{"-o", mesh + "/pieces"}, "can't be written"},
      {{"-o", folder.path, "--report", mesh}, "the mesh " + mesh + " and --report " + mesh + " are the same file"},
      {{"-o", folder.path, "--report", folder.path}, "are the same file"},
  };
  for (const auto& [more, message] : cases) {
    CAPTURE(message);
    std::vector<std::string> words = {"cut", mesh, "--stream"};
    words.insert(words.end(), more.begin(), more.end());
    const Outcome o = run(folder.outer, words);
    CHECK(o.exitCode == 2);
    CHECK(contains(o.err, message));
    CHECK_FALSE(fs::exists(folder.path));
  }
  CHECK(mandoline::readMesh(mesh).triangleCount() == 12);  // not written over
  CHECK(contains(run(folder.outer, {"info", mesh, "--stream"}).err, "--stream is an option of cut"));
}

TEST_CASE("Command line: a cut that fails leaves none of its pieces", "[cli][stream]") {
  const PieceFolder folder;  // the second brick along z has the contradiction
  const std::string mesh = folder.writeMesh(
      shapes::merged({shapes::cube(0, 1), shapes::box({0.2, 0.2, 9}, {0.8, 0.8, 9.7}), shapes::box({0.5, 0.5, 9.3}, {1, 1, 10})}));
  fs::create_directory(folder.path);
  folder.outer.write("pieces/cut.pvtu", "of an earlier cut");
  folder.outer.write("pieces/mine.txt", "not its own");
  const Outcome o = run(folder.outer, {"cut", mesh, "--intersections", "assume-none", "--stream", "--only", "cut", "--cells", "20,20,200",
                                       "--report", "-", "-o", folder.path});
  CHECK(o.exitCode == 1);
  CHECK(contains(o.err, "selfIntersection"));
  CHECK(contains(o.out, "\"status\": \"selfIntersection\""));
  CHECK(folder.names() == std::vector<std::string>{"mine.txt"});
}

TEST_CASE("Command line: Ctrl-C between pieces removes them", "[cli][stream]") {
  const PieceFolder folder;
  const std::string mesh = folder.writeMesh(shapes::cube(0, 1));
  const Signal signal{SIGINT, [&] { return fs::exists(folder.path + "/cut_0_0_0.vtu"); }};
  const Outcome o = run(folder.outer, {"cut", mesh, "--cells", "500", "--stream", "--only", "cut", "-o", folder.path}, "", signal);
  CHECK(o.exitCode == 130);
  CHECK(o.err == "mandoline: interrupted\n");
  CHECK_FALSE(fs::exists(folder.path));
}

#endif

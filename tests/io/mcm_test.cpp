// Cut-meshes saved and loaded: to the bit, or refused.
#include <algorithm>
#include <cmath>
#include <limits>
#include <random>

#include "case_list.h"
#include "catch.h"
#include "mandoline/validate.h"
#include "mcm_file.h"
#include "refusal.h"
#include "same_bits.h"
#include "shapes.h"
#include "temporary_folder.h"

using namespace mandoline;

namespace {

CutMesh cutOf(const Mesh& mesh, int64_t n) {
  const CutResult result = cut(mesh, Grid::around(mesh, n));
  REQUIRE(result);
  return result.mesh;
}

/// Two shells that cross, so that no array is empty but that of dropped triangles.
CutMesh crossing() {
  return cutOf(shapes::merged({shapes::torus({0, 0, 0}, 1, 0.4, 12, 8), shapes::torus({0.9, 0.1, 0.2}, 0.4, 0.2, 6, 4)}), 5);
}

void requireSavedAlike(const CutMesh& cutMesh) {
  const std::string bytes = mcmOf(cutMesh);
  const CutMesh back = readMcm(bytes);
  REQUIRE(differences(cutMesh, back) == std::vector<std::string>());
  REQUIRE(mcmOf(back) == bytes);
}

/// The message of the FileError; empty if the bytes are read.
std::string errorOf(const std::string& bytes) {
  try {
    readMcm(bytes);
  } catch (const FileError& error) {
    return error.what();
  }
  return "";
}

/// The same cut-mesh, or a FileError that names the file.
bool isRefused(const std::string& bytes, const CutMesh& original) {
  try {
    const CutMesh read = readMcm(bytes);
    REQUIRE(differences(original, read).empty());
    return false;
  } catch (const FileError& error) {
    REQUIRE(std::string(error.what()).find("a.mcm: ") == 0);
    return true;
  }
}

}  // namespace

TEST_CASE("saved cut-meshes are loaded to the bit") {
  for (const NamedCase& c : caseList()) {
    INFO(c.name);
    const CutResult result = cut(c.mesh, c.grid);
    if (result) requireSavedAlike(result.mesh);
  }
  requireSavedAlike(crossing());
}

TEST_CASE("coordinates are saved to the bit however many digits they have") {
  Mesh mesh = shapes::torus({0, 0, 0}, 1, 0.4, 12, 8);
  const auto change = [&](double (*f)(double)) {
    Mesh changed = mesh;
    std::transform(mesh.positions.begin(), mesh.positions.end(), changed.positions.begin(), f);
    requireSavedAlike(cutOf(changed, 6));
  };
  change([](double x) { return x; });
  change([](double x) { return double(float(x)); });
  change([](double x) { return std::round(x * 1e4) / 1e4; });
  change([](double x) { return std::round(x * 10) / 10 == 0 ? -0.0 : std::round(x * 10) / 10; });
  change([](double x) { return x * 1e150; });
  change([](double x) { return x * 1e-150; });
  change([](double x) { return 1e6 + x; });

  CutMesh any = cutOf(mesh, 3);  // positions are for output only, so that they may be any
  const double values[] = {-0.0,
                           std::numeric_limits<double>::denorm_min(),
                           std::numeric_limits<double>::max(),
                           std::numeric_limits<double>::lowest(),
                           0.1,
                           1.0 / 3,
                           9007199254740993.0};
  for (size_t i = 0; i < any.positions.size(); ++i) any.positions[i] = values[i % std::size(values)];
  requireSavedAlike(any);
}

TEST_CASE("cut-meshes whose arrays are ordered otherwise are saved to the bit") {
  CutMesh cutMesh = crossing();
  std::mt19937 random(1);
  for (size_t c = 0; c < cutMesh.cellCount(); ++c) {
    const auto begin = cutMesh.cellHalfFaces.begin();
    std::shuffle(begin + cutMesh.cellHalfFaceOffsets[c], begin + cutMesh.cellHalfFaceOffsets[c + 1], random);
  }
  for (size_t l = 0; l < cutMesh.loopCount(); ++l) {
    const auto begin = cutMesh.loopVertices.begin();
    std::rotate(begin + cutMesh.loopOffsets[l], begin + cutMesh.loopOffsets[l] + 1, begin + cutMesh.loopOffsets[l + 1]);
  }
  requireSavedAlike(cutMesh);
  std::fill(cutMesh.cellHalfFaces.begin(), cutMesh.cellHalfFaces.end(), 3);  // a half-face in many cells, others in none
  requireSavedAlike(cutMesh);
}

TEST_CASE("a saved cut-mesh is a tenth of its JSON") {
  const CutMesh cutMesh = cutOf(shapes::torus({0, 0, 0}, 1, 0.4, 96, 64), 20);
  size_t json = 0;
  writeJson([&](std::string_view piece) { json += piece.size(); }, cutMesh);
  CHECK(10 * mcmOf(cutMesh).size() < json);
}

TEST_CASE("cut-meshes are saved to files and loaded by their path") {
  const CutMesh cutMesh = crossing();
  const Mesh none;
  const TemporaryFolder folder;
  writeCutMesh(folder.path("a.mcm"), none, cutMesh);
  CHECK(folder.read("a.mcm") == mcmOf(cutMesh));
  CHECK(differences(cutMesh, readCutMesh(folder.path("a.mcm"))).empty());
  CHECK_THROWS_WITH(readCutMesh(folder.path("b.mcm")), folder.path("b.mcm") + ": No such file or directory");
}

TEST_CASE("saving can be cancelled, and an empty cut-mesh can't be saved") {
  RunOptions options;
  options.progress = [](const Progress& progress) { return progress.done == 0; };
  const auto nowhere = [](std::string_view) {};
  CHECK(refusal([&] { writeMcm(nowhere, crossing(), options); }).first == Status::cancelled);
  CHECK(refusal([&] { writeMcm(nowhere, CutMesh()); }).first == Status::badArgument);
}

TEST_CASE("files that are not saved cut-meshes are refused by name") {
  const std::string bytes = mcmOf(crossing());
  const size_t positions = bytes.find("\tpositions"), loops = bytes.find("\floopVertices");
  const auto byte = [](size_t at) { return "a.mcm: byte " + std::to_string(at) + ": "; };
  CHECK(errorOf("") == byte(0) + "the file ends inside of its signature");
  CHECK(errorOf("solid cube") == "a.mcm: is not a .mcm file");
  CHECK(errorOf(bytes.substr(0, 5)) == byte(5) + "the file ends inside of its signature");
  CHECK(errorOf(bytes.substr(0, 8)) == byte(8) + "the file ends inside of its version");
  CHECK(errorOf(bytes.substr(0, positions + 4)) == byte(positions + 4) + "the file ends inside of positions");
  CHECK(errorOf(bytes.substr(0, loops + 99)) == byte(loops + 99) + "the file ends inside of loopVertices");
  CHECK(errorOf(bytes + '\0') == byte(bytes.size()) + "goes on after its last array");
  std::string altered = bytes;
  altered[8] = 1;
  CHECK(errorOf(altered) == "a.mcm: has the version 1 of the format; this library reads version 4");
  altered = bytes;
  altered[loops + 40] ^= 1;
  CHECK(errorOf(altered) == byte(loops) + "loopVertices has been altered: its checksum is another");
  altered = bytes;
  altered[loops + 3] = 'O';
  CHECK(errorOf(altered) == byte(loops) + "the array loopVertices should begin here");
  CutMesh wrong = crossing();
  wrong.vertexMask[7] = 8;
  CHECK(errorOf(mcmOf(wrong)) == "a.mcm: is no cut-mesh: Vertex 7 has a mask of more than three bits.");
}

TEST_CASE("a saved cut-mesh that is cut short anywhere is refused") {
  const CutMesh cutMesh = crossing();
  const std::string bytes = mcmOf(cutMesh);
  for (size_t length = 0; length < bytes.size(); ++length) REQUIRE(isRefused(bytes.substr(0, length), cutMesh));
}

TEST_CASE("1,000 altered files of cut-meshes are refused") {
  const CutMesh cutMesh = crossing();
  const std::string bytes = mcmOf(cutMesh);
  std::mt19937 random(1);
  for (int round = 0; round < 1000; ++round) {
    std::string altered = bytes;
    const size_t at = random() % bytes.size();
    const char value = char(random());
    switch (round % 4) {
      case 0:
        altered[at] ^= char(1 << random() % 8);
        break;
      case 1:
        altered[at] = char(altered[at] + 1 + random() % 255);
        break;
      case 2:
        altered.insert(at, 1 + random() % 9, value);
        break;
      default:
        altered.erase(at, 1 + random() % 9);
    }
    CAPTURE(round, at);
    REQUIRE(isRefused(altered, cutMesh));
  }
}

TEST_CASE("altered files of cut-meshes with the right checksums are refused or hold sound arrays") {
  const std::string bytes = mcmOf(crossing());
  std::mt19937 random(1);
  int refused = 0;
  for (int round = 0; round < 1000; ++round) {
    std::string altered = bytes;
    altered[random() % bytes.size()] ^= char(1 << random() % 8);
    repairChecksums(altered);
    CAPTURE(round);
    try {
      const CutMesh read = readMcm(altered);
      REQUIRE(checkArrays(read).pass);
    } catch (const FileError& error) {
      REQUIRE(std::string(error.what()).find("a.mcm: ") == 0);
      ++refused;
    }
  }
  CHECK(refused > 500);
}

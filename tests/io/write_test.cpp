// Cut-meshes and meshes written in every format, read back, refused, cancelled, and on a full disk.
#include <algorithm>
#include <cstring>
#include <filesystem>
#include <functional>
#include <sstream>

#include "catch.h"
#include "checked_cut.h"
#include "mandoline/inspect.h"
#include "mandoline/io.h"
#include "mandoline/slice.h"
#include "refusal.h"
#include "shapes.h"
#include "temporary_folder.h"

using mandoline::CallError;
using mandoline::CutMesh;
using mandoline::FileFormat;
using mandoline::Grid;
using mandoline::Mesh;
using mandoline::Progress;
using mandoline::Status;
using mandoline::WriteOptions;

namespace {

std::string written(const CutMesh& cutMesh) {
  std::ostringstream out;
  mandoline::writeJson(out, cutMesh);
  return out.str();
}

/// The numbers of a flat array in JSON text.
std::vector<double> jsonNumbers(const std::string& json, const std::string& key) {
  const size_t begin = json.find("\"" + key + "\":[");
  REQUIRE(begin != std::string::npos);
  std::istringstream items(json.substr(begin + key.size() + 4, json.find(']', begin) - begin - key.size() - 4));
  std::vector<double> numbers;
  for (std::string item; std::getline(items, item, ',');) numbers.push_back(std::strtod(item.c_str(), nullptr));
  return numbers;
}

}  // namespace

TEST_CASE("JSON numbers read back identically", "[io]") {
  CutMesh m;
  m.grid = Grid::box({0, -0.1, 1e-3}, {1, 1.0 / 3, 0.7}, {10, 3, 1});
  m.positions = {0.1, 1.0 / 3, 5e-324, 1.7976931348623157e308, -2.2250738585072014e-308, 0.30000000000000004, 1e22, 123456789012345680,
                 -0.0};
  m.vertexMask = {0, 7, 2};
  m.faceAxis = {-1, 2};
  m.cellHalfFaces = {4294967295u};
  m.rowRunOffsets = {0, 1, 1, 3};
  m.runBegin = {2, 0, 9};
  m.runEnd = {10, 3, 10};
  m.runRegion = {1, 0, 1};
  m.regionCount = 2;
  m.triangleCount = 4000000000u;
  const std::string json = written(m);
  const std::vector<double> positions = jsonNumbers(json, "positions");
  REQUIRE(positions.size() == m.positions.size());
  REQUIRE(std::memcmp(positions.data(), m.positions.data(), positions.size() * sizeof(double)) == 0);
  REQUIRE(jsonNumbers(json, "vertexMask") == std::vector<double>{0, 7, 2});
  REQUIRE(jsonNumbers(json, "faceAxis") == std::vector<double>{-1, 2});
  REQUIRE(jsonNumbers(json, "cellHalfFaces") == std::vector<double>{4294967295.0});
  REQUIRE(jsonNumbers(json, "cells") == std::vector<double>{10, 3, 1});
  REQUIRE(jsonNumbers(json, "spacing") == std::vector<double>(m.grid.spacing.begin(), m.grid.spacing.end()));
  REQUIRE(jsonNumbers(json, "gridCellRegion") ==
          std::vector<double>{-1, -1, 1, 1, 1, 1, 1, 1, 1, 1, -1, -1, -1, -1, -1, -1, -1, -1, -1, -1, 0, 0, 0, -1, -1, -1, -1, -1, -1, 1});
  REQUIRE(jsonNumbers(json, "droppedTriangles").empty());
  REQUIRE(json.find("\"regionWinding\":[null,null]") != std::string::npos);
  REQUIRE(json.find("\"triangleCount\":4000000000,") != std::string::npos);
  m.hasWinding = true;
  m.regionWinding = {0, -1};
  REQUIRE(jsonNumbers(written(m), "regionWinding") == std::vector<double>{0, -1});
  m.grid = Grid::rectilinear({std::vector<double>{0, 1, 3}, {0, 1}, {0, 1}});
  m.rowRunOffsets.clear();
  REQUIRE(written(m).find("\"spacing\":null,\"cells\":[2,1,1],\"planes\":[[0,1,3],[0,1],[0,1]]}") != std::string::npos);
}

TEST_CASE("OBJ of the cut surface reads back as the same surface", "[io]") {
  const Mesh cube = shapes::cube(0.75, 2.25);
  const CutMesh cutMesh = checkedCut(cube, unitGrid(3)).mesh;
  std::ostringstream out;
  mandoline::writeObj(out, cutMesh);
  const std::string obj = out.str();
  const Mesh surface = mandoline::readMesh(obj, "a.obj");
  REQUIRE(shapes::signedVolume(surface) == Approx(3.375));
  REQUIRE(shapes::area(surface) == Approx(13.5));
  REQUIRE(size_t(std::count(obj.begin(), obj.end(), 'f')) ==
          size_t(std::count_if(cutMesh.faceTriangle.begin(), cutMesh.faceTriangle.end(), [](int32_t t) { return t >= 0; })));
  REQUIRE(size_t(std::count(obj.begin(), obj.end(), 'g')) == 2);  // one group; "region" has the other
}

TEST_CASE("OBJ lists each nested surface under the region it encloses", "[io]") {
  const Mesh nested = shapes::merged({shapes::cube(0.5, 3.5), shapes::cube(1.25, 2.75)});
  const CutMesh cutMesh = checkedCut(nested, unitGrid(4)).mesh;
  REQUIRE(cutMesh.regionCount == 3);
  std::ostringstream out;
  mandoline::writeObj(out, cutMesh);
  std::string obj = out.str();
  for (const int winding : {1, 2}) {
    const size_t region =
        size_t(std::find(cutMesh.regionWinding.begin(), cutMesh.regionWinding.end(), winding) - cutMesh.regionWinding.begin());
    REQUIRE(obj.find("g region_" + std::to_string(region) + "\n") != std::string::npos);
  }
  const size_t outside = size_t(std::find(cutMesh.regionWinding.begin(), cutMesh.regionWinding.end(), 0) - cutMesh.regionWinding.begin());
  REQUIRE(obj.find("g region_" + std::to_string(outside) + "\n") == std::string::npos);
}

TEST_CASE("STL and PLY of the cut surface", "[io]") {
  const Mesh mesh = shapes::merged({shapes::cube(0.5, 3.5), shapes::cube(1.25, 2.75)});
  const CutMesh cutMesh = checkedCut(mesh, unitGrid(4)).mesh;
  const auto read = [&](FileFormat format, const WriteOptions& options) {
    std::string file;
    mandoline::writeCutMesh([&](std::string_view piece) { file += piece; }, format, mesh, cutMesh, options);
    return mandoline::readMesh(file, "written");
  };
  for (const auto format : {FileFormat::stl, FileFormat::ply, FileFormat::obj}) {
    const Mesh whole = read(format, {});
    REQUIRE(shapes::signedVolume(whole) == Approx(27 + 3.375));
    REQUIRE(shapes::area(whole) == Approx(6 * 9 + 6 * 2.25));
    for (uint32_t r = 0; r < 3; ++r) {
      WriteOptions options;
      options.regions.assign(3, 0);
      options.regions[r] = 1;
      const double volumes[] = {-27, 27 - 3.375, 3.375};  // by winding number
      REQUIRE(shapes::signedVolume(read(format, options)) == Approx(volumes[cutMesh.regionWinding[r]]));
    }
  }
  std::string ply;
  mandoline::writePly([&](std::string_view piece) { ply += piece; }, cutMesh);
  REQUIRE(ply.find("property uint region\n") != std::string::npos);
}

TEST_CASE("Meshes are written as OBJ, STL, PLY and OFF", "[io]") {
  TemporaryFolder folder;
  Mesh mesh = shapes::tetrahedron({0, 0, 0}, {1, 0, 0}, {0, 1. / 3, 0}, {0, 0, 0.5});
  for (const std::string name : {"a.obj", "a.ply", "a.OFF"}) {
    mandoline::writeMesh(folder.path(name), mesh);
    const Mesh again = mandoline::readMesh(folder.path(name));
    REQUIRE(again.positions == mesh.positions);
    REQUIRE(again.triangles == mesh.triangles);
  }
  mandoline::writeMesh(folder.path("a.stl"), mesh);
  REQUIRE(folder.read("a.stl").size() == 84 + 50 * 4);
  const Mesh soup = mandoline::readMesh(folder.path("a.stl"));
  REQUIRE(mandoline::inspect(soup).oriented);
  for (const std::string name : {"a.vtu", "a.json", "a", "a.ob"}) {
    REQUIRE_THROWS_WITH(mandoline::writeMesh(folder.path(name), mesh),
                        folder.path(name) + ": the extension must be .obj, .stl, .ply or .off");
  }
  mesh = {};
  for (const std::string name : {"e.off", "e.stl", "e.ply"}) {
    mandoline::writeMesh(folder.path(name), mesh);
    REQUIRE(mandoline::readMesh(folder.path(name)).triangleCount() == 0);
  }
}

TEST_CASE("writeCutMesh goes by extension and leaves no half-written file", "[io]") {
  TemporaryFolder folder;
  const Mesh cube = shapes::cube(0.75, 2.25);
  const CutMesh cutMesh = checkedCut(cube, unitGrid(3)).mesh;
  for (const std::string name : {"a.json", "a.VTU", "a.obj"}) mandoline::writeCutMesh(folder.path(name), cube, cutMesh);
  REQUIRE(folder.read("a.json") == written(cutMesh));
  REQUIRE(folder.read("a.VTU").substr(0, 40).find("<?xml") == 0);
  REQUIRE(folder.read("a.obj").substr(0, 2) == "g ");
  REQUIRE(folder.fileCount() == 3);
  const std::string noFolder = folder.path("none/a.json");
  REQUIRE_THROWS_WITH(mandoline::writeCutMesh(noFolder, cube, cutMesh), noFolder + ": there is no folder " + folder.path("none"));
  REQUIRE_THROWS_WITH(mandoline::writeCutMesh(folder.path("a.off"), cube, cutMesh),
                      folder.path("a.off") + ": the extension must be .json, .mcm, .vtu, .obj, .stl or .ply");
  REQUIRE(folder.fileCount() == 3);
}

TEST_CASE("Writers refuse regions and meshes that don't fit", "[io]") {
  const Mesh cube = shapes::cube(0.75, 2.25);
  const CutMesh cutMesh = checkedCut(cube, unitGrid(3)).mesh;
  REQUIRE(cutMesh.regionCount == 2);
  const mandoline::Sink nowhere = [](std::string_view) {};
  const std::vector<double> offsets = {0.9, 1.5};
  const mandoline::OutlineStack stack{{0, 0, 1}, offsets, mandoline::outlines(cutMesh, {0, 0, 1}, offsets)};
  const auto withRegions = [&](size_t count, const auto& write) {
    WriteOptions options;
    options.regions.assign(count, 1);
    return refusal([&] { write(options); });
  };
  using Refusal = std::pair<Status, int64_t>;
  for (const FileFormat format : {FileFormat::vtu, FileFormat::obj, FileFormat::stl, FileFormat::ply}) {
    CAPTURE(mandoline::name(format));
    const auto write = [&](const auto& options) { writeCutMesh(nowhere, format, cube, cutMesh, options); };
    for (const size_t count : {1, 3}) CHECK(withRegions(count, write) == Refusal{Status::badArgument, -1});
    CHECK(withRegions(2, write) == Refusal{Status::ok, -1});
    CHECK(refusal([&] { writeCutMesh(nowhere, format, cube, CutMesh{}); }) == Refusal{Status::badArgument, -1});
  }
  for (const FileFormat format : {FileFormat::json, FileFormat::mcm}) {
    CAPTURE(mandoline::name(format));
    const auto write = [&](const auto& options) { writeCutMesh(nowhere, format, cube, cutMesh, options); };
    CHECK(withRegions(2, write) == Refusal{Status::badArgument, -1});
    CHECK(withRegions(0, write) == Refusal{Status::ok, -1});
    WriteOptions cutCellsAlone;
    cutCellsAlone.untouched = false;
    CHECK(refusal([&] { write(cutCellsAlone); }) == Refusal{Status::badArgument, -1});
  }
  for (const FileFormat format : {FileFormat::svg, FileFormat::dxf, FileFormat::obj}) {
    CAPTURE(mandoline::name(format));
    const auto write = [&](const auto& options) { writeOutlines(nowhere, format, stack, options); };
    CHECK(withRegions(1, write) == Refusal{Status::badArgument, 1});
    CHECK(withRegions(2, write) == Refusal{Status::ok, -1});
    CHECK(refusal([&] { writeOutlines(nowhere, format, {stack.normal, {}, stack.layers}); }) == Refusal{Status::badArgument, -1});
    CHECK(refusal([&] { writeOutlines(nowhere, format, {{0, 0, 0}, stack.offsets, stack.layers}); }) == Refusal{Status::badArgument, -1});
  }
  for (const FileFormat format : {FileFormat::obj, FileFormat::stl, FileFormat::ply, FileFormat::off}) {
    CAPTURE(mandoline::name(format));
    const auto write = [&](const Mesh& mesh) { return refusal([&] { writeMesh(nowhere, format, mesh); }); };
    CHECK(write({{0, 0, 0}, {0, 0, 0, 0, 0, 1}}) == Refusal{Status::badIndex, 1});
    CHECK(write({{0, 0, 0, 1}, {}}) == Refusal{Status::badArrays, -1});
  }
  Mesh open = cube;
  open.triangles.resize(33);
  const mandoline::MeshInfo info = mandoline::inspect(open);
  CHECK(refusal([&] { writeDefects(nowhere, open, info); }) == Refusal{Status::ok, -1});
  CHECK(refusal([&] { writeDefects(nowhere, cube, info); }) == Refusal{Status::badArgument, -1});  // which has the same vertices
}

TEST_CASE("Writing shows progress, and cancels without leaving a file", "[io]") {
  const Mesh mesh = shapes::icosphere({8, 8, 8}, 6.3, 5);
  const CutMesh cutMesh = checkedCut(mesh, unitGrid(16)).mesh;
  const auto cut = [&](const std::string& path, const WriteOptions& options) { mandoline::writeCutMesh(path, mesh, cutMesh, options); };
  const auto input = [&](const std::string& path, const WriteOptions& options) { mandoline::writeMesh(path, mesh, options); };
  const std::vector<std::pair<std::string, std::function<void(const std::string&, const WriteOptions&)>>> writers{
      {"a.json", cut},  {"a.vtu", cut},   {"a.obj", cut},   {"a.stl", cut},  {"a.ply", cut},
      {"b.obj", input}, {"b.stl", input}, {"b.ply", input}, {"b.off", input}};
  for (const auto& [name, write] : writers) {
    CAPTURE(name);
    const TemporaryFolder complete, cancelled;
    int calls = 0;
    Progress last{"", 0, 0, 0, 1};
    WriteOptions options;
    options.progress = [&](const Progress& now) {
      CHECK(now.done <= now.total);
      CHECK((now.stageIndex > last.stageIndex || (now.stageIndex == last.stageIndex && now.done >= last.done)));
      if (calls++ > 0) CHECK(now.stageCount == last.stageCount);
      last = now;
      return true;
    };
    write(complete.path(name), options);
    CHECK(complete.fileCount() == 1);
    CHECK(calls > 2);
    CHECK(last.stageIndex == last.stageCount - 1);
    CHECK(last.done == last.total);
    for (const int allowed : {0, 1, calls / 2, calls - 1}) {
      int left = allowed;
      options.progress = [&](const Progress&) { return left-- > 0; };
      try {
        write(cancelled.path(name), options);
        FAIL("not cancelled");
      } catch (const CallError& error) {
        CHECK(error.error.status == Status::cancelled);
        CHECK(error.error.message == "The writing was cancelled.");
      }
      CHECK(left == -1);
      CHECK(cancelled.fileCount() == 0);
    }
    struct OfTheCaller {};
    options.progress = [](const Progress&) -> bool { throw OfTheCaller(); };
    CHECK_THROWS_AS(write(cancelled.path(name), options), OfTheCaller);
    CHECK(cancelled.fileCount() == 0);
  }
}

TEST_CASE("A full disk is an error", "[io]") {
  if (!std::filesystem::exists("/dev/full")) return;
  TemporaryFolder folder;
  const Mesh cube = shapes::cube(0.75, 2.25);
  const CutMesh cutMesh = checkedCut(cube, unitGrid(3)).mesh;
  for (const std::string name : {"full.json", "full.vtu", "full.obj"}) {
    std::filesystem::create_symlink("/dev/full", folder.path(name));
    REQUIRE_THROWS_WITH(mandoline::writeCutMesh(folder.path(name), cube, cutMesh),
                        folder.path(name) + ": can't be written: No space left on device");
  }
}

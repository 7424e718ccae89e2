// Files: every format in every form, damaged in every way, and the written files read back.
#include "mandoline/io.h"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <functional>
#include <sstream>

#include "catch.h"
#include "mandoline/inspect.h"
#include "mandoline/measure.h"
#include "mandoline/slice.h"
#include "mesh/read/load_file.h"
#include "refusal.h"
#include "shapes.h"
#include "temporary_folder.h"
#include "vtu_files.h"

using mandoline::CallError;
using mandoline::CutMesh;
using mandoline::FileError;
using mandoline::FileFormat;
using mandoline::Grid;
using mandoline::Mesh;
using mandoline::Progress;
using mandoline::Status;
using mandoline::WriteOptions;
using vtu_files::Vtu;

namespace {

// A square as one polygon; its fan is 0 1 2, 0 2 3.
const std::vector<double> kSquarePositions = {0, 0, 0, 1, 0, 0, 1, 0.1, 0, 0, 1, -2.5e-3};
const std::vector<uint32_t> kSquareTriangles = {0, 1, 2, 0, 2, 3};

/// Reads the file, and requires the same from its bytes.
Mesh readText(const std::string& name, const std::string& content) {
  TemporaryFolder folder;
  const Mesh mesh = mandoline::readMesh(folder.write(name, content)), fromBytes = mandoline::readMesh(content, name);
  REQUIRE(fromBytes.positions.size() == mesh.positions.size());
  REQUIRE(std::memcmp(fromBytes.positions.data(), mesh.positions.data(), mesh.positions.size() * sizeof(double)) == 0);
  REQUIRE(fromBytes.triangles == mesh.triangles);
  return mesh;
}

void requireSquare(const Mesh& mesh) {
  REQUIRE(mesh.positions == kSquarePositions);
  REQUIRE(mesh.triangles == kSquareTriangles);
}

/// The message of the FileError that the call throws; empty if it throws none.
template <class Call>
std::string errorOf(const Call& call) {
  try {
    call();
  } catch (const FileError& error) {
    return error.what();
  }
  return "";
}

/// Requires a FileError that names the file and says `what`, and the same from the file's bytes.
void requireError(const std::string& name, const std::string& content, const std::string& what) {
  TemporaryFolder folder;
  const std::string path = folder.write(name, content);
  CAPTURE(content.substr(0, 200), what);
  const std::string message = errorOf([&] { mandoline::readMesh(path); });
  CAPTURE(message);
  REQUIRE(message.substr(0, path.size() + 2) == path + ": ");
  REQUIRE(message.find(what) != std::string::npos);
  REQUIRE(errorOf([&] { mandoline::readMesh(content, name); }) == name + message.substr(path.size()));
}

template <class Scalar>
std::string bytes(Scalar value, bool bigEndian = false) {
  std::string result(sizeof value, '\0');
  std::memcpy(result.data(), &value, sizeof value);
  if (bigEndian) std::reverse(result.begin(), result.end());
  return result;
}

std::string binaryStl(const std::string& header, uint32_t promised, const std::vector<float>& corners) {
  std::string file = header;
  file.resize(80, ' ');
  file += bytes(promised);
  for (size_t t = 0; t < corners.size(); t += 9) {
    file += std::string(12, '\0');
    for (size_t i = 0; i < 9; ++i) file += bytes(corners[t + i]);
    file += std::string(2, '\0');
  }
  return file;
}

/// A gzip file whose data are stored, not packed.
std::string gzipped(const std::string& content) {
  uint32_t crc = ~0u;
  for (const char c : content) {
    crc ^= uint8_t(c);
    for (int bit = 0; bit < 8; ++bit) crc = (crc >> 1) ^ (crc & 1 ? 0xedb88320u : 0u);
  }
  const uint16_t length = uint16_t(content.size());
  return std::string("\x1f\x8b\x08\0\0\0\0\0\0\3\1", 11) + bytes(length) + bytes(uint16_t(~length)) + content + bytes(~crc) +
         bytes(uint32_t(content.size()));
}

const std::string kObj = "v 0 0 0\nv 1 0 0\nv 1 0.1 0\nv 0 1 -2.5e-3\nf 1 2 3 4\n";
const std::string kOff = "OFF\n4 1 0\n0 0 0\n1 0 0\n1 0.1 0\n0 1 -2.5e-3\n4 0 1 2 3\n";
const std::string kAsciiPly =
    "ply\nformat ascii 1.0\ncomment made by hand\nelement vertex 4\nproperty double x\nproperty double y\nproperty double z\n"
    "element face 1\nproperty list uchar int vertex_indices\nend_header\n0 0 0\n1 0 0\n1 0.1 0\n0 1 -2.5e-3\n4 0 1 2 3\n";
const std::string kAsciiStl =
    "solid a name\n facet normal 0 0 1\n  outer loop\n   vertex 0 0 0\n   vertex 1 0 0\n   vertex 1 0.1 0\n  endloop\n endfacet\n"
    "endsolid a name\n";
const std::vector<double> kStlPositions = {0, 0, 0, 1, 0, 0, 1, 0.1, 0};

/// Other elements and properties stand before, between and behind those that count.
std::string binaryPly(bool bigEndian) {
  std::string file =
      std::string("ply\nformat binary_") + (bigEndian ? "big" : "little") +
      "_endian 1.0\nelement camera 2\nproperty short id\nproperty list uchar float view\nelement vertex 4\nproperty uchar red\n"
      "property float64 x\nproperty float y\nproperty int8 z\nproperty list int short tags\nelement face 1\nproperty uint8 flag\n"
      "property list ushort uint vertex_index\nproperty float quality\nend_header\n";
  const auto add = [&](auto value) { file += bytes(value, bigEndian); };
  for (int camera = 0; camera < 2; ++camera) {
    add(int16_t(7));
    add(uint8_t(2));
    add(1.5f);
    add(2.5f);
  }
  const double x[] = {0.1, 1, 1, -1e-300};
  const float y[] = {0, 0, 1.25f, 1};
  const int8_t z[] = {0, -3, 0, 5};
  for (int v = 0; v < 4; ++v) {
    add(uint8_t(255));
    add(x[v]);
    add(y[v]);
    add(z[v]);
    add(int32_t(v));
    for (int i = 0; i < v; ++i) add(int16_t(i));
  }
  add(uint8_t(1));
  add(uint16_t(4));
  for (uint32_t v = 0; v < 4; ++v) add(v);
  add(0.5f);
  return file;
}

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

CutMesh cutOrFail(const Mesh& mesh, const Grid& grid) {
  const mandoline::CutResult result = mandoline::cut(mesh, grid);
  INFO(result.error.message);
  REQUIRE(result);
  return result.mesh;
}

Grid unitCells(int64_t n) { return Grid::regular({0, 0, 0}, {1, 1, 1}, {n, n, n}); }

std::string vtuOf(const Mesh& mesh, const CutMesh& cutMesh, const WriteOptions& options = {}) {
  std::ostringstream out;
  mandoline::writeVtu(out, mesh, cutMesh, options);
  return out.str();
}

/// See requireMatching(); with so many polyhedra.
void requireConforming(const Mesh& mesh, const Grid& grid, size_t polyhedra) {
  const CutMesh cutMesh = cutOrFail(mesh, grid);
  const Vtu vtu(vtuOf(mesh, cutMesh));
  const auto types = vtu.array<uint8_t>("types");
  REQUIRE(types.size() == cutMesh.cellCount() + mandoline::UntouchedCells(cutMesh).count());
  REQUIRE(size_t(std::count(types.begin(), types.end(), 42)) == polyhedra);
  REQUIRE(vtu.array<int32_t>("region").size() == types.size());
  REQUIRE(vtu.array<int32_t>("grid_cell").size() == 3 * types.size());
  REQUIRE(vtu.has("winding") == cutMesh.hasWinding);
  vtu_files::requireMatching(vtu, grid);
}

}  // namespace

TEST_CASE("OBJ in all its forms", "[io]") {
  requireSquare(readText("a.obj", kObj));
  requireSquare(readText("corners.obj", "v 0 0 0\nv 1 0 0\nv 1 0.1 0\nv 0 1 -2.5e-3\nvt 0 0\nvn 0 0 1\nf 1/1 2/1/1 3//1 4/1/\n"));
  requireSquare(readText("negative.obj", "v 0 0 0\nv 1 0 0\nv 1 0.1 0\nv 0 1 -2.5e-3\nf -4 -3/-1 -2//-1 -1\n"));
  requireSquare(readText("crlf.obj", "# c\r\nv 0 0 0\r\n\r\nv 1 0 0\r\nv 1 0.1 0\r\nv 0 1 -2.5e-3\r\nf 1 2 3 4\r\n"));
  requireSquare(readText("cr.obj", "v 0 0 0\rv 1 0 0\rv 1 0.1 0\rv 0 1 -2.5e-3\rf 1 2 3 4"));
  requireSquare(readText("continued.obj", "v 0 \\\n0 0\nv 1 0 0\nv 1 0.1 0\nv 0 1 -2.5e-3\nf 1 2 \\\r\n 3 4"));
  requireSquare(readText("extras.obj",
                         "mtllib x.mtl\no thing\nv +0 0 0 1\nv 1 0 0 0.5 0.5 0.5\n\tv 1. 1e-1 0 # corner\nv 0 1 -.0025\ns off\n"
                         "usemtl a#b\nl 1 2\nf 1 2 3 4 # face\n"));
  requireSquare(readText("forward.obj", "f 1 2 3 4\nv 0 0 0\nv 1 0 0\nv 1 0.1 0\nv 0 1 -2.5e-3\n"));
  requireSquare(readText("mark.obj", "\xef\xbb\xbf" + kObj));
}

TEST_CASE("OFF in all its forms", "[io]") {
  requireSquare(readText("a.off", kOff));
  requireSquare(readText("oneline.off", "OFF 4 1 0\n0 0 0\n1 0 0\n1 0.1 0\n0 1 -2.5e-3\n4 0 1 2 3\n"));
  requireSquare(readText("glued.off", "OFF4 1 0\n0 0 0\n1 0 0\n1 0.1 0\n0 1 -2.5e-3\n4 0 1 2 3"));
  requireSquare(readText("comments.off", "# c\nOFF # c\n\n4 1\n# c\n0 0 0\n1 0 0 # c\n1 0.1 0\n\n0 1 -2.5e-3\n4 0 1 2 3 255 0 0\n"));
  requireSquare(readText("colours.off", "COFF\n4 1 0\n0 0 0 1 0 0 1\n1 0 0 1 0 0 1\n1 0.1 0 1 0 0 1\n0 1 -2.5e-3 1 0 0 1\n4 0 1 2 3\n"));
  requireSquare(
      readText("normals.off", "NOFF\r\n4 1 0\r\n0 0 0 0 0 1\r\n1 0 0 0 0 1\r\n1 0.1 0 0 0 1\r\n0 1 -2.5e-3 0 0 1\r\n4 0 1 2 3\r\n"));
  requireSquare(readText("headless.off", "4 1 0\n0 0 0\n1 0 0\n1 0.1 0\n0 1 -2.5e-3\n4 0 1 2 3\n"));
}

TEST_CASE("OBJ and STL alone: nothing of other files, and errors", "[io]") {
  const auto read = [](std::string_view text, const std::string& name) { return mandoline::readObjOrStl(text, name); };
  requireSquare(read(kObj, "a.obj").value());
  CHECK(read("solid\nfacet normal 0 0 1\nouter loop\nvertex 0 0 0\nvertex 1 0 0\nvertex 0 1 0\nendloop\nendfacet\nendsolid\n", "a.stl"));
  CHECK(!read(kAsciiPly, "a.ply"));
  CHECK(!read(kOff, "a.off"));
  CHECK(!read("", "a.obj"));
  CHECK(!read("<html>", "a.obj"));
  CHECK(!read("# vtk DataFile Version 3.0\no title\nASCII\nDATASET POLYDATA\n", "a.vtk"));
  CHECK_THROWS_AS(read("v 0 0 0\nf 1 1 2\n", "a.obj"), FileError);
}

TEST_CASE("PLY in text", "[io]") {
  requireSquare(readText("a.ply", kAsciiPly));
  std::string crlf;
  for (const char c : kAsciiPly) crlf += c == '\n' ? std::string("\r\n") : std::string(1, c);
  requireSquare(readText("crlf.ply", crlf));
  requireSquare(readText("extras.ply",
                         "ply\nformat ascii 1.0\nobj_info x\nelement vertex 4\nproperty float z\nproperty uchar red\nproperty float x\n"
                         "property list uchar int tags\nproperty float y\nelement edge 1\nproperty int a\nproperty int b\nelement face 1\n"
                         "property list uchar float texcoord\nproperty list uint8 int32 vertex_index\nend_header\n"
                         "0 9 0 0 0\n0 9 1 1 5 0\n0 9 1 2 5 6 0.1\n-2.5e-3 9 0 0 1\n0 1\n3 .1 .2 .3 4 0 1 2 3\n"));
  // Faces may come before their vertices.
  requireSquare(
      readText("faces-first.ply",
               "ply\nformat ascii 1.0\nelement face 1\nproperty list uchar int vertex_indices\nelement vertex 4\nproperty float x\n"
               "property float y\nproperty float z\nend_header\n4 0 1 2 3\n0 0 0\n1 0 0\n1 0.1 0\n0 1 -2.5e-3\n"));
}

TEST_CASE("PLY in binary of either byte order", "[io]") {
  for (const bool bigEndian : {false, true}) {
    const Mesh mesh = readText("a.ply", binaryPly(bigEndian));
    REQUIRE(mesh.positions == std::vector<double>{0.1, 0, 0, 1, 0, -3, 1, 1.25, 0, -1e-300, 1, 5});
    REQUIRE(mesh.triangles == kSquareTriangles);
  }
}

TEST_CASE("STL in text", "[io]") {
  const Mesh mesh = readText("a.stl", kAsciiStl);
  REQUIRE(mesh.positions == kStlPositions);
  REQUIRE(mesh.triangles == std::vector<uint32_t>{0, 1, 2});
  const Mesh two = readText("two.stl", kAsciiStl +
                                           "SOLID\nFACET NORMAL nan nan nan OUTER LOOP VERTEX 0 0 0 VERTEX 1 0 0 VERTEX 1 0.1 0 "
                                           "ENDLOOP ENDFACET\nENDSOLID\n");
  REQUIRE(two.vertexCount() == 6);
  REQUIRE(two.triangles == std::vector<uint32_t>{0, 1, 2, 3, 4, 5});
}

TEST_CASE("STL in binary, even where it begins with solid", "[io]") {
  const std::vector<float> corners = {0, 0, 0, 1, 0, 0, 1, 0.1f, 0, 0, 0, 0, 1, 0.1f, 0, 0, 1, 2};
  for (const std::string header : {"binary", "solid exported", "solid"}) {
    const Mesh mesh = readText("a.stl", binaryStl(header, 2, corners));
    REQUIRE(mesh.positions == std::vector<double>(corners.begin(), corners.end()));
    REQUIRE(mesh.triangles == std::vector<uint32_t>{0, 1, 2, 3, 4, 5});
  }
  // A few bytes behind the last triangle do no harm.
  REQUIRE(readText("padded.stl", binaryStl("solid exported", 2, corners) + std::string(16, '\0')).triangleCount() == 2);
}

namespace {

/// What the slices of a file make up, or nothing if one of them can't be read by itself.
std::optional<Mesh> readInSlices(const std::string& path, uint32_t count) {
  Mesh whole;
  uint64_t sample = 0;
  for (uint32_t index = 0; index < count; ++index) {
    const auto slice = mandoline::detail::readMeshSlice(path, {index, count});
    if (!slice) return std::nullopt;
    CHECK(slice->mesh.triangleCount() <= 7 / count + 1);
    CHECK((index == 0 || slice->sample == sample));
    sample = slice->sample;
    whole.positions.insert(whole.positions.end(), slice->mesh.positions.begin(), slice->mesh.positions.end());
    whole.triangles.insert(whole.triangles.end(), slice->mesh.triangles.begin(), slice->mesh.triangles.end());
  }
  return whole;
}

/// Of triangles, unless one is a square.
std::string coloredPly(bool bigEndian, int triangles, int square) {
  std::string file = std::string("ply\nformat binary_") + (bigEndian ? "big" : "little") +
                     "_endian 1.0\ncomment 1\nelement vertex 5\nproperty uchar red\nproperty double y\nproperty float x\n"
                     "property short z\nelement face " +
                     std::to_string(triangles) + "\nproperty ushort flag\nproperty list int uchar vertex_indices\nend_header\n";
  const auto add = [&](auto value) { file += bytes(value, bigEndian); };
  for (int v = 0; v < 5; ++v) add(uint8_t(v)), add(0.1 * v), add(float(v * v)), add(int16_t(3 - v));
  for (int t = 0; t < triangles; ++t) {
    const int corners = t == square ? 4 : 3;
    add(uint16_t(3)), add(int32_t(corners));
    for (int i = 0; i < corners; ++i) add(uint8_t((t + i) % 5));
  }
  return file;
}

}  // namespace

TEST_CASE("Slices of binary files of triangles make up the whole; other files have none", "[io]") {
  const TemporaryFolder folder;
  std::vector<float> corners;
  for (int i = 0; i < 9 * 7; ++i) corners.push_back(float(i * i % 11));
  const std::string files[] = {folder.write("little.ply", coloredPly(false, 7, -1)), folder.write("big.ply", coloredPly(true, 7, -1)),
                               folder.write("a.stl", binaryStl("solid", 7, corners))};
  for (const std::string& file : files) {
    const Mesh whole = mandoline::readMesh(file);
    for (const uint32_t count : {1u, 2u, 3u, 12u}) {
      CAPTURE(file, count);
      const std::optional<Mesh> made = readInSlices(file, count);
      REQUIRE(made);
      CHECK(made->positions == whole.positions);
      CHECK(made->triangles == whole.triangles);
    }
  }
  std::string damaged = coloredPly(false, 7, -1);
  damaged.back() = 9;  // no vertex
  const std::string others[] = {folder.write("square.ply", coloredPly(false, 7, 4)),
                                folder.write("last.ply", coloredPly(true, 7, 6)),
                                folder.write("short.ply", coloredPly(false, 7, -1).substr(0, 300)),
                                folder.write("damaged.ply", damaged),
                                folder.write("text.stl", kAsciiStl),
                                folder.write("lists.ply", binaryPly(false)),
                                folder.write("empty.ply", ""),
                                folder.path("none.ply")};
  for (const std::string& file : others) {
    CAPTURE(file);
    CHECK_FALSE(readInSlices(file, 3));
  }
  CHECK(mandoline::detail::readMeshSlice(files[0], {0, 2})->sample != mandoline::detail::readMeshSlice(files[1], {0, 2})->sample);
}

TEST_CASE("Slices of PLY files are found after headers of any length", "[io]") {
  constexpr size_t kBlock = size_t(1) << 16;
  const TemporaryFolder folder;
  const std::string plain = coloredPly(false, 7, -1), end = "end_header\n";
  const size_t at = plain.find(end);
  for (const std::string lineEnd : {"\n", "\r\n", "\r"}) {
    for (const size_t length :
         {kBlock - 2, kBlock - 1, kBlock, kBlock + 1, kBlock + 2, kBlock + 3, kBlock + 11, kBlock + 12, 16 * kBlock, 20 * kBlock}) {
      const std::string ending = "end_header" + lineEnd, comment = "comment ";
      const std::string filling(length - at - ending.size() - comment.size() - 1, 'c');
      const std::string file =
          folder.write("long.ply", plain.substr(0, at) + comment + filling + "\n" + ending + plain.substr(at + end.size()));
      CAPTURE(ending, length);
      const Mesh whole = mandoline::readMesh(file);
      const std::optional<Mesh> made = readInSlices(file, 2);
      REQUIRE(made);
      CHECK(made->positions == whole.positions);
      CHECK(made->triangles == whole.triangles);
    }
  }
}

TEST_CASE("Slices of files that end too early are not read", "[io]") {
  const TemporaryFolder folder;
  std::vector<float> corners;
  for (int i = 0; i < 9 * 7; ++i) corners.push_back(float(i * i % 11));
  for (const std::string& whole : {coloredPly(false, 7, -1), binaryStl("solid", 7, corners)}) {
    for (size_t length = 0; length < whole.size(); ++length) {
      CAPTURE(length, whole.size());
      const std::string file = folder.write("short", whole.substr(0, length));
      for (const uint32_t count : {1u, 2u, 3u}) CHECK_FALSE(readInSlices(file, count));
      if (length > 1) CHECK_THROWS_AS(mandoline::readMesh(file), mandoline::FileError);  // of one letter, it may be OBJ
    }
  }
}

TEST_CASE("Doubles are kept", "[io]") {
  const std::vector<double> values = {0.1, 1.0 / 3, 5e-324, 1.7976931348623157e308, -2.2250738585072014e-308, 0.30000000000000004};
  std::string obj, off = "OFF\n2 0 0\n";
  for (size_t v = 0; v < 2; ++v) {
    char line[128];
    std::snprintf(line, sizeof line, "%.17g %.17g %.17g\n", values[3 * v], values[3 * v + 1], values[3 * v + 2]);
    obj += std::string("v ") + line;
    off += line;
  }
  REQUIRE(readText("a.obj", obj).positions == values);
  REQUIRE(readText("a.off", off).positions == values);
}

TEST_CASE("Coordinates that are not finite are read as such", "[io]") {
  const Mesh mesh = readText("a.obj", "v nan inf -inf\nv 1e999 -1e999 1e-999\nv -nan NAN INF\nf 1 2 3\n");
  REQUIRE(std::isnan(mesh.positions[0]));
  REQUIRE(mesh.positions[1] == INFINITY);
  REQUIRE(mesh.positions[2] == -INFINITY);
  REQUIRE(mesh.positions[3] == INFINITY);
  REQUIRE(mesh.positions[4] == -INFINITY);
  REQUIRE(mesh.positions[5] == 0);
  REQUIRE(std::isnan(mesh.positions[6]));
  REQUIRE(mandoline::cut(mesh, unitCells(1)).error.status == mandoline::Status::nonFiniteCoordinate);
}

TEST_CASE("Content decides before the extension", "[io]") {
  requireSquare(readText("a.stl", kObj));
  requireSquare(readText("a.obj", kOff));
  requireSquare(readText("a.off", kAsciiPly));
  REQUIRE(readText("noextension", kAsciiStl).positions == kStlPositions);
  requireSquare(readText("unknown-keyword-first.OBJ", "ctech x\n" + kObj));
  requireError("a.txt", "hello\n", "neither the content nor the name");
}

TEST_CASE("Files of formats that are not read are named, with what to do", "[io]") {
  using namespace std::string_literals;
  // By content, not by the name.
  requireError("a.obj", "glTF\x02\0\0\0"s, "a.obj: this is a glTF file, not OBJ, STL, PLY or OFF: convert it to one of them");
  requireError("a", "\n {\"asset\":{\"version\":\"2.0\"}}", "a glTF or other JSON file");
  requireError("a", "PK\x03\x04 archive 3D/3dmodel.model", "a 3MF file");
  requireError("a.3mf", "PK\x03\x04 archive scene.usdc", "a USD file");
  requireError("a.obj", "PK\x03\x04 archive", "a ZIP archive, not OBJ, STL, PLY or OFF: unpack it first");
  requireError("a", "# vtk DataFile Version 3.0\nv 1 2 3\n", "a VTK file");
  requireError("a", "<?xml version=\"1.0\"?>\n<VTKFile type=\"PolyData\">", "a VTK file");
  requireError("a", "$MeshFormat\n4.1 0 8\n", "a Gmsh file, not OBJ, STL, PLY or OFF: convert its surface");
  requireError("a", "\xef\xbb\xbfISO-10303-21;\n", "a STEP file, not OBJ, STL, PLY or OFF: its surfaces have to be divided into triangles");
  requireError("a", "Kaydara FBX Binary  \0"s, "an FBX file");
  requireError("a", "BLENDER-v402", "a Blender file");
  requireError("a", "<?xml version=\"1.0\"?><COLLADA>", "a COLLADA file");
  requireError("a", "<?xml version=\"1.0\"?><other>", "an XML file");
  requireError("a.stl", "<!DOCTYPE html><html>", "a web page");
  // By name.
  requireError("a.igs", "1\n", "an IGES file");
  requireError("A.STEP", "1\n", "a STEP file");
  requireError("a.vtp.gz", "1\n", "a VTK file");
  requireError("a.zip", "1\n", "a ZIP archive");
  requireError("a.", "1\n", "neither the content nor the name");
}

TEST_CASE("Gzipped files", "[io]") {
  try {
    readText("probe.obj.gz", gzipped(kObj));
  } catch (const FileError& error) {
    if (std::string(error.what()).find("no zlib") == std::string::npos) throw;
    WARN("built without zlib");
    return;
  }
  requireSquare(readText("a.obj.gz", gzipped(kObj)));
  requireSquare(readText("a.off", gzipped(kOff)));
  requireSquare(readText("headless.OFF.GZ", gzipped(kOff.substr(4))));
  requireSquare(readText("a.ply.gz", gzipped(kAsciiPly)));
  REQUIRE(readText("a.stl.gz", gzipped(binaryStl("solid", 1, std::vector<float>(9, 1)))).triangleCount() == 1);
  requireSquare(readText("members.obj.gz", gzipped(kObj.substr(0, 20)) + gzipped(kObj.substr(20))));
  requireSquare(readText("padded.obj.gz", gzipped(kObj) + std::string(100, '\0')));
  // 1000 times "v 0 0 0\n", packed by gzip.
  const std::string packed(
      "\x1f\x8b\x08\x00\x00\x00\x00\x00\x02\x03\xed\xc5\x31\x0d\x00\x00\x08\x03\xb0\x1f\x15\x48\x40\xdd\xf4\x13\x74"
      "\xd0\xf4\x68\x7a\x4e\xc5\xb6\x6d\xdb\xb6\x6d\xdb\xb6\x6d\xdb\xb6\xed\xc7\x2f\xd1\x0b\x4a\x78\x40\x1f\x00\x00",
      54);
  REQUIRE(readText("packed.obj.gz", packed).positions == std::vector<double>(3000, 0));
  for (size_t size = 2; size < packed.size(); ++size) requireError("cut.obj.gz", packed.substr(0, size), "the gzip data end early");
  const std::string whole = gzipped(kObj);
  for (size_t size = 2; size < whole.size(); ++size) requireError("cut.obj.gz", whole.substr(0, size), "the gzip data end early");
  std::string damaged = whole;
  damaged[30] = char(damaged[30] ^ 1);
  requireError("damaged.obj.gz", damaged, "damaged gzip data");
  requireError("empty.obj.gz", gzipped(""), "the file is empty");
}

TEST_CASE("Files that can't be opened", "[io]") {
  TemporaryFolder folder;
  REQUIRE_THROWS_WITH(mandoline::readMesh(folder.path("none.obj")), folder.path("none.obj") + ": No such file or directory");
  REQUIRE_THROWS_WITH(mandoline::readMesh(folder.path("")), folder.path("") + ": is a directory");
  for (const std::string name : {"a.obj", "a.stl", "a.ply", "a.off", "a"}) requireError(name, "", "the file is empty");
}

TEST_CASE("Damaged OBJ files name the line", "[io]") {
  requireError("a.obj", "v 0 0 0\nv 1 x 0\n", "line 2: expected a number, found 'x'");
  requireError("a.obj", "v 0 0 0\nv 1 2\nv 0 0 0\n", "line 2: expected a number, found the end of the line");
  requireError("a.obj", "v 0 0 0\r\nv 1 2", "line 2: expected a number, found the end of the file");
  requireError("a.obj", "v 0 0 1.5.2\n", "line 1: expected a number, found '1.5.2'");
  requireError("a.obj", "v 0 0 0 red\n", "line 1: expected a number, found 'red'");
  requireError("a.obj", "v 0 \\\n0 zero\n", "line 2: expected a number, found 'zero'");
  requireError("a.obj", "v 0 0 0\n\nf 1 1 2\n", "line 3: there is no vertex 2 (vertices are numbered from 1; there are 1)");
  requireError("a.obj", "v 0 0 0\nf 1 0 1\n", "line 2: there is no vertex 0");
  requireError("a.obj", "v 0 0 0\nf 1 1 -2\n", "line 2: there is no vertex -2");
  requireError("a.obj", "v 0 0 0\nf 1 1 99999999999999999999\n", "line 2: expected a whole number");
  requireError("a.obj", "v 0 0 0\nf 1 1 4294967297\n", "line 2: there is no vertex 4294967297");
  requireError("a.obj", "v 0 0 0\nf 1 1\n", "line 2: a face needs at least three vertices, found 2");
  requireError("a.obj", "v 0 0 0\nf 1 1 1.5\n", "line 2: expected a vertex such as");
  requireError("a.obj", "v 0 0 0\nf 1/x 1 1\n", "line 2: expected a whole number");
  requireError("a.obj", "v 0 0 0\nf 1/1/1/1 1 1\n", "line 2: expected a vertex such as");
}

TEST_CASE("Damaged OFF files name the line", "[io]") {
  for (size_t size = 1; size + 2 < kOff.size(); ++size) {
    if (size >= 3) requireError("a.off", kOff.substr(0, size), "line ");
  }
  requireError("a.off", "OFF\n4000000000000 1 0\n0 0 0\n", "line 2: 4000000000000 vertices can't be in a file of this size");
  requireError("a.off", "OFF\n1 99 0\n0 0 0\n", "line 2: 99 faces can't be in a file of this size");
  requireError("a.off", "OFF\n-1 1 0\n", "line 2: -1 vertices");
  requireError("a.off", "OFF\nmany 1 0\n", "line 2: expected a whole number, found 'many'");
  requireError("a.off", "OFF\n1 1 0\n0 0 nil\n3 0 0 0\n", "line 3: expected a number, found 'nil'");
  requireError("a.off", "OFF\n1 1 0\n0 0 0\n3 0 0 1\n", "line 4: there is no vertex 1 (vertices are numbered from 0; there are 1)");
  requireError("a.off", "OFF\n1 1 0\n0 0 0\n3 0 -1 0\n", "line 4: there is no vertex -1");
  requireError("a.off", "OFF\n1 1 0\n0 0 0\n2 0 0   \n", "line 4: a face needs at least three vertices, found 2");
  requireError("a.off", "OFF\n1 1 0\n0 0 0\n9 0 0 0 0\n", "line 4: expected a whole number, found the end of the line");
  requireError("a.off", "OFF\n1 1 0\n0 0 0\n3 0 0 0\n3 0 0 0\n", "line 5: more follows");
  requireError("a.off", "4OFF\n1 1 0\n0 0 0 0\n3 0 0 0\n", "three-dimensional");
  requireError("a.off", "OFF BINARY\n", "binary OFF");
}

TEST_CASE("Damaged text PLY files name the line", "[io]") {
  for (size_t size = 4; size + 2 < kAsciiPly.size(); ++size) requireError("a.ply", kAsciiPly.substr(0, size), "line ");
  const auto replaced = [](const std::string& from, const std::string& to) {
    std::string ply = kAsciiPly;
    return ply.replace(ply.find(from), from.size(), to);
  };
  requireError("a.ply", "not a ply file", "line 1: expected 'ply'");
  requireError("a.ply", replaced("vertex 4", "vertex 4000000000000"), "line 4: 4000000000000 items of the element vertex");
  requireError("a.ply", replaced("face 1", "face 100"), "line 8: 100 items of the element face");
  requireError("a.ply", replaced("face 1", "face -1"), "line 8: the element face has a negative count");
  requireError("a.ply", replaced("vertex 4", "vertex x"), "line 4: expected a whole number, found 'x'");
  requireError("a.ply", replaced("ascii", "latin"), "line 2: unknown format 'latin'");
  requireError("a.ply", replaced("format ascii 1.0\n", ""), "lacks the line 'format'");
  requireError("a.ply", replaced("double y", "quad y"), "line 6: unknown type 'quad'");
  requireError("a.ply", replaced("double y", "double x"), "line 6: the property occurs twice");
  requireError("a.ply", replaced("property double z\n", ""), "line 4: the element vertex lacks x, y or z");
  requireError("a.ply", replaced("vertex_indices", "corners"), "line 8: the element face lacks the list vertex_indices");
  requireError("a.ply", replaced("uchar int", "float int"), "line 9: the length of a list must be of an integer type");
  requireError("a.ply", replaced("uchar int", "uchar float"), "line 9: vertex indices must be of an integer type");
  requireError("a.ply", replaced("element face", "element tristrips"), "triangle strips");
  requireError("a.ply", replaced("element vertex 4\n", ""), "a property without an element");
  requireError("a.ply", replaced("element vertex", "element point"), "needs one element vertex");
  requireError("a.ply", replaced("comment", "remark"), "line 3: unknown keyword 'remark'");
  requireError("a.ply", replaced("1 0.1 0", "1 0.1 up"), "line 13: expected a number, found 'up'");
  requireError("a.ply", replaced("4 0 1 2 3", "4 0 1 2 4"), "line 15: there is no vertex 4");
  requireError("a.ply", replaced("4 0 1 2 3", "4 0 1 2 -1"), "line 15: there is no vertex -1");
  requireError("a.ply", replaced("4 0 1 2 3", "2 0 1"), "line 15: a face needs at least three vertices, found 2");
  requireError("a.ply", replaced("4 0 1 2 3", "255 0 1 2"), "line 15: a list of 255 entries can't be in the rest of the file");
  requireError("a.ply", replaced("4 0 1 2 3", "-4 0 1 2 3"), "line 15: a list of -4 entries");
}

TEST_CASE("Damaged binary PLY files name the byte", "[io]") {
  for (const bool bigEndian : {false, true}) {
    const std::string whole = binaryPly(bigEndian);
    const size_t data = whole.find("end_header\n") + std::strlen("end_header\n");
    for (size_t size = data; size < whole.size(); ++size) {
      TemporaryFolder folder;
      REQUIRE_THROWS_AS(mandoline::readMesh(folder.write("a.ply", whole.substr(0, size))), FileError);
    }
    requireError("a.ply", whole.substr(0, whole.size() - 1), "byte " + std::to_string(whole.size() - 4) + ": face 0: the file ends here");
    std::string badIndex = whole;
    badIndex[whole.size() - 7] = badIndex[whole.size() - 6] = 1;
    requireError("a.ply", badIndex, "face 0: there is no vertex ");
    std::string badLength = whole;
    badLength[whole.size() - 22] = badLength[whole.size() - 21] = '\x7f';
    requireError("a.ply", badLength, "face 0: a list of 32639 entries can't be in the rest of the file");
  }
}

TEST_CASE("Damaged STL files name the line or the byte", "[io]") {
  for (size_t size = 6; size < kAsciiStl.find("endsolid") + 8; ++size) requireError("a.stl", kAsciiStl.substr(0, size), "line ");
  const auto replaced = [](const std::string& from, const std::string& to) {
    std::string stl = kAsciiStl;
    return stl.replace(stl.find(from), from.size(), to);
  };
  requireError("a.stl", replaced("0.1", "ten"), "line 6: expected a number, found 'ten'");
  requireError("a.stl", replaced("   vertex 1 0.1 0\n", ""), "line 6: expected vertex, found 'endloop'");
  requireError("a.stl", replaced("  endloop\n", "  vertex 0 0 0\n  endloop\n"), "line 7: expected endloop, found 'vertex'");
  requireError("a.stl", replaced(" facet", " fazet"), "line 2: expected facet or endsolid, found 'fazet'");
  const std::string binary = binaryStl("solid exported", 2, std::vector<float>(18, 1));
  requireError("a.stl", binary.substr(0, 83), "byte 83: the file ends within the header");
  requireError("a.stl", binary.substr(0, 100), "byte 80: the header of the binary STL file promises 2 triangles, but the file holds 0");
  requireError("a.stl", binary.substr(0, binary.size() - 1), "promises 2 triangles, but the file holds 1");
  requireError("a.stl", binaryStl("x", 4000000000u, std::vector<float>(18, 1)), "promises 4000000000 triangles, but the file holds 2");
  requireError("a.stl", binaryStl("x", 0, std::vector<float>(18, 1)), "promises 0 triangles, but the file holds 2");
}

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

TEST_CASE("VTU cells match face by face", "[io]") {
  SECTION("aligned cube") { requireConforming(shapes::cube(1, 3), unitCells(4), 32); }
  SECTION("sphere") {
    const Mesh sphere = shapes::icosphere({2, 2, 2}, 1.4, 2);
    requireConforming(sphere, unitCells(4), cutOrFail(sphere, unitCells(4)).cellCount());
  }
  SECTION("tube through grid-faces, which get holes") {
    requireConforming(shapes::tube({1.5, 1.5, 0.5}, 0.3, 2, 8, true), unitCells(3), 6);
    requireConforming(shapes::tube({1.5, 1.5, 0.5}, 0.3, 2, 8, false), unitCells(3), 4);
  }
  SECTION("quad floating in a cell") {
    requireConforming(shapes::quad({1.2, 1.2, 1.5}, {1.8, 1.2, 1.5}, {1.8, 1.8, 1.5}, {1.2, 1.8, 1.5}), unitCells(3), 1);
  }
  SECTION("bubble with a cavity") { requireConforming(shapes::icosphere({1.5, 1.5, 1.5}, 0.3, 1), unitCells(3), 2); }
  SECTION("tip on a grid-edge, which three untouched cells share") {
    requireConforming(shapes::tetrahedron({1.5, 1, 1}, {1.75, 1.25, 1.25}, {1.25, 1.25, 1.25}, {1.5, 1.25, 1.5}), unitCells(3), 5);
  }
  SECTION("two tips on the same grid-edge") {
    const Mesh tips = shapes::merged({shapes::tetrahedron({1.25, 1, 1}, {1.375, 1.25, 1.25}, {1.125, 1.25, 1.25}, {1.25, 1.25, 1.5}),
                                      shapes::tetrahedron({1.75, 1, 1}, {1.875, 1.25, 1.25}, {1.625, 1.25, 1.25}, {1.75, 1.25, 1.5})});
    requireConforming(tips, unitCells(3), 6);
  }
  SECTION("nothing but untouched cells") { requireConforming(shapes::cube(7, 8), unitCells(4), 0); }
}

TEST_CASE("VTU of some cells has those, their points and nothing else", "[io]") {
  // A bubble around a grid vertex, a tip on a grid-edge of untouched cells, and a sheet.
  const Mesh mesh = shapes::merged({shapes::icosphere({2, 2, 2}, 1.4, 1), shapes::cube(1.75, 2.25),
                                    shapes::tetrahedron({4.5, 4, 4}, {4.75, 4.25, 4.25}, {4.25, 4.25, 4.25}, {4.5, 4.25, 4.5})});
  const CutMesh cutMesh = cutOrFail(mesh, unitCells(6));
  const Vtu whole(vtuOf(mesh, cutMesh));
  const auto wholeRegions = whole.array<int32_t>("region");
  const auto wholeCells = vtu_files::cellFaces(whole);
  const auto wholePositions = whole.array<double>("Points");
  for (const bool untouched : {false, true}) {
    for (uint32_t kept = 0; kept <= cutMesh.regionCount; ++kept) {
      WriteOptions options;
      options.untouched = untouched;
      if (kept < cutMesh.regionCount) {
        options.regions.assign(cutMesh.regionCount, 0);
        options.regions[kept] = 1;
      }
      CAPTURE(untouched, kept);
      const Vtu some(vtuOf(mesh, cutMesh, options));
      const auto cells = vtu_files::cellFaces(some);
      const auto positions = some.array<double>("Points");
      std::vector<uint8_t> used(positions.size() / 3, 0);
      size_t next = 0;
      for (size_t c = 0; c < wholeCells.size(); ++c) {
        if (c >= cutMesh.cellCount() && !untouched) break;
        if (kept < cutMesh.regionCount && wholeRegions[c] != int32_t(kept)) continue;
        REQUIRE(next < cells.size());
        REQUIRE(cells[next].size() == wholeCells[c].size());
        for (size_t f = 0; f < wholeCells[c].size(); ++f) {
          const vtu_files::Polygon &a = wholeCells[c][f], &b = cells[next][f];
          REQUIRE(a.size() == b.size());
          for (size_t i = 0; i < a.size(); ++i) {
            REQUIRE(std::equal(&wholePositions[size_t(3 * a[i])], &wholePositions[size_t(3 * a[i])] + 3, &positions[size_t(3 * b[i])]));
            used[size_t(b[i])] = 1;
          }
        }
        ++next;
      }
      REQUIRE(next == cells.size());
      REQUIRE(some.array<double>("volume").size() == cells.size());
      REQUIRE(std::count(used.begin(), used.end(), 0) == 0);
    }
  }
}

TEST_CASE("OBJ of the cut surface reads back as the same surface", "[io]") {
  const Mesh cube = shapes::cube(0.75, 2.25);
  const CutMesh cutMesh = cutOrFail(cube, unitCells(3));
  std::ostringstream out;
  mandoline::writeObj(out, cutMesh);
  const std::string obj = out.str();
  const Mesh surface = readText("a.obj", obj);
  REQUIRE(shapes::signedVolume(surface) == Approx(3.375));
  REQUIRE(shapes::area(surface) == Approx(13.5));
  REQUIRE(size_t(std::count(obj.begin(), obj.end(), 'f')) ==
          size_t(std::count_if(cutMesh.faceTriangle.begin(), cutMesh.faceTriangle.end(), [](int32_t t) { return t >= 0; })));
  REQUIRE(size_t(std::count(obj.begin(), obj.end(), 'g')) == 2);  // one group; "region" has the other
}

TEST_CASE("OBJ lists each nested surface under the region it encloses", "[io]") {
  const Mesh nested = shapes::merged({shapes::cube(0.5, 3.5), shapes::cube(1.25, 2.75)});
  const CutMesh cutMesh = cutOrFail(nested, unitCells(4));
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
  const CutMesh cutMesh = cutOrFail(mesh, unitCells(4));
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
  const CutMesh cutMesh = cutOrFail(cube, unitCells(3));
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
  const CutMesh cutMesh = cutOrFail(cube, unitCells(3));
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
}

TEST_CASE("Writing shows progress, and cancels without leaving a file", "[io]") {
  const Mesh mesh = shapes::icosphere({8, 8, 8}, 6.3, 5);
  const CutMesh cutMesh = cutOrFail(mesh, unitCells(16));
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

TEST_CASE("A mesh that can't be inspected is refused", "[inspect]") {
  using Refusal = std::pair<Status, int64_t>;
  const auto inspect = [](const Mesh& mesh) { return refusal([&] { mandoline::inspect(mesh); }); };
  CHECK(inspect({{0, 0, 0}, {0, 0, 0, 0, 1, 0}}) == Refusal{Status::badIndex, 1});
  CHECK(inspect({{0, 0}, {}}) == Refusal{Status::badArrays, -1});
  CHECK(inspect({{0, 0, 0}, {0, 0}}) == Refusal{Status::badArrays, -1});
  CHECK(inspect({{0, 0, 0}, {0, 0, 0}}) == Refusal{Status::ok, -1});
}

TEST_CASE("A full disk is an error", "[io]") {
  if (!std::filesystem::exists("/dev/full")) return;
  TemporaryFolder folder;
  const Mesh cube = shapes::cube(0.75, 2.25);
  const CutMesh cutMesh = cutOrFail(cube, unitCells(3));
  for (const std::string name : {"full.json", "full.vtu", "full.obj"}) {
    std::filesystem::create_symlink("/dev/full", folder.path(name));
    REQUIRE_THROWS_WITH(mandoline::writeCutMesh(folder.path(name), cube, cutMesh),
                        folder.path(name) + ": can't be written: No space left on device");
  }
}

// Slices of files of triangles, as several processes read them.
#include <optional>

#include "catch.h"
#include "mesh/read/load_file.h"
#include "sample_files.h"

using namespace sample_files;

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

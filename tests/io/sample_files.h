// Files of a square in every format, made in memory, and what reading them must give.
#pragma once

#include <algorithm>
#include <cstring>
#include <string>
#include <vector>

#include "catch.h"
#include "mandoline/io.h"
#include "temporary_folder.h"

namespace sample_files {

using mandoline::FileError;
using mandoline::Mesh;

// A square as one polygon; its fan is 0 1 2, 0 2 3.
inline const std::vector<double> kSquarePositions = {0, 0, 0, 1, 0, 0, 1, 0.1, 0, 0, 1, -2.5e-3};
inline const std::vector<uint32_t> kSquareTriangles = {0, 1, 2, 0, 2, 3};

/// Reads the file, and requires the same from its bytes.
inline Mesh readText(const std::string& name, const std::string& content) {
  TemporaryFolder folder;
  const Mesh mesh = mandoline::readMesh(folder.write(name, content)), fromBytes = mandoline::readMesh(content, name);
  REQUIRE(fromBytes.positions.size() == mesh.positions.size());
  REQUIRE(std::memcmp(fromBytes.positions.data(), mesh.positions.data(), mesh.positions.size() * sizeof(double)) == 0);
  REQUIRE(fromBytes.triangles == mesh.triangles);
  return mesh;
}

inline void requireSquare(const Mesh& mesh) {
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
inline void requireError(const std::string& name, const std::string& content, const std::string& what) {
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

inline std::string binaryStl(const std::string& header, uint32_t promised, const std::vector<float>& corners) {
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

inline const std::string kObj = "v 0 0 0\nv 1 0 0\nv 1 0.1 0\nv 0 1 -2.5e-3\nf 1 2 3 4\n";
inline const std::string kOff = "OFF\n4 1 0\n0 0 0\n1 0 0\n1 0.1 0\n0 1 -2.5e-3\n4 0 1 2 3\n";
inline const std::string kAsciiPly =
    "ply\nformat ascii 1.0\ncomment made by hand\nelement vertex 4\nproperty double x\nproperty double y\nproperty double z\n"
    "element face 1\nproperty list uchar int vertex_indices\nend_header\n0 0 0\n1 0 0\n1 0.1 0\n0 1 -2.5e-3\n4 0 1 2 3\n";
inline const std::string kAsciiStl =
    "solid a name\n facet normal 0 0 1\n  outer loop\n   vertex 0 0 0\n   vertex 1 0 0\n   vertex 1 0.1 0\n  endloop\n endfacet\n"
    "endsolid a name\n";
inline const std::vector<double> kStlPositions = {0, 0, 0, 1, 0, 0, 1, 0.1, 0};

/// Other elements and properties stand before, between and behind those that count.
inline std::string binaryPly(bool bigEndian) {
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

}  // namespace sample_files

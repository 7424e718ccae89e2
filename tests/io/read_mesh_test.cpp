// Meshes of every format in every form.
#include <cmath>

#include "catch.h"
#include "checked_cut.h"
#include "sample_files.h"

using namespace sample_files;

namespace {

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
  REQUIRE(mandoline::cut(mesh, unitGrid(1)).error.status == mandoline::Status::nonFiniteCoordinate);
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

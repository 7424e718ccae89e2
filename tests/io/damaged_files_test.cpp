// Files of meshes, damaged in every way.
#include "catch.h"
#include "sample_files.h"

using namespace sample_files;

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

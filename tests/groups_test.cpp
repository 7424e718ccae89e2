// Groups of triangles: read from files that have them, and written to files that take them.
#include <sstream>

#include "catch.h"
#include "mandoline/io.h"
#include "temporary_folder.h"

using namespace mandoline;

namespace {

using Names = std::vector<std::string>;
using Labels = std::vector<uint32_t>;

/// Reads the file and its bytes, which must give the same groups and the mesh that readMesh() gives.
TriangleGroups groupsOf(const std::string& name, const std::string& content) {
  const TemporaryFolder folder;
  const GroupedMesh fromBytes = readGroupedMesh(content, name), fromFile = readGroupedMesh(folder.write(name, content));
  const Mesh mesh = readMesh(content, name);
  REQUIRE(fromBytes.mesh.positions == mesh.positions);
  REQUIRE(fromBytes.mesh.triangles == mesh.triangles);
  REQUIRE(fromFile.mesh.triangles == mesh.triangles);
  REQUIRE(fromFile.groups.names == fromBytes.groups.names);
  REQUIRE(fromFile.groups.triangleGroup == fromBytes.groups.triangleGroup);
  REQUIRE(fromBytes.groups.triangleGroup.size() == (fromBytes.groups.empty() ? 0 : mesh.triangleCount()));
  return fromBytes.groups;
}

/// Lines after four vertices.
TriangleGroups ofObj(const std::string& lines) { return groupsOf("a.obj", "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\n" + lines); }

/// A solid of so many triangles.
std::string solid(const std::string& name, int triangles) {
  std::string text = "solid " + name + '\n';
  for (int t = 0; t < triangles; ++t) {
    text += "facet normal 0 0 1\nouter loop\nvertex 0 0 0\nvertex 1 0 0\nvertex 0 1 0\nendloop\nendfacet\n";
  }
  return text + "endsolid " + name + '\n';
}

void requireGroups(const TriangleGroups& groups, const Names& names, const Labels& labels) {
  CHECK(groups.names == names);
  CHECK(groups.triangleGroup == labels);
}

}  // namespace

TEST_CASE("OBJ: groups by g lines, in the order of their first triangles", "[groups]") {
  requireGroups(ofObj("g late\ng wheel\nf 1 2 3 4\ng body\nf 1 2 3\ng late\nf 1 2 3\n"), {"wheel", "body", "late"}, {0, 0, 1, 2});
  requireGroups(ofObj("g one\nf 1 2 3\n"), {"one"}, {0});
}

TEST_CASE("OBJ: a group named twice is one, and one without triangles is none", "[groups]") {
  requireGroups(ofObj("g a\nf 1 2 3\ng empty\ng b\nf 1 2 4\ng a\nf 1 3 4\ng last\n"), {"a", "b"}, {0, 1, 0});
}

TEST_CASE("OBJ: triangles before the first g line, and after one without a name, are in the group default", "[groups]") {
  requireGroups(ofObj("f 1 2 3\ng a\nf 1 2 4\ng\nf 1 3 4\ng default\nf 2 3 4\n"), {"default", "a"}, {0, 1, 0, 0});
}

TEST_CASE("OBJ: materials are groups where no triangle has a g line", "[groups]") {
  requireGroups(ofObj("f 1 2 3\nusemtl red\nf 1 2 4\nusemtl blue\nf 1 3 4\ng after\n"), {"default", "red", "blue"}, {0, 1, 2});
  requireGroups(ofObj("usemtl red\nf 1 2 3\ng a\nf 1 2 4\nusemtl blue\nf 1 3 4\n"), {"default", "a"}, {0, 1, 1});
}

TEST_CASE("OBJ: names of odd characters, and several on a line", "[groups]") {
  requireGroups(ofObj("g  wheel#2\tfront\r\nf 1 2 3\r\ng a/b{\"c\";}\r\nf 1 2 4\r\ng T\xc3\xbcr\r\nf 1 3 4\r\n"),
                {"wheel#2", "a/b{\"c\";}", "T\xc3\xbcr"}, {0, 1, 2});
  requireGroups(ofObj("usemtl Material #1 \nf 1 2 3\nusemtl Material #2\nf 1 2 4\n"), {"Material #1", "Material #2"}, {0, 1});
}

TEST_CASE("OBJ: lines that go on, comments and other keywords between", "[groups]") {
  requireGroups(ofObj("o object\ng a # no name\ns 1\nf 1 2 \\\n3 4 # a square\nl 1 2\n# g b\nf 1/1 2//2 3/3/3\n"), {"a"}, {0, 0, 0});
}

TEST_CASE("OBJ: no groups", "[groups]") {
  requireGroups(ofObj("o object\nf 1 2 3\ng after\nusemtl after\n"), {}, {});
  requireGroups(ofObj("g a\n"), {}, {});
}

TEST_CASE("STL: groups by solids", "[groups]") {
  requireGroups(groupsOf("a.stl", solid("left wheel #1", 2) + solid("empty", 0) + solid("body", 1) + solid("left wheel #1", 1)),
                {"left wheel #1", "body"}, {0, 0, 1, 0});
  requireGroups(groupsOf("a.stl", solid("only", 2)), {"only"}, {0, 0});
}

TEST_CASE("STL: solids without names", "[groups]") {
  requireGroups(groupsOf("a.stl", solid("", 1) + solid("", 2)), {"solid0", "solid1"}, {0, 1, 1});
  requireGroups(groupsOf("a.stl", solid("", 2)), {}, {});
  requireGroups(groupsOf("a.stl", solid("", 2) + solid("named", 0)), {}, {});
}

TEST_CASE("STL: the words of a facet, whatever they are", "[groups]") {
  const std::string text =
      "SOLID a\nFACET normal facet endsolid solid OUTER loop vertex 0 0 0 vertex 1 0 0\nvertex 0 1 0 endloop endfacet\nENDSOLID\n";
  requireGroups(groupsOf("a.stl", text + solid("b", 1)), {"a", "b"}, {0, 1});
}

TEST_CASE("Files without groups: binary STL, PLY and OFF", "[groups]") {
  const Mesh mesh{{0, 0, 0, 1, 0, 0, 0, 1, 0}, {0, 1, 2}};
  for (const FileFormat format : {FileFormat::stl, FileFormat::ply, FileFormat::off}) {
    std::string bytes;
    writeMesh([&](std::string_view piece) { bytes += piece; }, format, mesh);
    requireGroups(groupsOf(std::string("a.") + name(format), bytes), {}, {});
  }
}

// Groups of triangles: read from files that have them, and written to files that take them.
#include <cstring>

#include "catch.h"
#include "mandoline/io.h"
#include "refusal.h"
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
  REQUIRE(readGroups(content, name).triangleGroup == fromBytes.groups.triangleGroup);
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

/// What write(sink) writes.
template <class Write>
std::string written(const Write& write) {
  std::string bytes;
  write([&](std::string_view piece) { bytes += piece; });
  return bytes;
}

/// A square and two triangles above it, each a group.
const std::string kThree =
    "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\ng square\nf 1 2 3 4\n"
    "v 0 0 1\nv 1 0 1\nv 1 1 1\nv 0 1 1\ng \"a\\\nf 5 6 7\ng b\nf 5 7 8\n";

void requireGroups(const TriangleGroups& groups, const Names& names, const Labels& labels) {
  CHECK(groups.names == names);
  CHECK(groups.triangleGroup == labels);
}

}  // namespace

TEST_CASE("OBJ: groups by g lines, in the order of their first triangles", "[groups]") {
  requireGroups(ofObj("g late\ng wheel\nf 1 2 3 4\ng body\nf 1 2 3\ng late\nf 1 2 3\n"), {"wheel", "body", "late"}, {0, 0, 1, 2});
  requireGroups(ofObj("g one\nf 1 2 3\n"), {"one"}, {0});
}

TEST_CASE("OBJ: a group named twice is one group, and a group without triangles is left out", "[groups]") {
  requireGroups(ofObj("g a\nf 1 2 3\ng empty\ng b\nf 1 2 4\ng a\nf 1 3 4\ng last\n"), {"a", "b"}, {0, 1, 0});
}

TEST_CASE("OBJ: triangles before the first g line, and after one without a name, are in the group default", "[groups]") {
  requireGroups(ofObj("f 1 2 3\ng a\nf 1 2 4\ng\nf 1 3 4\ng default\nf 2 3 4\n"), {"default", "a"}, {0, 1, 0, 0});
}

TEST_CASE("Names of groups that are not UTF-8 are taken as Latin-1", "[groups]") {
  requireGroups(ofObj("g T\xfcr\nf 1 2 3\ng T\xc3\xbcr\nf 1 2 4\n"), {"T\xc3\xbcr"}, {0, 0});
  requireGroups(ofObj("usemtl gr\xfcn\nf 1 2 3\n"), {"gr\xc3\xbcn"}, {0});
  requireGroups(groupsOf("a.stl", solid("caf\xe9", 2)), {"caf\xc3\xa9"}, {0, 0});
  const std::string valid[] = {"\xc2\x80",     "\xdf\xbf",         "\xe0\xa0\x80",    "\xed\x9f\xbf",
                               "\xee\x80\x80", "\xf0\x90\x80\x80", "\xf4\x8f\xbf\xbf"};
  for (const std::string& name : valid) CHECK(ofObj("g " + name + "\nf 1 2 3\n").names == Names{name});
  // A lone byte in the middle and one at the end, overlong forms, a surrogate, beyond U+10FFFF, and characters that are cut short.
  const std::pair<std::string, std::string> invalid[] = {{"\x80", "\xc2\x80"},
                                                         {"\xff", "\xc3\xbf"},
                                                         {"\xc0\xaf", "\xc3\x80\xc2\xaf"},
                                                         {"\xe0\x9f\xbf", "\xc3\xa0\xc2\x9f\xc2\xbf"},
                                                         {"\xf0\x8f\xbf\xbf", "\xc3\xb0\xc2\x8f\xc2\xbf\xc2\xbf"},
                                                         {"\xed\xa0\x80", "\xc3\xad\xc2\xa0\xc2\x80"},
                                                         {"\xf4\x90\x80\x80", "\xc3\xb4\xc2\x90\xc2\x80\xc2\x80"},
                                                         {"\xe2\x82", "\xc3\xa2\xc2\x82"},
                                                         {"\xe2\x82x", "\xc3\xa2\xc2\x82x"}};
  for (const auto& [name, taken] : invalid) CHECK(ofObj("g " + name + "\nf 1 2 3\n").names == Names{taken});
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

TEST_CASE("STL: any words in a facet", "[groups]") {
  const std::string text =
      "SOLID a\nFACET normal facet endsolid solid OUTER loop vertex 0 0 0 vertex 1 0 0\nvertex 0 1 0 endloop endfacet\nENDSOLID\n";
  requireGroups(groupsOf("a.stl", text + solid("b", 1)), {"a", "b"}, {0, 1});
}

TEST_CASE("Groups of a file that is not a mesh", "[groups]") {
  for (const std::string content : {"", "solid a\nfacet normal 0 0", "solid a\nfacet", "solid a\nfoo\nsolid b\n", "what?"}) {
    CHECK_THROWS_AS(readGroupedMesh(content, "a"), FileError);
  }
  CHECK(readGroups(std::string("f 1 2\ng a\nf\nf 1 2 3\n"), "a.obj").names == Names{"a"});
  CHECK_THROWS_AS(readGroups(std::string("solid a\nfacet"), "a.stl"), FileError);
}

TEST_CASE("Files without groups: binary STL, PLY and OFF", "[groups]") {
  const Mesh mesh{{0, 0, 0, 1, 0, 0, 0, 1, 0}, {0, 1, 2}};
  for (const FileFormat format : {FileFormat::stl, FileFormat::ply, FileFormat::off}) {
    const std::string bytes = written([&](const Sink& sink) { writeMesh(sink, format, mesh); });
    requireGroups(groupsOf(std::string("a.") + name(format), bytes), {}, {});
  }
}

TEST_CASE("Meshes are written as OBJ with their groups", "[groups]") {
  const Mesh mesh{{0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0, 1}, {0, 1, 2, 0, 2, 3, 0, 3, 1, 1, 3, 2}};
  const TriangleGroups groups{{"a  b", "a_b", "#"}, {0, 1, 1, 0}};
  const std::string obj = written([&](const Sink& sink) { writeMesh(sink, FileFormat::obj, mesh, {}, &groups); });
  requireGroups(groupsOf("a.obj", obj), {"a_b_2", "a_b"}, {0, 1, 1, 0});
  const TemporaryFolder folder;
  writeMesh(folder.path("a.obj"), mesh, {}, &groups);
  CHECK(folder.read("a.obj") == obj);
  const auto plain = [&](FileFormat format) { return written([&](const Sink& sink) { writeMesh(sink, format, mesh); }); };
  const auto with = [&](FileFormat format, const TriangleGroups& some) {
    return written([&](const Sink& sink) { writeMesh(sink, format, mesh, {}, &some); });
  };
  CHECK(with(FileFormat::ply, groups) == plain(FileFormat::ply));
  CHECK(with(FileFormat::obj, {}) == plain(FileFormat::obj));
  CHECK(refusal([&] { with(FileFormat::obj, {{"a"}, {0, 0, 0}}); }).first == Status::badArgument);
  CHECK(refusal([&] { with(FileFormat::obj, {{"a"}, {0, 0, 0, 1}}); }).first == Status::badArgument);
}

TEST_CASE("Cut-meshes are written as JSON and PLY with the groups of triangles", "[groups]") {
  const GroupedMesh input = readGroupedMesh(kThree, "a.obj");
  const CutMesh cutMesh = cut(input.mesh, Grid::around(input.mesh, 2)).mesh;
  WriteOptions options;
  options.groups = &input.groups;
  const auto write = [&](FileFormat format) {
    return written([&](const Sink& sink) { writeCutMesh(sink, format, input.mesh, cutMesh, options); });
  };
  const std::string json = write(FileFormat::json), plainJson = written([&](const Sink&sink) { writeJson(sink, cutMesh); });
  const std::string more = ",\n\"groupNames\":[\"square\",\"\\\"a\\\\\",\"b\"],\n\"triangleGroup\":[0,0,1,2]";
  const size_t at = json.find(more);
  REQUIRE(at != std::string::npos);
  CHECK(json.substr(0, at) + json.substr(at + more.size()) == plainJson);

  const std::string ply = write(FileFormat::ply);
  REQUIRE(ply.find("property uint region\nproperty uint group\nend_header\n") != std::string::npos);
  const Mesh surface = readMesh(ply, "a.ply");
  constexpr size_t kBytesOfTriangle = 1 + 5 * sizeof(uint32_t);
  for (size_t t = 0; t < surface.triangleCount(); ++t) {
    uint32_t group;
    std::memcpy(&group, ply.data() + ply.size() - kBytesOfTriangle * (surface.triangleCount() - t) + kBytesOfTriangle - sizeof group,
                sizeof group);
    double z = 0, beyond = 0;  // of the square x - y is of both signs
    for (size_t i = 0; i < 3; ++i) {
      const double* corner = &surface.positions[3 * size_t(surface.triangles[3 * t + i])];
      z = corner[2];
      beyond += corner[0] - corner[1];
    }
    REQUIRE(group == (z < 0.5 ? 0u : beyond > 0 ? 1u : 2u));
  }
  options.groups = nullptr;
  CHECK(write(FileFormat::json) == plainJson);
  CHECK(write(FileFormat::ply).find("group") == std::string::npos);
}

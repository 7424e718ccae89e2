// Triangle meshes from files, with the groups of their triangles.
#pragma once

#include <optional>
#include <span>
#include <stdexcept>
#include <string>

#include "mandoline/mesh.h"

namespace MANDOLINE_API mandoline {

/// A file that can't be used; what() names the file and the line or element.
struct FileError : std::runtime_error {
  using std::runtime_error::runtime_error;
};

/// Reads OBJ, STL, PLY or OFF (STL and PLY in text or binary), by content and extension, each also gzipped. Polygons are fanned from
/// their first vertex; triangles are numbered in file order. Doubles are kept. Throws FileError.
Mesh readMesh(const std::string& path);
/// The same from the bytes of a file, gzipped or not. `name` stands for the path in messages, and its extension decides where the content
/// does not.
Mesh readMesh(std::span<const char> bytes, const std::string& name);
/// The same of files that are known as OBJ or STL by their content, and nothing of others: for programs that are to do without the rest of
/// the code.
std::optional<Mesh> readObjOrStl(std::span<const char> bytes, const std::string& name);

/// What files call groups, materials or solids: names for the triangles of a mesh. Cut-faces name their triangles, so that their groups
/// follow.
struct TriangleGroups {
  std::vector<std::string> names;       ///< per group, in the order of first triangles: each differs, and has a triangle
  std::vector<uint32_t> triangleGroup;  ///< per triangle: its group; empty if there are no groups

  bool empty() const { return names.empty(); }
  /// The group of a triangle, such as faceTriangle of a cut-mesh has; -1 for none.
  int32_t of(int64_t triangle) const { return triangle < 0 ? -1 : int32_t(triangleGroup[size_t(triangle)]); }

  static void fields(auto& self, const auto& f) {
    f("names", self.names);
    f("triangleGroup", self.triangleGroup);
  }
};
struct GroupedMesh {
  Mesh mesh;
  TriangleGroups groups;
};

/// The same with the groups of the triangles, if the file has any. Of OBJ: what `g` lines name, of several names on a line the first;
/// triangles before them are in the group "default"; where no triangle comes after a `g` line, what `usemtl` lines name. Of STL in text:
/// its solids; one of several that has no name is called solid0, by its place in the file. Names are UTF-8: one that is not is taken as
/// Latin-1.
GroupedMesh readGroupedMesh(const std::string& path);
GroupedMesh readGroupedMesh(std::span<const char> bytes, const std::string& name);
/// Only the groups, of a file that readMesh() takes.
TriangleGroups readGroups(std::span<const char> bytes, const std::string& name);

}  // namespace mandoline

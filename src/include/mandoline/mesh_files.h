// Triangle meshes from files.
#pragma once

#include <span>
#include <stdexcept>
#include <string>

#include "mandoline/mesh.h"

namespace mandoline {

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

}  // namespace mandoline

// Fuzzes the readers of mesh files (libFuzzer): any bytes give a mesh whose triangles name vertices that exist and whose groups each have
// a triangle, or a FileError that names the file.
#include <algorithm>
#include <cstdint>
#include <cstdlib>

#include "mandoline/io.h"

extern "C" int LLVMFuzzerTestOneInput(const uint8_t* data, size_t size) {
  static const std::string kNames[] = {"a.obj", "a.stl", "a.ply", "a.off", "a"};
  if (size == 0) return 0;
  const std::string& name = kNames[data[0] % std::size(kNames)];
  try {
    const auto [mesh, groups] = mandoline::readGroupedMesh({reinterpret_cast<const char*>(data) + 1, size - 1}, name);
    if (mesh.positions.size() % 3 != 0 || mesh.triangles.size() % 3 != 0) std::abort();
    for (const uint32_t v : mesh.triangles) {
      if (v >= mesh.vertexCount()) std::abort();
    }
    if (groups.triangleGroup.size() != (groups.empty() ? 0 : mesh.triangleCount())) std::abort();
    std::vector<bool> used(groups.names.size());
    for (const uint32_t group : groups.triangleGroup) used.at(group) = true;
    if (std::find(used.begin(), used.end(), false) != used.end()) std::abort();
  } catch (const mandoline::FileError& error) {
    if (std::string(error.what()).find(name + ": ") != 0) std::abort();
  }
  try {
    mandoline::readGroups({reinterpret_cast<const char*>(data) + 1, size - 1}, name);
  } catch (const mandoline::FileError&) {
  }
  return 0;
}

// Fuzzes the readers of mesh files from bytes (libFuzzer): whatever the bytes are, there is a mesh whose triangles name vertices that
// exist, or a FileError that names the file.
#include <cstdint>
#include <cstdlib>

#include "mandoline/io.h"

extern "C" int LLVMFuzzerTestOneInput(const uint8_t* data, size_t size) {
  static const std::string kNames[] = {"a.obj", "a.stl", "a.ply", "a.off", "a"};
  if (size == 0) return 0;
  const std::string& name = kNames[data[0] % std::size(kNames)];
  try {
    const mandoline::Mesh mesh = mandoline::readMesh({reinterpret_cast<const char*>(data) + 1, size - 1}, name);
    if (mesh.positions.size() % 3 != 0 || mesh.triangles.size() % 3 != 0) std::abort();
    for (const uint32_t v : mesh.triangles) {
      if (v >= mesh.vertexCount()) std::abort();
    }
  } catch (const mandoline::FileError& error) {
    if (std::string(error.what()).find(name + ": ") != 0) std::abort();
  }
  return 0;
}

#include <ostream>

#include "mandoline/io.h"

namespace mandoline {
namespace {

Sink into(std::ostream& out) {
  return [&out](std::string_view bytes) { out.write(bytes.data(), std::streamsize(bytes.size())); };
}

}  // namespace

void writeJson(std::ostream& out, const CutMesh& cutMesh, const RunOptions& options) { writeJson(into(out), cutMesh, options); }
void writeMcm(std::ostream& out, const CutMesh& cutMesh, const RunOptions& options) { writeMcm(into(out), cutMesh, options); }
void writeVtu(std::ostream& out, const MeshView& mesh, const CutMesh& cutMesh, const WriteOptions& options) {
  writeVtu(into(out), mesh, cutMesh, options);
}
void writeObj(std::ostream& out, const CutMesh& cutMesh, const WriteOptions& options) { writeObj(into(out), cutMesh, options); }

}  // namespace mandoline

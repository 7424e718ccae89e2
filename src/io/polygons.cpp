#include "io/polygons.h"

#include <algorithm>

namespace mandoline::detail {

Polygons::Polygons(const CutMesh& cutMesh) : cutMesh_(cutMesh), split_(cutMesh.faceCount()) {
  constexpr uint32_t kNone = ~0u;
  std::vector<uint32_t> lastFace(cutMesh.vertexCount(), kNone);  // per vertex: the face that it was last seen in
  for (uint32_t f = 0; f < cutMesh.faceCount(); ++f) {
    const uint32_t begin = cutMesh.faceLoopOffsets[f], end = cutMesh.faceLoopOffsets[f + 1];
    split_[f] = end - begin != 1;
    for (uint32_t v : cutMesh.loop(begin)) {
      if (lastFace[v] == f) split_[f] = true;
      lastFace[v] = f;
    }
  }
  if (std::find(split_.begin(), split_.end(), 1) != split_.end()) triangles_ = triangulateFaces(cutMesh);
}

}  // namespace mandoline::detail

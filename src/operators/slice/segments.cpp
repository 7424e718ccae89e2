#include "operators/slice/segments.h"

#include "base/csr.h"
#include "operators/triangulate/face_triangulator.h"

namespace mandoline::operators {
namespace {

class Maker {
 public:
  Maker(const CutMesh& cutMesh, const ScaledSpace& space, const CuttingPlane& plane)
      : cutMesh_(cutMesh), triangulator_(cutMesh), above_(cutMesh.vertexCount()) {
    for (size_t v = 0; v < above_.size(); ++v) above_[v] = plane.isAbove(space.scaled(&cutMesh.positions[3 * v]));
  }

  SliceSegments run() {
    result_.faceOffsets.push_back(0);
    for (size_t f = 0; f < cutMesh_.faceCount(); ++f) {
      if (isCut(f)) addFace(f);
      result_.faceOffsets.push_back(uint32_t(result_.segments.size()));
    }
    numberPoints();
    return std::move(result_);
  }

 private:
  bool isCut(size_t face) const {
    const uint32_t begin = cutMesh_.loopOffsets[cutMesh_.faceLoopOffsets[face]],
                   end = cutMesh_.loopOffsets[cutMesh_.faceLoopOffsets[face + 1]];
    for (uint32_t i = begin; i < end; ++i) {
      if (above_[cutMesh_.loopVertices[i]] != above_[cutMesh_.loopVertices[begin]]) return true;
    }
    return false;
  }

  void addFace(size_t face) {
    triangles_.clear();
    triangulator_.run(face, triangles_);
    for (size_t t = 0; t < triangles_.size(); t += 3) addTriangle(&triangles_[t]);
  }

  void addTriangle(const uint32_t* v) {
    const uint32_t id = uint32_t(result_.segments.size());
    for (int i = 0; i < 3; ++i) {
      const uint32_t a = v[i], b = v[(i + 1) % 3];
      if (above_[a] == above_[b]) continue;
      ends_.push_back({uint64_t(std::min(a, b)) * above_.size() + std::max(a, b), 2 * id + (above_[a] ? 0 : 1)});
    }
    if (!ends_.empty() && ends_.back().item / 2 == id) result_.segments.emplace_back();
  }

  /// One point per edge, in the order of the edges' vertices.
  void numberPoints() {
    detail::sortByKey(ends_, uint64_t(above_.size()) * above_.size());
    for (size_t i = 0; i < ends_.size(); ++i) {
      if (i == 0 || ends_[i].key != ends_[i - 1].key) {
        result_.pointEdges.push_back({uint32_t(ends_[i].key / above_.size()), uint32_t(ends_[i].key % above_.size())});
      }
      result_.segments[ends_[i].item / 2][ends_[i].item % 2] = uint32_t(result_.pointEdges.size() - 1);
    }
  }

  const CutMesh& cutMesh_;
  FaceTriangulator triangulator_;
  std::vector<uint8_t> above_;  // per vertex
  std::vector<uint32_t> triangles_;
  std::vector<detail::KeyedItem> ends_;  // of segments (2 * segment + end), by edge
  SliceSegments result_;
};

}  // namespace

SliceSegments makeSliceSegments(const CutMesh& cutMesh, const ScaledSpace& space, const CuttingPlane& plane) {
  return Maker(cutMesh, space, plane).run();
}

}  // namespace mandoline::operators

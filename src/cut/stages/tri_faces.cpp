#include "cut/stages/tri_faces.h"

namespace mandoline::detail {

void TriFaces::endFace(TriangleId triangle, const Slab& element, bool touches) {
  triangles.push_back(triangle);
  elements.push_back(element);
  touchesLine.push_back(touches);
  if (!faceLoopOffsets.empty()) faceLoopOffsets.push_back(uint32_t(loops.size()));
}

void TriFaces::append(const TriFaces& others, FaceId face) {
  for (uint32_t l = uint32_t(faceLoopOffsets.size()); l <= size(); ++l) faceLoopOffsets.push_back(l);  // one loop each so far
  for (const auto loop : others.loopsOf(face)) {
    loops.items.insert(loops.items.end(), loop.begin(), loop.end());
    loops.endGroup();
  }
  auto other = std::lower_bound(others.otherParents.begin(), others.otherParents.end(), face,
                                [](const OtherParent& o, FaceId at) { return o.face < at; });
  for (; other != others.otherParents.end() && other->face == face; ++other) {
    otherParents.push_back({{uint32_t(size())}, other->triangle, other->sameWay});
  }
  endFace(others.triangles[face], others.elements[face], others.touchesLine[face] != 0);
}

TriFaceWriter::TriFaceWriter(TriFaces& out, size_t faces) : out_(out) {
  out.faceLoopOffsets.clear();
  out.hybridEdges.clear();
  out.otherParents.clear();
  lengthen(faces, kBlock * faces + faces / 2);
}

void TriFaceWriter::end() { resize(face_, item_); }

void TriFaceWriter::grow(size_t vertices) {
  constexpr size_t kFew = 64;
  lengthen(2 * face_ + kFew, 2 * (item_ + vertices) + kBlock * kFew);
}

void TriFaceWriter::lengthen(size_t faces, size_t items) { resize(std::max(out_.size(), faces), std::max(out_.loops.items.size(), items)); }

void TriFaceWriter::resize(size_t faces, size_t items) {
  out_.loops.items.resize(items);
  out_.loops.offsets.resize(faces + 1);
  out_.triangles.resize(faces);
  out_.elements.resize(faces);
  out_.touchesLine.resize(faces);
}

}  // namespace mandoline::detail

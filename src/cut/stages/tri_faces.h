// Tri-cut-faces (paper, 4.2): the pieces of triangles, each in one grid cell, or in one grid-face if the triangle lies in an axial plane.
// Each loop runs counter-clockwise about its triangle's normal and holds all vertices that lie on it.
#pragma once

#include <vector>

#include "cut/stages/tri_edges.h"

namespace mandoline::detail {

/// Another triangle that a tri-cut-face is a piece of, in the same plane.
struct OtherParent {
  FaceId face;
  TriangleId triangle;
  bool sameWay;  ///< whether its normal is the face's
};

struct TriFaces {
  Csr<VertexId> loops;
  std::vector<uint32_t> faceLoopOffsets;   ///< per face its loops, the outer one first; empty if every face has one
  IdVector<FaceId, TriangleId> triangles;  ///< that it is a piece of
  IdVector<FaceId, Slab> elements;         ///< the grid cell, or the grid-face, whose even entry is then its plane
  IdVector<FaceId, uint8_t> touchesLine;   ///< whether a vertex of it lies on a grid line
  std::vector<FaceEdge> hybridEdges;       ///< cut hybrid edges that lie in a grid-face (not on a grid line)
  std::vector<OtherParent> otherParents;   ///< of faces of several triangles, ascending by face

  size_t size() const { return triangles.size(); }
  Ids<FaceId> ids() const { return triangles.ids(); }
  uint32_t firstLoop(FaceId f) const { return faceLoopOffsets.empty() ? f.number : faceLoopOffsets[f.number]; }
  Groups<VertexId> loopsOf(FaceId f) const { return loops.groups(firstLoop(f), firstLoop({f.number + 1})); }
  /// Ends a face, whose loops have been appended.
  void endFace(TriangleId triangle, const Slab& element, bool touches);
  /// Appends a face of others; vertices keep their ids.
  void append(const TriFaces& others, FaceId face);
};

/// Writes faces of one loop each over others, whose memory is used again. Until end(), arrays are longer than what has been written.
class TriFaceWriter {
 public:
  static constexpr size_t kBlock = 4;

  /// `faces`: about how many.
  TriFaceWriter(TriFaces& out, size_t faces);

  /// Where to write the loop of the next face, and kBlock more ids.
  VertexId* makeLoop(size_t vertices) {
    if (face_ == out_.size() || item_ + vertices + kBlock > out_.loops.items.size()) grow(vertices);
    return out_.loops.items.data() + item_;
  }
  FaceId endFace(size_t vertices, TriangleId triangle, const Slab& element, bool touchesLine) {
    out_.triangles.data()[face_] = triangle;
    out_.elements.data()[face_] = element;
    out_.touchesLine.data()[face_] = touchesLine;
    item_ += vertices;
    out_.loops.offsets[++face_] = uint32_t(item_);
    return {uint32_t(face_ - 1)};
  }
  void end();

 private:
  void grow(size_t vertices);
  void lengthen(size_t faces, size_t items);
  void resize(size_t faces, size_t items);

  TriFaces& out_;
  size_t face_ = 0, item_ = 0;  // the next ones
};

/// Faces of triangles whose inside others reach into, not yet divided by those: see divideFaces().
struct UndividedFaces : TriFaces {
  std::vector<TriangleId> hybridTriangles;  ///< per hybrid edge
};

}  // namespace mandoline::detail

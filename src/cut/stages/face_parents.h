// All triangles that a tri-cut-face is a piece of.
#pragma once

#include "cut/stages/tri_faces.h"

namespace mandoline::detail {

class FaceParents {
 public:
  FaceParents(const Input& input, const TriFaces& faces) : input_(input), faces_(faces) {}

  /// Calls f(triangle, whether its normal is the face's): for the one that has the face, then for others in no order.
  template <class F>
  void forEach(FaceId face, const F& f) const {
    const TriangleId triangle = faces_.triangles[face];
    f(triangle, true);
    forDuplicates(triangle, true, f);
    const auto& others = faces_.otherParents;
    if (others.empty()) return;
    auto other = std::lower_bound(others.begin(), others.end(), face, [](const OtherParent& o, FaceId at) { return o.face < at; });
    for (; other != others.end() && other->face == face; ++other) {
      f(other->triangle, other->sameWay);
      forDuplicates(other->triangle, other->sameWay, f);
    }
  }

 private:
  template <class F>
  void forDuplicates(TriangleId original, bool sameWay, const F& f) const {
    for (const Duplicate& d : input_.mesh->duplicatesOf(original)) f(TriangleId{d.triangle}, d.sameWay == sameWay);
  }

  const Input& input_;
  const TriFaces& faces_;
};

}  // namespace mandoline::detail

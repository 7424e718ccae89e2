// All triangles that a tri-cut-face is a piece of.
#pragma once

#include "cut/stages/tri_faces.h"

namespace mandoline::detail {

class FaceParents {
 public:
  FaceParents(const Input& input, const TriFaces& faces) : input_(input), faces_(faces) {}

  /// Calls f(triangle, whether its normal is the face's): for the one that has the face, then for others in no order. Quickest for
  /// ascending faces.
  template <class F>
  void forEach(FaceId face, const F& f) {
    const TriangleId triangle = faces_.triangles[face];
    f(triangle, true);
    forDuplicates(triangle, true, f);
    const auto& others = faces_.otherParents;
    if (others.empty()) return;
    if (at_ > 0 && others[at_ - 1].face >= face) at_ = 0;
    while (at_ < others.size() && others[at_].face < face) ++at_;
    for (; at_ < others.size() && others[at_].face == face; ++at_) {
      f(others[at_].triangle, others[at_].sameWay);
      forDuplicates(others[at_].triangle, others[at_].sameWay, f);
    }
  }

 private:
  template <class F>
  void forDuplicates(TriangleId original, bool sameWay, const F& f) const {
    for (const Duplicate& d : input_.mesh->duplicatesOf(original)) f(TriangleId{d.triangle}, d.sameWay == sameWay);
  }

  const Input& input_;
  const TriFaces& faces_;
  size_t at_ = 0;  // in otherParents
};

}  // namespace mandoline::detail

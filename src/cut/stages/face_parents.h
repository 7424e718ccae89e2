// All triangles that a tri-cut-face is a piece of.
#pragma once

#include "cut/stages/tri_faces.h"

namespace mandoline::detail {

class FaceParents {
 public:
  /// `triangles`, `others`: as of TriFaces.
  FaceParents(const Input& input, std::span<const TriangleId> triangles, std::span<const OtherParent> others)
      : input_(input), triangles_(triangles), others_(others) {}

  /// Whether each face has one.
  bool areSingle() const { return others_.empty() && input_.mesh->duplicates.empty(); }

  /// Calls f(triangle, whether its normal is the face's): for the one that has the face, then for others in no order.
  template <class F>
  void forEach(FaceId face, const F& f) const {
    const TriangleId triangle = triangles_[face.number];
    f(triangle, true);
    forDuplicates(triangle, true, f);
    if (others_.empty()) return;
    auto other = std::lower_bound(others_.begin(), others_.end(), face, [](const OtherParent& o, FaceId at) { return o.face < at; });
    for (; other != others_.end() && other->face == face; ++other) {
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
  const std::span<const TriangleId> triangles_;
  const std::span<const OtherParent> others_;
};

}  // namespace mandoline::detail

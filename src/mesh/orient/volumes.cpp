#include "mesh/orient/volumes.h"

#include <optional>

namespace mandoline::detail {
namespace {

/// Sums over triangles, relative to an origin: six times the volume of the cones to it, and twice the area vector. Closed to another point,
/// the volume is less by the product of the area vector and the way there.
template <class Number>
struct Sums {
  Number volume;
  std::array<Number, 3> area;
};

template <class Number>
using Vector = std::array<Number, 3>;

template <class Number>
Vector<Number> difference(const Point& a, const Point& b) {
  return {Number::difference(a[0], b[0]), Number::difference(a[1], b[1]), Number::difference(a[2], b[2])};
}

template <class Number>
Vector<Number> cross(const Vector<Number>& a, const Vector<Number>& b) {
  return {a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]};
}

template <class Number>
Number dot(const Vector<Number>& a, const Vector<Number>& b) {
  return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}

/// One patch.
class Volume {
 public:
  Volume(const WeldedMesh& mesh, const Patches& patches, std::span<const uint32_t> triangles)
      : mesh_(mesh), patches_(patches), triangles_(triangles), origin_(corner(triangles[0], 0)), box_{origin_, origin_} {
    for (const uint32_t t : triangles) {
      for (size_t i = 0; i < 3; ++i) {
        const Point& p = corner(t, i);
        for (size_t d = 0; d < 3; ++d) {
          box_[0][d] = std::min(box_[0][d], p[d]);
          box_[1][d] = std::max(box_[1][d], p[d]);
        }
      }
    }
    bounded_ = sums<Bounded>();
  }

  /// The volume is linear in the point that holes are closed to, so its extremes over the box are at corners. Those that doubles can't
  /// decide come last: they are seldom needed.
  int sign(Predicates& predicates) {
    bool above = false, below = false;
    std::array<bool, 8> isKnown;
    for (size_t c = 0; c < 8; ++c) {
      const Bounded volume = closedTo(boxCorner(c), *bounded_);
      isKnown[c] = volume.certain();
      if (!isKnown[c]) continue;
      above |= volume.sign() >= 0;
      below |= volume.sign() <= 0;
    }
    for (size_t c = 0; c < 8 && !(above && below); ++c) {
      if (isKnown[c]) continue;
      if (!exact_) exact_ = sums<Big>();
      ++predicates.fallbacks;
      const int sign = closedTo(boxCorner(c), *exact_).sign();
      above |= sign >= 0;
      below |= sign <= 0;
    }
    return int(above) - int(below);
  }

 private:
  const Point& corner(uint32_t triangle, size_t i) const { return mesh_.points[mesh_.triangles[triangle][i]]; }
  Point boxCorner(size_t c) const { return {box_[c & 1][0], box_[c >> 1 & 1][1], box_[c >> 2][2]}; }

  template <class Number>
  Sums<Number> sums() const {
    Sums<Number> sums;
    for (const uint32_t t : triangles_) {
      const bool turned = patches_.turned[t] != 0;
      const Point &p = corner(t, 0), &q = corner(t, turned ? 2 : 1), &r = corner(t, turned ? 1 : 2);
      const Vector<Number> normal = cross(difference<Number>(q, p), difference<Number>(r, p));
      sums.volume = sums.volume + dot(difference<Number>(p, origin_), normal);
      for (size_t d = 0; d < 3; ++d) sums.area[d] = sums.area[d] + normal[d];
    }
    return sums;
  }
  template <class Number>
  Number closedTo(const Point& point, const Sums<Number>& sums) const {
    return sums.volume - dot(difference<Number>(point, origin_), sums.area);
  }

  const WeldedMesh& mesh_;
  const Patches& patches_;
  std::span<const uint32_t> triangles_;
  Point origin_;
  std::array<Point, 2> box_;
  std::optional<Sums<Bounded>> bounded_;
  std::optional<Sums<Big>> exact_;
};

}  // namespace

std::vector<int> volumeSigns(const WeldedMesh& mesh, const Patches& patches, Predicates& predicates) {
  const Csr<uint32_t> triangles = trianglesOf(patches);
  std::vector<int> signs;
  for (size_t p = 0; p < patches.count(); ++p) {
    signs.push_back(patches.orientable[p] ? Volume(mesh, patches, triangles[p]).sign(predicates) : 0);
  }
  return signs;
}

}  // namespace mandoline::detail

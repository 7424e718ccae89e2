// What two triangles have in common, exactly: the points that bound it, each named by the input vertices, edges and triangles that meet
// there. All answers are signs of polynomials of the input's doubles: nothing is constructed, nothing rounded.
#pragma once

#include <array>
#include <span>

#include "mesh/welded_mesh.h"

namespace mandoline::detail {

/// Where in a triangle: 0-2 at a corner, 3-5 inside the side (i, i + 1), 6 inside.
struct Place {
  uint8_t code = 6;

  static Place corner(int i) { return {uint8_t(i)}; }
  static Place side(int i) { return {uint8_t(3 + i)}; }
  bool isCorner() const { return code < 3; }
  bool isSide() const { return code >= 3 && code < 6; }
  bool isInside() const { return code == 6; }
  int index() const { return code < 3 ? code : code - 3; }
  /// Whether it lies on a side or at one of its ends.
  bool onSide(int i) const { return isCorner() ? code == i || code == (i + 1) % 3 : code == 3 + i; }
};

/// A point by what meets there. Edges are named by their ends, the lower tri-vertex first.
struct PointKey {
  enum class Kind : uint8_t {
    vertex,        ///< tri-vertex ids[0]
    edgeTriangle,  ///< edge (ids[0], ids[1]), triangle ids[2]
    edgeEdge,      ///< edges (ids[0], ids[1]) and (ids[2], ids[3]), ascending
    triangles      ///< triangles ids[0] < ids[1] < ids[2]
  };
  Kind kind = Kind::vertex;
  std::array<uint32_t, 4> ids{};

  using Edge = std::array<uint32_t, 2>;
  static PointKey vertex(uint32_t v) { return {Kind::vertex, {v}}; }
  static PointKey edgeTriangle(const Edge& e, uint32_t t) { return {Kind::edgeTriangle, {e[0], e[1], t}}; }
  static PointKey edgeEdge(const Edge& e, const Edge& f);
  static PointKey ofTriangles(uint32_t r, uint32_t s, uint32_t t);
  bool operator==(const PointKey&) const = default;
  bool operator<(const PointKey& other) const { return kind != other.kind ? kind < other.kind : ids < other.ids; }
};

/// What two triangles have in common, as the corners of a convex set: a point, a segment, or in one plane a polygon.
struct Contact {
  struct Corner {
    PointKey key;
    std::array<Place, 2> places;  ///< in the first triangle and in the second
  };
  std::array<Corner, 6> corners;
  int count = 0;
  bool coplanar = false;

  /// Whether it is a polygon.
  bool hasArea() const { return count > 2; }
  /// The side of triangle `which` (0 or 1) that all of a contact without area lies along, or -1.
  int alongSide(int which) const;
};

/// Tests pairs of triangles with area of one mesh, which are not the same three corners. One per thread.
class ContactFinder {
 public:
  explicit ContactFinder(const WeldedMesh& mesh) : mesh_(mesh) {}

  /// Whether two triangles have more in common than shared corners and whole shared sides; if so, what. `found` is only then set.
  bool find(uint32_t s, uint32_t t, Contact& found);

  Predicates predicates;

 private:
  using Corners = std::array<uint32_t, 3>;

  struct Side {
    int signs[3];  // of one triangle's corners against the other's plane
  };
  void findShared();
  bool sidesOf(int which, Side& side);
  void addCrossings(int which, const Side& side);
  void addCoplanar();
  void addCorners(int which);
  void add(const PointKey& key, int which, Place mine, Place others);
  bool locate(const Corners& t, uint32_t v, Place& place);
  bool locateCrossing(uint32_t p, uint32_t q, const Corners& t, Place& place);
  PointKey keyOf(const PointKey::Edge& edge, int other, Place place) const;
  PointKey::Edge edgeOf(int which, int side) const { return mesh_.edgeOf(ids_[size_t(which)], side); }
  int orient(uint32_t a, uint32_t b, uint32_t c, uint32_t d);
  int orient(uint32_t a, uint32_t b, uint32_t c, int axis);
  int axisAcross(const Corners& t);

  const WeldedMesh& mesh_;
  std::array<uint32_t, 2> ids_{};
  std::array<Corners, 2> corners_{};
  std::array<std::array<int8_t, 3>, 2> shared_{};  // per corner: the other triangle's corner there, or -1
  int sharedCount_ = 0;
  Contact contact_;
};

}  // namespace mandoline::detail

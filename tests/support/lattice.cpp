#include "lattice.h"

#include <algorithm>
#include <sstream>

#include "mandoline/inside.h"
#include "mandoline/inspect.h"
#include "mandoline/orient.h"
#include "mandoline/resolve.h"
#include "mandoline/validate.h"
#include "shapes.h"
#include "vectors.h"

using namespace mandoline;
using namespace vectors;

namespace {

using Point = LatticeCase::Point;
using Triangle = std::array<Point, 3>;

// ------------------------------------------------------------------------------------- exact intersection of integer triangles

int sign(int64_t x) { return (x > 0) - (x < 0); }

Point normal(const Triangle& t) { return cross(t[1] - t[0], t[2] - t[0]); }
bool hasArea(const Triangle& t) { return normal(t) != Point{0, 0, 0}; }
int orient(const Point& a, const Point& b, const Point& c, const Point& d) { return sign(dot(cross(b - a, c - a), d - a)); }
/// Side of p to the line ab in the plane with normal n.
int side(const Point& a, const Point& b, const Point& p, const Point& n) { return sign(dot(cross(b - a, p - a), n)); }

bool inTriangle(const Point& p, const Triangle& t, const Point& n) {
  return side(t[0], t[1], p, n) >= 0 && side(t[1], t[2], p, n) >= 0 && side(t[2], t[0], p, n) >= 0;
}

/// Closed segments in one plane.
bool segmentsMeet(const Point& p, const Point& q, const Point& a, const Point& b, const Point& n) {
  const int pa = side(a, b, p, n), qa = side(a, b, q, n), ap = side(p, q, a, n), bp = side(p, q, b, n);
  if (pa || qa || ap || bp) return pa * qa <= 0 && ap * bp <= 0;
  for (int d = 0; d < 3; ++d)  // on one line
    if (std::max(p[d], q[d]) < std::min(a[d], b[d]) || std::max(a[d], b[d]) < std::min(p[d], q[d])) return false;
  return true;
}

/// A closed segment and a closed triangle with area.
bool segmentMeets(const Point& p, const Point& q, const Triangle& t) {
  const int sp = orient(t[0], t[1], t[2], p), sq = orient(t[0], t[1], t[2], q);
  if (sp * sq > 0) return false;
  if (sp == 0 && sq == 0) {
    const Point n = normal(t);
    bool meets = inTriangle(p, t, n) || inTriangle(q, t, n);
    for (int k = 0; k < 3; ++k) meets = meets || segmentsMeet(p, q, t[k], t[(k + 1) % 3], n);
    return meets;
  }
  const int s0 = orient(p, q, t[0], t[1]), s1 = orient(p, q, t[1], t[2]), s2 = orient(p, q, t[2], t[0]);
  return (s0 >= 0 && s1 >= 0 && s2 >= 0) || (s0 <= 0 && s1 <= 0 && s2 <= 0);
}

/// Whether two triangles with area meet other than in common vertices or a common edge. The same triangle twice does not count.
bool intersect(const Triangle& a, const Triangle& b) {
  std::vector<int> sharedA, sharedB;
  for (int i = 0; i < 3; ++i)
    for (int j = 0; j < 3; ++j)
      if (a[i] == b[j]) sharedA.push_back(i), sharedB.push_back(j);
  if (sharedA.size() == 3) return false;
  if (sharedA.size() == 2) {
    const Point &u = a[sharedA[0]], &v = a[sharedA[1]], &p = a[3 - sharedA[0] - sharedA[1]], &q = b[3 - sharedB[0] - sharedB[1]];
    const Point n = normal(a);
    return dot(n, q - u) == 0 && side(u, v, p, n) == side(u, v, q, n);
  }
  if (sharedA.size() == 1) {  // from the common vertex one leaves what the triangles have in common through an opposite side
    const int i = sharedA[0], j = sharedB[0];
    return segmentMeets(a[(i + 1) % 3], a[(i + 2) % 3], b) || segmentMeets(b[(j + 1) % 3], b[(j + 2) % 3], a);
  }
  for (int k = 0; k < 3; ++k)
    if (segmentMeets(a[k], a[(k + 1) % 3], b) || segmentMeets(b[k], b[(k + 1) % 3], a)) return true;
  return false;
}

bool anyIntersect(const std::vector<Triangle>& as, const std::vector<Triangle>& bs) {
  for (const Triangle& a : as)
    for (const Triangle& b : bs)
      if (hasArea(a) && hasArea(b) && intersect(a, b)) return true;
  return false;
}

// ------------------------------------------------------------------------------------- from bytes to a case

class Bytes {
 public:
  Bytes(const uint8_t* bytes, size_t size) : next_(bytes), end_(bytes + size) {}
  bool any() const { return next_ != end_; }
  int64_t below(int64_t n) { return any() ? *next_++ % n : 0; }
  Point point() {
    const int64_t x = below(10), y = below(10), z = below(10);
    return {x, y, z};
  }

 private:
  const uint8_t *next_, *end_;
};

void addQuad(std::vector<Triangle>& shape, const Point& a, const Point& b, const Point& c, const Point& d) {
  shape.push_back({a, b, c});
  shape.push_back({a, c, d});
}

std::vector<Triangle> boxShape(Point lo, Point hi) {
  for (int d = 0; d < 3; ++d)
    if (lo[d] > hi[d]) std::swap(lo[d], hi[d]);
  const auto corner = [&](int bits) { return Point{bits & 1 ? hi[0] : lo[0], bits & 2 ? hi[1] : lo[1], bits & 4 ? hi[2] : lo[2]}; };
  static const int sides[6][4] = {{0, 4, 6, 2}, {1, 3, 7, 5}, {0, 1, 5, 4}, {2, 6, 7, 3}, {0, 2, 3, 1}, {4, 5, 7, 6}};
  std::vector<Triangle> shape;
  for (const auto& s : sides) addQuad(shape, corner(s[0]), corner(s[1]), corner(s[2]), corner(s[3]));
  return shape;
}

std::vector<Triangle> octahedronShape(const Point& centre, int64_t radius) {
  std::vector<Triangle> shape;
  for (int octant = 0; octant < 8; ++octant) {
    Triangle t = {centre, centre, centre};
    int negative = 0;
    for (int d = 0; d < 3; ++d) {
      const bool down = octant >> d & 1;
      t[d][d] += down ? -radius : radius;
      negative += down;
    }
    if (negative % 2) std::swap(t[1], t[2]);
    shape.push_back(t);
  }
  return shape;
}

std::vector<Triangle> sheetShape(Bytes& bytes) {
  const int64_t nx = 1 + bytes.below(3), ny = 1 + bytes.below(3), step = 1 + bytes.below(3), axis = bytes.below(3);
  const Point corner = bytes.point();
  const auto at = [&](int64_t i, int64_t j, int64_t height) {
    Point p;
    p[axis] = height, p[(axis + 1) % 3] = corner[0] + step * i, p[(axis + 2) % 3] = corner[1] + step * j;
    return p;
  };
  std::vector<Point> points;
  const bool flat = bytes.below(2);
  for (int64_t j = 0; j <= ny; ++j)
    for (int64_t i = 0; i <= nx; ++i) points.push_back(at(i, j, flat ? corner[2] : bytes.below(10)));
  std::vector<Triangle> shape;
  for (int64_t j = 0; j < ny; ++j)
    for (int64_t i = 0; i < nx; ++i) {
      const Point* p = &points[j * (nx + 1) + i];
      addQuad(shape, p[0], p[1], p[nx + 2], p[nx + 1]);
    }
  return shape;
}

std::vector<Triangle> prismShape(const Point& a, const Point& b, const Point& c, const Point& by) {
  const auto moved = [&](const Point& p) { return Point{p[0] + by[0], p[1] + by[1], p[2] + by[2]}; };
  std::vector<Triangle> shape = {{a, c, b}, {moved(a), moved(b), moved(c)}};
  addQuad(shape, a, b, moved(b), moved(a));
  addQuad(shape, b, c, moved(c), moved(b));
  addQuad(shape, c, a, moved(a), moved(c));
  return shape;
}

std::vector<Triangle> nextShape(Bytes& bytes, const std::vector<Triangle>& before, bool allowIntersections) {
  const Triangle last = before.empty() ? Triangle{} : before[size_t(bytes.below(int64_t(before.size())))];
  switch (bytes.below(allowIntersections ? 11 : 8)) {
    case 0: {
      const Point lo = bytes.point(), hi = bytes.point();
      return boxShape(lo, hi);
    }
    case 1: {
      const Point centre = bytes.point();
      return octahedronShape(centre, 1 + bytes.below(4));
    }
    case 2:
      return sheetShape(bytes);
    case 3: {
      const Point a = bytes.point(), b = bytes.point(), c = bytes.point();
      Point by = {0, 0, 0};
      by[bytes.below(3)] = 1 + bytes.below(5);
      return prismShape(a, b, c, by);
    }
    case 4: {
      const Point a = bytes.point(), b = bytes.point(), c = bytes.point(), d = bytes.point();
      return {{a, c, b}, {a, b, d}, {b, c, d}, {c, a, d}};
    }
    case 5: {  // grows the mesh at an edge or a vertex
      const int64_t k = bytes.below(3);
      return {{last[(k + 1) % 3], last[k], bytes.point()}};
    }
    case 6: {
      const Point a = bytes.point(), b = bytes.point();
      return {{last[size_t(bytes.below(3))], a, b}};
    }
    case 8:  // copies
      return {{last[1], last[2], last[0]}};
    case 9:
      return {{last[1], last[0], last[2]}, {last[2], last[1], last[0]}};
    case 10: {  // in one plane, with a common edge line
      const Point a = last[0], b = last[1], c = last[2];
      return {{a, c, a + b - c}};
    }
    default: {
      const Point a = bytes.point(), b = bytes.point(), c = bytes.point();
      return {{a, b, c}};
    }
  }
}

/// Planes at lattice points, between them, or at tenths of what the coordinates are scaled to.
std::vector<double> planesFrom(Bytes& bytes) {
  std::vector<double> planes;
  if (bytes.below(2)) {  // graded: any of the lattice's planes
    const int64_t low = bytes.below(256), bits = low | bytes.below(4) << 8;
    for (int k = 0; k < 10; ++k)
      if (bits >> k & 1) planes.push_back(k);
    if (planes.size() >= 2) return planes;
    planes.clear();
  }
  const double first = double(bytes.below(8)) / 2 - 1.5, spacing = double(1 + bytes.below(8)) / 2;
  const int64_t cells = 1 + bytes.below(10);
  for (int64_t c = 0; c <= cells; ++c) planes.push_back(first + spacing * double(c));
  return planes;
}

}  // namespace

LatticeCase decodeLattice(const uint8_t* data, size_t size) {
  Bytes bytes(data, size);
  LatticeCase result;
  std::array<std::vector<double>, 3> planes;
  for (auto& axis : planes) axis = planesFrom(bytes);
  // Tenths are no doubles: lattice coincidences turn into misses by a rounding, yet what did not meet still does not.
  const bool tenths = bytes.below(4) == 0, allowIntersections = bytes.below(8) == 0, allowZeroArea = !tenths && bytes.below(4) == 0;
  while (bytes.any() && result.triangles.size() < 60) {
    std::vector<Triangle> shape = nextShape(bytes, result.triangles, allowIntersections);
    if (bytes.below(4) == 0)
      for (Triangle& t : shape) std::swap(t[0], t[1]);
    if (!allowZeroArea) shape.erase(std::remove_if(shape.begin(), shape.end(), [](const Triangle& t) { return !hasArea(t); }), shape.end());
    const bool intersects = anyIntersect(shape, result.triangles) || anyIntersect(shape, shape);
    if (intersects && !allowIntersections) continue;
    result.intersects = result.intersects || intersects;
    result.triangles.insert(result.triangles.end(), shape.begin(), shape.end());
  }
  const auto place = [&](double x) { return tenths ? x * 0.1 : x; };
  for (auto& axis : planes)
    for (double& x : axis) x = place(x);
  result.grid = Grid::rectilinear(planes);
  for (const Triangle& t : result.triangles)
    for (const Point& p : t) {
      result.mesh.triangles.push_back(uint32_t(result.mesh.vertexCount()));
      for (int64_t x : p) result.mesh.positions.push_back(place(double(x)));
    }
  return result;
}

static std::string describe(const LatticeCase& latticeCase) {
  std::ostringstream text;
  text.precision(17);
  text << (latticeCase.intersects ? "# intersects itself\n" : "# does not intersect itself\n");
  for (const auto& planes : latticeCase.grid.planes) {
    text << "# planes";
    for (double x : planes) text << ' ' << x;
    text << '\n';
  }
  const Mesh& mesh = latticeCase.mesh;
  for (size_t v = 0; v < mesh.vertexCount(); ++v)
    text << "v " << mesh.positions[3 * v] << ' ' << mesh.positions[3 * v + 1] << ' ' << mesh.positions[3 * v + 2] << '\n';
  for (size_t t = 0; t < mesh.triangleCount(); ++t) text << "f " << 3 * t + 1 << ' ' << 3 * t + 2 << ' ' << 3 * t + 3 << '\n';
  return text.str();
}

static std::string failures(const Validation& validation) {
  std::string text;
  for (const Check& check : validation.checks)
    if (!check.pass) text += " " + check.name + " (" + check.elementKind + " " + std::to_string(check.element) + ": " + check.message + ")";
  return text;
}

/// Of what is told about inside and outside.
static std::string brokenInside(const Mesh& mesh, const CutMesh& cutMesh) {
  const CutMesh estimated = estimateInside(mesh, cutMesh);
  const Validation validation = validate(mesh, estimated);
  if (!validation.pass) return "with estimates, validation fails:" + failures(validation);
  if (!insideRegions(estimated).isComplete) return "estimates leave parts out";
  if (shapes::openEdges(boundary(estimated)) > 0) return "the boundary of what is inside is open";
  return "";
}

static std::string brokenOrientation(const Mesh& mesh) {
  const OrientedMesh oriented = orient(mesh);
  if (!orient(oriented.mesh).turnedTriangles.empty()) return "to orient a mesh again turns triangles again";
  const MeshInfo before = inspect(mesh), after = inspect(oriented.mesh);
  if (before.openEdges != after.openEdges || before.nonManifoldEdges != after.nonManifoldEdges)
    return "an oriented mesh has other open or non-manifold edges";
  const auto orientable = [](Facing facing) { return facing != Facing::nonOrientable; };
  if (std::all_of(oriented.patchFacing.begin(), oriented.patchFacing.end(), orientable) && after.inconsistentEdges > 0)
    return "an oriented mesh has inconsistent edges";
  return "";
}

std::string brokenPromise(const LatticeCase& latticeCase) {
  const Mesh& mesh = latticeCase.mesh;
  const CutResult result = cut(mesh, latticeCase.grid);
  const auto broken = [&](const std::string& what) { return what.empty() ? what : what + '\n' + describe(latticeCase); };
  if (latticeCase.triangles.empty())
    return result.error.status == Status::emptyMesh ? "" : broken("an empty mesh is called " + std::string(name(result.error.status)));
  if (!result) return broken(std::string(name(result.error.status)) + ": " + result.error.message);
  const Validation validation = validate(mesh, result.mesh);
  if (!validation.pass) return broken("validation fails:" + failures(validation));
  const std::string inside = brokenInside(mesh, result.mesh);
  return broken(inside.empty() ? brokenOrientation(mesh) : inside);
}

#include "shapes.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <numeric>
#include <random>
#include <utility>

#include "mandoline/shapes.h"
#include "vectors.h"

namespace shapes {

using namespace vectors;

namespace {

constexpr double pi = 3.14159265358979323846;

Point corner(const Mesh& mesh, size_t t, int k) { return pointAt(mesh.positions, mesh.triangles[3 * t + k]); }

uint32_t addVertex(Mesh& mesh, const Point& p) {
  mesh.positions.insert(mesh.positions.end(), p.begin(), p.end());
  return uint32_t(mesh.vertexCount() - 1);
}

void addTriangle(Mesh& mesh, uint32_t a, uint32_t b, uint32_t c) { mesh.triangles.insert(mesh.triangles.end(), {a, b, c}); }

void addQuad(Mesh& mesh, uint32_t a, uint32_t b, uint32_t c, uint32_t d) {
  addTriangle(mesh, a, b, c);
  addTriangle(mesh, a, c, d);
}

Mesh fromPoints(const std::vector<Point>& points, std::vector<uint32_t> triangles) {
  Mesh mesh;
  for (const Point& p : points) addVertex(mesh, p);
  mesh.triangles = std::move(triangles);
  return mesh;
}

/// Moves every vertex to place(its position).
template <class Place>
Mesh mapped(Mesh mesh, Place place) {
  for (size_t v = 0; v < mesh.vertexCount(); ++v) {
    const Point p = place(Point{mesh.positions[3 * v], mesh.positions[3 * v + 1], mesh.positions[3 * v + 2]});
    std::copy(p.begin(), p.end(), &mesh.positions[3 * v]);
  }
  return mesh;
}

}  // namespace

Mesh box(const Point& lo, const Point& hi) { return mandoline::makeBox(lo, hi); }

Mesh cube(double lo, double hi) { return box({lo, lo, lo}, {hi, hi, hi}); }

Mesh tetrahedron(const Point& a, const Point& b, const Point& c, const Point& d) {
  return fromPoints({a, b, c, d}, {0, 2, 1, 0, 1, 3, 1, 2, 3, 2, 0, 3});
}

Mesh octahedron(const Point& centre, double radius) {
  std::vector<Point> points;
  for (int v = 0; v < 6; ++v) {
    Point p = centre;
    p[v / 2] += v % 2 ? radius : -radius;
    points.push_back(p);
  }
  return fromPoints(points, {1, 3, 5, 3, 0, 5, 0, 2, 5, 2, 1, 5, 3, 1, 4, 0, 3, 4, 2, 0, 4, 1, 2, 4});
}

Mesh pyramid(const Point& o, double s, double height) {
  Mesh mesh = fromPoints({o, o + Point{s, 0, 0}, o + Point{s, s, 0}, o + Point{0, s, 0}, o + Point{s / 2, s / 2, height}}, {});
  addQuad(mesh, 0, 3, 2, 1);
  for (uint32_t k = 0; k < 4; ++k) addTriangle(mesh, k, (k + 1) % 4, 4);
  return mesh;
}

Mesh prism(const std::vector<std::array<double, 2>>& polygon, double zLo, double zHi) {
  Mesh mesh;
  const uint32_t n = uint32_t(polygon.size());
  for (double z : {zLo, zHi})
    for (const auto& p : polygon) addVertex(mesh, {p[0], p[1], z});
  for (uint32_t k = 0; k < n; ++k) addQuad(mesh, k, (k + 1) % n, n + (k + 1) % n, n + k);
  for (uint32_t k = 2; k < n; ++k) {
    addTriangle(mesh, 0, k, k - 1);
    addTriangle(mesh, n, n + k - 1, n + k);
  }
  return mesh;
}

Mesh icosphere(const Point& centre, double radius, int subdivisions) { return mandoline::makeSphere(centre, radius, subdivisions); }

Mesh noisySphere(const Point& centre, double radius, double noise, int subdivisions) {
  std::mt19937 random(7);
  return mapped(icosphere({0, 0, 0}, radius, subdivisions),
                [&](const Point& p) { return centre + (1 + noise * (double(random()) / 2147483648. - 1)) * p; });
}

Mesh torus(const Point& centre, double ringRadius, double tubeRadius, int ringSlices, int tubeSlices) {
  return translated(mandoline::makeTorus(ringRadius, tubeRadius, ringSlices, tubeSlices), centre);
}

Mesh tube(const Point& baseCentre, double radius, double height, int slices, bool caps) {
  std::vector<std::array<double, 2>> circle;
  for (int k = 0; k < slices; ++k) {
    const double u = 2 * pi * k / slices;
    circle.push_back({baseCentre[0] + radius * std::cos(u), baseCentre[1] + radius * std::sin(u)});
  }
  Mesh mesh = prism(circle, baseCentre[2], baseCentre[2] + height);
  if (!caps) mesh.triangles.resize(3 * 2 * size_t(slices));  // a prism's sides come first
  return mesh;
}

Mesh revolved(const Point& centre, const std::vector<std::array<double, 2>>& profile, int slices) {
  Mesh mesh;
  const uint32_t rings = uint32_t(profile.size()) - 2, n = uint32_t(slices);
  for (uint32_t k = 1; k <= rings; ++k)
    for (uint32_t i = 0; i < n; ++i) {
      const double u = 2 * pi * i / slices;
      addVertex(mesh, centre + Point{profile[k][0] * std::cos(u), profile[k][0] * std::sin(u), profile[k][1]});
    }
  const uint32_t first = addVertex(mesh, centre + Point{0, 0, profile.front()[1]});
  const uint32_t last = addVertex(mesh, centre + Point{0, 0, profile.back()[1]});
  for (uint32_t i = 0; i < n; ++i) {
    const uint32_t j = (i + 1) % n;
    addTriangle(mesh, first, i, j);
    for (uint32_t k = 0; k + 1 < rings; ++k) addQuad(mesh, k * n + i, (k + 1) * n + i, (k + 1) * n + j, k * n + j);
    addTriangle(mesh, last, (rings - 1) * n + j, (rings - 1) * n + i);
  }
  return signedVolume(mesh) < 0 ? flipped(mesh) : mesh;
}

Mesh sweptTube(const std::vector<Point>& path, double w, bool caps) {
  const auto direction = [&](size_t k) { return 1 / length(path[k + 1] - path[k]) * (path[k + 1] - path[k]); };
  Point d = direction(0);
  const Point u = std::abs(d[2]) < 0.5 ? Point{0, 0, 1} : Point{1, 0, 0}, v = cross(d, u);
  std::array<Point, 4> offsets = {w * u + w * v, w * v - w * u, -w * u - w * v, w * u - w * v};
  Mesh mesh;
  for (size_t k = 0; k < path.size(); ++k) {
    const Point next = k == 0 || k + 1 == path.size() ? d : direction(k);
    const bool turns = dot(d, next) < 0.5;
    for (Point& o : offsets) {
      const Point mitred = turns ? o - dot(o, next) * d : o;  // where the edge through o meets the plane that halves the turn
      addVertex(mesh, path[k] + mitred);
      if (turns) o = mitred - dot(mitred, next) * next;
    }
    d = next;
  }
  const uint32_t last = 4 * uint32_t(path.size() - 1);
  for (uint32_t base = 0; base < last; base += 4)
    for (uint32_t k = 0; k < 4; ++k) addQuad(mesh, base + k, base + (k + 1) % 4, base + 4 + (k + 1) % 4, base + 4 + k);
  addQuad(mesh, 3, 2, 1, 0);
  addQuad(mesh, last, last + 1, last + 2, last + 3);
  if (signedVolume(mesh) < 0) mesh = flipped(mesh);
  if (!caps) mesh.triangles.resize(mesh.triangles.size() - 12);
  return mesh;
}

std::vector<Point> hilbertCurve(int order) {
  if (order == 0) return {{0, 0, 0}};
  // From the cube's corner (0, 0, 0) to (1, 0, 0) through eight smaller curves of the same kind: the octant, the octant's corner where
  // the smaller curve starts, and the axis along which it ends.
  struct Part {
    int octant[3], start[3], axis;
  };
  static const Part parts[8] = {{{0, 0, 0}, {0, 0, 0}, 2}, {{0, 0, 1}, {0, 0, 0}, 1}, {{0, 1, 1}, {0, 0, 0}, 0}, {{0, 1, 0}, {1, 0, 1}, 2},
                                {{1, 1, 0}, {0, 0, 0}, 2}, {{1, 1, 1}, {0, 0, 0}, 0}, {{1, 0, 1}, {1, 1, 0}, 1}, {{1, 0, 0}, {1, 0, 1}, 2}};
  const std::vector<Point> smaller = hilbertCurve(order - 1);
  const double size = std::ldexp(1., order - 1);
  std::vector<Point> curve;
  for (const Part& part : parts)
    for (const Point& p : smaller) {
      Point q;
      for (int d = 0; d < 3; ++d) {
        const int to = (part.axis + d) % 3;
        q[to] = size * part.octant[to] + (part.start[to] ? size - 1 - p[d] : p[d]);
      }
      curve.push_back(q);
    }
  return curve;
}

Mesh quad(const Point& a, const Point& b, const Point& c, const Point& d) { return fromPoints({a, b, c, d}, {0, 1, 2, 0, 2, 3}); }

Mesh horizontalQuad(double lo, double hi, double z) { return quad({lo, lo, z}, {hi, lo, z}, {hi, hi, z}, {lo, hi, z}); }

Mesh triangle(const Point& a, const Point& b, const Point& c) { return fromPoints({a, b, c}, {0, 1, 2}); }

Mesh sheet(int nx, int ny, const std::function<Point(int, int)>& at) {
  Mesh mesh;
  const auto id = [&](int i, int j) { return uint32_t(j * (nx + 1) + i); };
  for (int j = 0; j <= ny; ++j)
    for (int i = 0; i <= nx; ++i) addVertex(mesh, at(i, j));
  for (int j = 0; j < ny; ++j)
    for (int i = 0; i < nx; ++i) addQuad(mesh, id(i, j), id(i + 1, j), id(i + 1, j + 1), id(i, j + 1));
  return mesh;
}

Mesh thickened(int nx, int ny, const std::function<Point(int, int)>& at, const Point& offset) {
  const Mesh bottom = sheet(nx, ny, at);
  Mesh mesh = merged({flipped(bottom), translated(bottom, offset)});
  const uint32_t n = uint32_t(bottom.vertexCount());
  const auto id = [&](int i, int j) { return uint32_t(j * (nx + 1) + i); };
  std::vector<uint32_t> rim;
  for (int i = 0; i < nx; ++i) rim.push_back(id(i, 0));
  for (int j = 0; j < ny; ++j) rim.push_back(id(nx, j));
  for (int i = nx; i > 0; --i) rim.push_back(id(i, ny));
  for (int j = ny; j > 0; --j) rim.push_back(id(0, j));
  for (size_t k = 0; k < rim.size(); ++k) {
    const uint32_t a = rim[k], b = rim[(k + 1) % rim.size()];
    addQuad(mesh, a, b, b + n, a + n);
  }
  return mesh;
}

Mesh moebius(const Point& centre, double radius, double width, int slices) {
  Mesh mesh;
  for (int i = 0; i < slices; ++i)
    for (double side : {-0.5, 0.5}) {
      const double u = 2 * pi * i / slices, r = radius + side * width * std::cos(u / 2);
      addVertex(mesh, centre + Point{r * std::cos(u), r * std::sin(u), side * width * std::sin(u / 2)});
    }
  for (uint32_t i = 0; i + 1 < uint32_t(slices); ++i) addQuad(mesh, 2 * i, 2 * i + 2, 2 * i + 3, 2 * i + 1);
  const uint32_t last = 2 * uint32_t(slices - 1);
  addQuad(mesh, last, 1, 0, last + 1);
  return mesh;
}

Mesh fan(const Point& edgeBase, double height, const std::vector<std::array<double, 2>>& ends) {
  Mesh mesh = fromPoints({edgeBase, edgeBase + Point{0, 0, height}}, {});
  for (const auto& end : ends) {
    const Point foot = edgeBase + Point{end[0], end[1], 0};
    const uint32_t a = addVertex(mesh, foot), b = addVertex(mesh, foot + Point{0, 0, height});
    addQuad(mesh, 0, a, b, 1);
  }
  return mesh;
}

Mesh wedge(const Point& a, const Point& b, const Point& c, double below, double above) {
  const Point middle = 1. / 3 * (a + b + c);
  const Point bottom = {middle[0], middle[1], below}, top = {middle[0], middle[1], above};
  return fromPoints({a, b, c, bottom, top}, {0, 1, 4, 1, 2, 4, 2, 0, 4, 1, 0, 3, 2, 1, 3, 0, 2, 3});
}

Mesh emptyCone() {
  // Difference of two tetrahedra with the same top face, in the axial plane; that face is the opening.
  return fromPoints({{0.125, 0.125, 1}, {0.875, 0.125, 1}, {0.5, 0.875, 1}, {0.5, 0.375, 0.125}, {0.5, 0.375, 0.5}},
                    {1, 0, 3, 2, 1, 3, 0, 2, 3, 0, 1, 4, 1, 2, 4, 2, 0, 4});
}

Mesh claw() {
  // Three prongs above the plane, joined below it by a keel that reaches up to the plane along the webs r1 l2 and r2 l3, where it has no
  // width: the cut of the solid is one closed curve, l1 f1 r1 l2 f2 r2 l3 f3 r3 l3 r2 l2 r1 l1, that runs through the webs twice.
  Mesh mesh;
  const double y = 0.625;
  for (double x : {0.125, 0.4375, 0.75}) {
    addVertex(mesh, {x, y, 1});                      // l = 4 k
    addVertex(mesh, {x + 0.0625, y - 0.25, 1});      // f
    addVertex(mesh, {x + 0.125, y, 1});              // r
    addVertex(mesh, {x + 0.0625, y - 0.125, 1.75});  // tip
  }
  const uint32_t front = addVertex(mesh, {0.5, 0.125, 0.25}), back = addVertex(mesh, {0.5, 0.875, 0.25});
  for (uint32_t l = 0; l < 12; l += 4) {
    const uint32_t f = l + 1, r = l + 2, tip = l + 3;
    addTriangle(mesh, l, f, tip);
    addTriangle(mesh, f, r, tip);
    addTriangle(mesh, r, l, tip);
    addTriangle(mesh, f, l, front);
    addTriangle(mesh, r, f, front);
    addTriangle(mesh, l, r, back);
    if (l < 8) {
      addTriangle(mesh, l + 4, r, front);
      addTriangle(mesh, r, l + 4, back);
    }
  }
  addTriangle(mesh, 0, back, front);
  addTriangle(mesh, 10, front, back);
  return mesh;
}

Mesh oscillator(int slices) {
  // A cylinder whose top oscillates about the plane z = 1 and ends on it at the rim.
  return revolved({0.5, 0.5, 0}, {{0, 0.25}, {0.4375, 0.25}, {0.4375, 1}, {0.3125, 0.75}, {0.1875, 1.25}, {0.09375, 0.75}, {0, 1.25}},
                  slices);
}

Mesh merged(const std::vector<Mesh>& meshes) {
  Mesh result;
  for (const Mesh& mesh : meshes) {
    const uint32_t base = uint32_t(result.vertexCount());
    result.positions.insert(result.positions.end(), mesh.positions.begin(), mesh.positions.end());
    for (uint32_t v : mesh.triangles) result.triangles.push_back(base + v);
  }
  return result;
}

Mesh flipped(Mesh mesh) {
  for (size_t t = 0; t < mesh.triangleCount(); ++t) std::swap(mesh.triangles[3 * t + 1], mesh.triangles[3 * t + 2]);
  return mesh;
}

Mesh translated(Mesh mesh, const Point& by) {
  return mapped(std::move(mesh), [&](const Point& p) { return p + by; });
}

Mesh scaled(Mesh mesh, const Point& by) {
  return mapped(std::move(mesh), [&](const Point& p) { return Point{p[0] * by[0], p[1] * by[1], p[2] * by[2]}; });
}

Mesh permuted(const Mesh& mesh, const std::array<int, 3>& axes, const std::array<bool, 3>& negate) {
  return mapped(mesh, [&](const Point& p) {
    Point q;
    for (int d = 0; d < 3; ++d) q[d] = negate[d] ? -p[axes[d]] : p[axes[d]];
    return q;
  });
}

Mesh shuffled(const Mesh& mesh, unsigned seed, std::vector<uint32_t>& newTriangle) {
  std::mt19937 random(seed);
  const auto shuffle = [&](size_t n) {  // not std::shuffle, whose result depends on the library
    std::vector<uint32_t> order(n);
    std::iota(order.begin(), order.end(), 0u);
    for (size_t k = n; k > 1; --k) std::swap(order[k - 1], order[random() % k]);
    return order;
  };
  const std::vector<uint32_t> newVertex = shuffle(mesh.vertexCount());
  newTriangle = shuffle(mesh.triangleCount());
  Mesh result = mesh;
  for (size_t v = 0; v < mesh.vertexCount(); ++v) std::copy_n(&mesh.positions[3 * v], 3, &result.positions[3 * newVertex[v]]);
  for (size_t t = 0; t < mesh.triangleCount(); ++t) {
    const size_t turn = random() % 3;
    for (size_t k = 0; k < 3; ++k) result.triangles[3 * newTriangle[t] + k] = newVertex[mesh.triangles[3 * t + (k + turn) % 3]];
  }
  return result;
}

Mesh withSplitTriangle(const Mesh& mesh, uint32_t t) {
  Mesh result = mesh;
  const uint32_t a = mesh.triangles[3 * t], b = mesh.triangles[3 * t + 1], c = mesh.triangles[3 * t + 2];
  const uint32_t v = addVertex(result, 0.25 * (corner(mesh, t, 0) + corner(mesh, t, 1)) + 0.5 * corner(mesh, t, 2));
  result.triangles[3 * t + 2] = v;
  addTriangle(result, b, c, v);
  addTriangle(result, c, a, v);
  return result;
}

Mesh unwelded(const Mesh& mesh) {
  Mesh result;
  for (uint32_t v : mesh.triangles)
    result.triangles.push_back(addVertex(result, {mesh.positions[3 * v], mesh.positions[3 * v + 1], mesh.positions[3 * v + 2]}));
  return result;
}

Mesh soup(const std::vector<std::array<Point, 3>>& triangles) {
  Mesh result;
  for (const auto& corners : triangles) {
    for (const Point& p : corners) result.triangles.push_back(addVertex(result, p));
  }
  return result;
}

double signedVolume(const Mesh& mesh) {
  if (mesh.triangleCount() == 0) return 0;
  const Point o = corner(mesh, 0, 0);  // near the mesh, against cancellation
  double sum = 0;
  for (size_t t = 0; t < mesh.triangleCount(); ++t)
    sum += dot(corner(mesh, t, 0) - o, cross(corner(mesh, t, 1) - o, corner(mesh, t, 2) - o));
  return sum / 6;
}

double area(const Mesh& mesh) {
  double sum = 0;
  for (size_t t = 0; t < mesh.triangleCount(); ++t) {
    const Point a = corner(mesh, t, 0);
    sum += length(cross(corner(mesh, t, 1) - a, corner(mesh, t, 2) - a));
  }
  return sum / 2;
}

size_t openEdges(const Mesh& mesh) {
  std::map<std::pair<uint32_t, uint32_t>, int> sums;
  for (size_t i = 0; i < mesh.triangles.size(); ++i) {
    const uint32_t a = mesh.triangles[i], b = mesh.triangles[i % 3 == 2 ? i - 2 : i + 1];
    sums[std::minmax(a, b)] += a < b ? 1 : -1;
  }
  return size_t(std::count_if(sums.begin(), sums.end(), [](const auto& edge) { return edge.second != 0; }));
}

}  // namespace shapes

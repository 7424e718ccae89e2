#include "mandoline/shapes.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <string>
#include <utility>

#include "mandoline/status.h"

namespace mandoline {
namespace {

using Vector = std::array<double, 3>;

constexpr double kPi = 3.14159265358979323846;

Vector operator+(const Vector& a, const Vector& b) { return {a[0] + b[0], a[1] + b[1], a[2] + b[2]}; }
Vector operator-(const Vector& a, const Vector& b) { return {a[0] - b[0], a[1] - b[1], a[2] - b[2]}; }
Vector operator*(double s, const Vector& a) { return {s * a[0], s * a[1], s * a[2]}; }
Vector cross(const Vector& a, const Vector& b) { return {a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]}; }
double length(const Vector& a) { return std::sqrt(a[0] * a[0] + a[1] * a[1] + a[2] * a[2]); }
Vector unit(const Vector& a) { return 1 / length(a) * a; }

Vector position(const Mesh& mesh, uint32_t v) {
  const double* p = mesh.positions.data() + 3 * size_t(v);
  return {p[0], p[1], p[2]};
}

uint32_t addVertex(Mesh& mesh, const Vector& p) {
  mesh.positions.insert(mesh.positions.end(), p.begin(), p.end());
  return uint32_t(mesh.vertexCount() - 1);
}

/// Closes rings of vertices, one after the other, to a tube that bites its tail.
template <class Place>
Mesh ringOfRings(int rings, int corners, const Place& place) {
  if (rings < 3 || corners < 3) {
    throw CallError(
        {Status::badArgument, -1, -1,
         "A tube needs at least 3 rings of at least 3 corners, not " + std::to_string(rings) + " of " + std::to_string(corners) + "."});
  }
  Mesh mesh;
  for (int i = 0; i < rings; ++i) {
    for (int j = 0; j < corners; ++j) addVertex(mesh, place(2 * kPi * i / rings, 2 * kPi * j / corners));
  }
  const auto vertex = [&](int i, int j) { return uint32_t(i % rings) * uint32_t(corners) + uint32_t(j % corners); };
  for (int i = 0; i < rings; ++i) {
    for (int j = 0; j < corners; ++j) {
      const uint32_t a = vertex(i, j), b = vertex(i + 1, j), c = vertex(i + 1, j + 1), d = vertex(i, j + 1);
      mesh.triangles.insert(mesh.triangles.end(), {a, b, c, a, c, d});
    }
  }
  return mesh;
}

Mesh icosahedron() {
  const double g = (1 + std::sqrt(5.)) / 2;
  Mesh mesh;
  mesh.positions = {-1, g, 0, 1, g, 0, -1, -g, 0, 1, -g, 0, 0, -1, g, 0, 1, g, 0, -1, -g, 0, 1, -g, g, 0, -1, g, 0, 1, -g, 0, -1, -g, 0, 1};
  mesh.triangles = {0, 11, 5, 0, 5, 1, 0, 1, 7, 0, 7, 10, 0, 10, 11, 1, 5, 9, 5, 11, 4,  11, 10, 2,  10, 7, 6, 7, 1, 8,
                    3, 9,  4, 3, 4, 2, 3, 2, 6, 3, 6, 8,  3, 8,  9,  4, 9, 5, 2, 4,  11, 6,  2,  10, 8,  6, 7, 9, 8, 1};
  return mesh;
}

/// Each triangle in four, with new vertices at the middle of its edges.
Mesh subdivided(const Mesh& mesh) {
  Mesh result;
  result.positions = mesh.positions;
  std::map<std::pair<uint32_t, uint32_t>, uint32_t> middles;
  const auto middle = [&](uint32_t a, uint32_t b) {
    const auto [place, isNew] = middles.try_emplace(std::minmax(a, b));
    if (isNew) place->second = addVertex(result, 0.5 * (position(mesh, a) + position(mesh, b)));
    return place->second;
  };
  for (size_t t = 0; t < mesh.triangleCount(); ++t) {
    const uint32_t a = mesh.triangles[3 * t], b = mesh.triangles[3 * t + 1], c = mesh.triangles[3 * t + 2];
    const uint32_t ab = middle(a, b), bc = middle(b, c), ca = middle(c, a);
    result.triangles.insert(result.triangles.end(), {a, ab, ca, b, bc, ab, c, ca, bc, ab, bc, ca});
  }
  return result;
}

}  // namespace

Mesh makeBox(const Vector& min, const Vector& max) {
  Mesh mesh;
  for (int v = 0; v < 8; ++v) addVertex(mesh, {v & 1 ? max[0] : min[0], v & 2 ? max[1] : min[1], v & 4 ? max[2] : min[2]});
  mesh.triangles = {0, 4, 6, 0, 6, 2, 1, 3, 7, 1, 7, 5, 0, 1, 5, 0, 5, 4, 2, 6, 7, 2, 7, 3, 0, 2, 3, 0, 3, 1, 4, 5, 7, 4, 7, 6};
  return mesh;
}

Mesh makeSphere(const Vector& centre, double radius, int subdivisions) {
  Mesh mesh = icosahedron();
  for (int s = 0; s < subdivisions; ++s) mesh = subdivided(mesh);
  for (uint32_t v = 0; v < mesh.vertexCount(); ++v) {
    const Vector p = position(mesh, v), q = centre + radius / length(p) * p;
    std::copy(q.begin(), q.end(), mesh.positions.begin() + std::ptrdiff_t(3 * size_t(v)));
  }
  return mesh;
}

Mesh makeTorus(double ringRadius, double tubeRadius, int rings, int corners) {
  return ringOfRings(rings, corners, [&](double u, double v) {
    const double r = ringRadius + tubeRadius * std::cos(v);
    return Vector{r * std::cos(u), r * std::sin(u), tubeRadius * std::sin(v)};
  });
}

Mesh makeTorusKnot(double tubeRadius, int rings, int corners) {
  const auto centre = [](double u) {
    const double r = 2 + std::cos(3 * u);
    return Vector{r * std::cos(2 * u), r * std::sin(2 * u), std::sin(3 * u)};
  };
  return ringOfRings(rings, corners, [&](double u, double v) {
    const Vector p = centre(u), tangent = unit(centre(u + 1e-3) - centre(u - 1e-3));
    const Vector fromRing = p - Vector{2 * std::cos(2 * u), 2 * std::sin(2 * u), 0};
    const Vector out = unit(cross(tangent, cross(fromRing, tangent))), side = cross(out, tangent);
    return p + tubeRadius * std::cos(v) * out + tubeRadius * std::sin(v) * side;
  });
}

}  // namespace mandoline

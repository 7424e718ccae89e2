// Simple meshes to try things on. All are closed and oriented outward.
#pragma once

#include <array>

#include "mandoline/mesh.h"

namespace MANDOLINE_API mandoline {

/// 12 triangles.
Mesh makeBox(const std::array<double, 3>& min, const std::array<double, 3>& max);
/// An icosahedron whose triangles are split in four, `subdivisions` times, with its vertices on the sphere: 20 * 4^subdivisions triangles.
Mesh makeSphere(const std::array<double, 3>& centre, double radius, int subdivisions);
/// About the z axis, around the origin: `rings` of `corners` vertices each; both numbers are at least 3.
Mesh makeTorus(double ringRadius, double tubeRadius, int rings, int corners);
/// A tube along the (2, 3) torus knot, which winds about a torus of radii 2 and 1 around the z axis.
Mesh makeTorusKnot(double tubeRadius = 0.4, int rings = 240, int corners = 16);

}  // namespace mandoline

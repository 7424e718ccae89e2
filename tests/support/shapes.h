// Meshes that the tests make themselves. Closed ones are oriented outward. Where coordinates matter they are exact in binary.
#pragma once

#include <array>
#include <functional>
#include <vector>

#include "mandoline/mandoline.h"

namespace shapes {

using mandoline::Mesh;
using Point = std::array<double, 3>;

// Polyhedra.
Mesh box(const Point& lo, const Point& hi);
Mesh cube(double lo, double hi);                                                   ///< [lo, hi]^3
Mesh tetrahedron(const Point& a, const Point& b, const Point& c, const Point& d);  ///< outward if (b-a) x (c-a) . (d-a) > 0
Mesh octahedron(const Point& centre, double radius);
Mesh pyramid(const Point& baseLo, double baseSize, double height);  ///< square base in the plane z = baseLo.z
/// Prism over a simple polygon (counter-clockwise seen from above) between two heights; the caps are fans from the polygon's first vertex.
Mesh prism(const std::vector<std::array<double, 2>>& polygon, double zLo, double zHi);

// Round things.
Mesh icosphere(const Point& centre, double radius, int subdivisions);
Mesh noisySphere(const Point& centre, double radius, double noise, int subdivisions);  ///< vertices moved along their radius
Mesh torus(const Point& centre, double ringRadius, double tubeRadius, int ringSlices, int tubeSlices);
/// Axis z; without caps it is open at both ends.
Mesh tube(const Point& baseCentre, double radius, double height, int slices, bool caps);
/// Surface of revolution about the vertical axis through `centre` of a profile (radius, height) that starts and ends at radius 0.
Mesh revolved(const Point& centre, const std::vector<std::array<double, 2>>& profile, int slices);
/// Square tube of half-width w along an axis-aligned path with right-angled turns, mitred; the path's ends are capped.
Mesh sweptTube(const std::vector<Point>& path, double w, bool caps = true);
/// Vertices of the Hilbert curve through the 8^order points of the cubic lattice.
std::vector<Point> hilbertCurve(int order);

// Sheets.
Mesh quad(const Point& a, const Point& b, const Point& c, const Point& d);  ///< triangles abc, acd
Mesh horizontalQuad(double lo, double hi, double z);                        ///< [lo, hi]^2 at height z
Mesh triangle(const Point& a, const Point& b, const Point& c);
/// A rectangular sheet of nx x ny squares whose vertices lie at at(i, j).
Mesh sheet(int nx, int ny, const std::function<Point(int, int)>& at);
/// The closed layer between a sheet and the same sheet moved by `offset`, which has to lie on the side of its normal.
Mesh thickened(int nx, int ny, const std::function<Point(int, int)>& at, const Point& offset);
Mesh moebius(const Point& centre, double radius, double width, int slices);
/// `blades` sheets on one vertical edge of the given height; blade k ends at ends[k] (x, y relative to the edge).
Mesh fan(const Point& edgeBase, double height, const std::vector<std::array<double, 2>>& ends);

// The paper's difficult cases (5.5), with the axial plane of interest at z = 1 and all within [0, 1]^2 x [0, 2].
Mesh wedge(const Point& a, const Point& b, const Point& c, double below, double above);  ///< triangle in z = 1, tips below and above it
Mesh emptyCone();
Mesh claw();
Mesh oscillator(int slices);

// Changes of a mesh.
Mesh merged(const std::vector<Mesh>& meshes);
Mesh flipped(Mesh mesh);
Mesh translated(Mesh mesh, const Point& by);
Mesh scaled(Mesh mesh, const Point& by);
/// Axis d of the result is axis axes[d] of the mesh, negated where negate[d]. Triangles keep the order of their vertices.
Mesh permuted(const Mesh& mesh, const std::array<int, 3>& axes, const std::array<bool, 3>& negate = {});
/// Shuffles tri-vertex ids, triangle ids and the first vertex of each triangle; newTriangle[t] is the new id of triangle t.
Mesh shuffled(const Mesh& mesh, unsigned seed, std::vector<uint32_t>& newTriangle);
/// Triangle t becomes three (t and two at the end) about a point inside, exact for coordinates of few bits.
Mesh withSplitTriangle(const Mesh& mesh, uint32_t t);
Mesh unwelded(const Mesh& mesh);                                ///< three vertices of its own for each triangle
Mesh soup(const std::vector<std::array<Point, 3>>& triangles);  ///< which share no vertex ids

double signedVolume(const Mesh& mesh);
double area(const Mesh& mesh);
size_t openEdges(const Mesh& mesh);  ///< that triangles run along more often one way than the other: 0 of a closed surface

}  // namespace shapes

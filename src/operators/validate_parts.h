// What the parts of validate() share. Nothing here comes from the cutter: a validator that shares code with it would share its mistakes.
//
// Measured checks are in roundings. One rounding along axis d is half an ulp of the largest coordinate there, the most that storing a
// position can move it. The deviation of a length, area or volume is divided by what it changes when all its boundary moves by one
// rounding, so one tolerance fits slivers, thin slabs and huge grids alike.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <string>
#include <vector>

#include "mandoline/validate.h"

namespace mandoline::validation {

struct Vec3 {
  double v[3] = {0, 0, 0};
  double& operator[](int d) { return v[d]; }
  double operator[](int d) const { return v[d]; }
};
inline Vec3 operator+(const Vec3& a, const Vec3& b) { return {{a[0] + b[0], a[1] + b[1], a[2] + b[2]}}; }
inline Vec3 operator-(const Vec3& a, const Vec3& b) { return {{a[0] - b[0], a[1] - b[1], a[2] - b[2]}}; }
inline Vec3 operator*(double s, const Vec3& a) { return {{s * a[0], s * a[1], s * a[2]}}; }
inline double dot(const Vec3& a, const Vec3& b) { return a[0] * b[0] + a[1] * b[1] + a[2] * b[2]; }
inline Vec3 cross(const Vec3& a, const Vec3& b) {
  return {{a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]}};
}
inline double length(const Vec3& a) { return std::sqrt(dot(a, a)); }
inline int dominantAxis(const Vec3& a) {
  const int d = std::fabs(a[1]) > std::fabs(a[0]) ? 1 : 0;
  return std::fabs(a[2]) > std::fabs(a[d]) ? 2 : d;
}

constexpr double kRounding = 0x1p-53;
/// A made vertex may be off by the 8 roundings of its own computation and is compared through a chain of at most some 20 more, each of
/// values up to twice the largest coordinate.
constexpr double kTolerance = 64;

/// Sum of doubles that loses nothing to cancellation (Neumaier).
class Sum {
 public:
  void add(double x) {
    const double t = sum_ + x;
    lost_ += std::fabs(sum_) >= std::fabs(x) ? (sum_ - t) + x : (x - t) + sum_;
    sum_ = t;
  }
  double value() const { return sum_ + lost_; }

 private:
  double sum_ = 0, lost_ = 0;
};

/// Pseudo-random numbers, the same on every platform (splitmix64).
class Random {
 public:
  explicit Random(uint64_t seed) : state_(seed) {}
  uint64_t next() { return mix(state_ += 0x9e3779b97f4a7c15u); }
  double between(double low, double high) { return low + (high - low) * double(next() >> 11) * 0x1p-53; }
  static uint64_t mix(uint64_t x) {
    x = (x ^ (x >> 30)) * 0xbf58476d1ce4e5b9u;
    x = (x ^ (x >> 27)) * 0x94d049bb133111ebu;
    return x ^ (x >> 31);
  }

 private:
  uint64_t state_;
};

/// Disjoint sets of 0..n-1.
class Sets {
 public:
  void reset(size_t n) {
    parent_.resize(n);
    for (size_t i = 0; i < n; ++i) parent_[i] = uint32_t(i);
  }
  uint32_t find(uint32_t i) {
    while (parent_[i] != i) i = parent_[i] = parent_[parent_[i]];
    return i;
  }
  void unite(uint32_t i, uint32_t j) {
    i = find(i), j = find(j);
    parent_[i < j ? j : i] = i < j ? i : j;
  }

 private:
  std::vector<uint32_t> parent_;
};

/// Collects one check: the number of violations, or the largest deviation in roundings.
class Tally {
 public:
  explicit Tally(const char* name, double tolerance = 0) { check_.name = name, check_.tolerance = tolerance; }
  /// A combinatorial check is broken; `text` goes on after "face 12 ". The first element is kept.
  void violate(const char* kind, int64_t element, const char* text) {
    if (check_.worst++ == 0) keep(kind, element, text);
  }
  /// A deviation was measured; `text` says what it is of.
  void measure(double roundings, const char* kind, int64_t element, const char* text) {
    if (roundings <= check_.worst || std::isnan(check_.worst)) return;
    check_.worst = roundings;
    keep(kind, element, text);
  }
  void skip(const std::string& reason) { check_.skipped = true, check_.message = reason; }
  void note(const std::string& leftOut) { note_ = leftOut; }
  Check finish();

 private:
  void keep(const char* kind, int64_t element, const char* text) {
    check_.elementKind = kind, check_.element = element;
    text_ = text;
  }
  Check check_;
  const char* text_ = "";
  std::string note_;
};

/// A number kept exactly, barring overflow and underflow, as a sum of doubles that do not overlap, of ascending size (Shewchuk 1997).
class Exact {
 public:
  Exact() = default;
  Exact(double x) { add(x); }
  Exact operator+(const Exact& other) const;
  Exact operator-(const Exact& other) const;
  Exact operator*(const Exact& other) const;
  int sign() const { return parts_.empty() ? 0 : parts_.back() > 0 ? 1 : -1; }

 private:
  void add(double x);
  std::vector<double> parts_;
};

/// Exact sign of (a - b) (c - d) - (e - f) (g - h).
int differenceSign(double a, double b, double c, double d, double e, double f, double g, double h);
/// Exact: 1 if a, b, c turn counter-clockwise about +axis.
int turn(const Vec3& a, const Vec3& b, const Vec3& c, int axis);
bool collinear(const Vec3& a, const Vec3& b, const Vec3& c);
bool coplanar(const Vec3& a, const Vec3& b, const Vec3& c, const Vec3& d);
/// Distance of p from a segment or triangle, at most a few roundings too large however thin the triangle is, if coordinates are in roundings.
double distanceToSegment(const Vec3& p, const Vec3& a, const Vec3& b);
double distanceToTriangle(const Vec3& p, const Vec3& a, const Vec3& b, const Vec3& c);
/// Triangle normal (b - a) x (c - a) and a bound of the error of each of its components.
struct Normal {
  Vec3 n, error;
};
Normal normalOf(const Vec3& a, const Vec3& b, const Vec3& c);

/// The cut-mesh and its input, with what follows from their arrays. Needs arrays that passed checkArrays.
struct Context {
  Context(const MeshView& mesh, const CutMesh& cutMesh, double snapTolerance);

  const MeshView& mesh;
  const CutMesh& cut;
  const double snapTolerance;

  std::vector<double> positions;         ///< the input's, moved by snapTolerance as the cut-mesh says
  std::vector<uint32_t> weld;            ///< per tri-vertex: the lowest one at its position
  std::vector<uint8_t> dropped;          ///< per triangle
  double negligible = 0;                 ///< smaller coordinates count as 0
  Vec3 rounding;                         ///< one rounding per axis
  std::vector<int32_t> owner;            ///< per half-face: its cut-cell (the first that lists it), or -1
  std::vector<int32_t> faceGridCell;     ///< 3 per face: the grid cell it lies in, on its axis the one above it; -1 if it is in no single one
  std::vector<uint32_t> cellOrder;       ///< cut-cells by grid cell, ordered z, y, x
  std::vector<uint32_t> groupOffsets;    ///< into cellOrder: one group per grid cell
  bool closed = false;                   ///< whether every edge is run through equally often in both directions
  bool closedWithoutDuplicates = false;  ///< the same without triangles dropped as duplicates
  std::vector<int32_t> multiplicity;     ///< per triangle: sum of orientations of all with its vertices, relative to its own; empty if all 1
  std::vector<uint8_t> duplicate;        ///< per triangle: dropped, with another of its vertices that is kept or comes before; empty if none

  Vec3 vertex(uint32_t v) const { return {{cut.positions[3 * size_t(v)], cut.positions[3 * size_t(v) + 1], cut.positions[3 * size_t(v) + 2]}}; }
  Vec3 triVertex(uint32_t v) const { return {{positions[3 * size_t(v)], positions[3 * size_t(v) + 1], positions[3 * size_t(v) + 2]}}; }
  Vec3 corner(size_t triangle, int i) const { return triVertex(mesh.triangles[3 * triangle + i]); }
  Normal triangleNormal(size_t t) const { return normalOf(corner(t, 0), corner(t, 1), corner(t, 2)); }
  bool hasArea(size_t t) const { return !collinear(corner(t, 0), corner(t, 1), corner(t, 2)); }
  /// Coordinates relative to an origin, in roundings.
  Vec3 inRoundings(const Vec3& p, const Vec3& origin) const {
    return {{(p[0] - origin[0]) / rounding[0], (p[1] - origin[1]) / rounding[1], (p[2] - origin[2]) / rounding[2]}};
  }
  double plane(int axis, int64_t i) const {
    const double x = cut.grid.planes[axis][i];
    return std::fabs(x) < negligible ? 0 : x;
  }
  const int32_t* cellAt(uint32_t v) const { return cut.vertexCell.data() + 3 * size_t(v); }
  bool onPlane(uint32_t v, int axis) const { return cut.vertexMask[v] >> axis & 1; }
  /// Whether vertex v lies in the closed grid cells i along the axis.
  bool inSlab(uint32_t v, int axis, int32_t i) const { return cellAt(v)[axis] == i || (onPlane(v, axis) && cellAt(v)[axis] == i + 1); }
  const int32_t* gridCellOf(size_t cell) const { return cut.cellGridCell.data() + 3 * cell; }
  bool isDuplicate(size_t t) const { return !duplicate.empty() && duplicate[t]; }
  size_t groupCount() const { return groupOffsets.size() - 1; }
  bool inBox(const Vec3& p) const;
  /// Sign of the axis-component of the normal of an axial face.
  int axialSide(size_t face) const;
  /// The runs of untouched grid cells: index of the one that holds a grid cell, or -1.
  int64_t runAt(int64_t i, int64_t j, int64_t k) const;
  /// f(loop) for each loop of a face, the outer one first.
  template <class F>
  void forLoops(size_t face, F&& f) const {
    for (uint32_t l = cut.faceLoopOffsets[face]; l < cut.faceLoopOffsets[face + 1]; ++l) f(cut.loop(l));
  }

 private:
  void moveInput();
  void setRounding();
  void setOwners();
  void locateFaces();
  void groupCells();
  void setDuplicates();
  void setClosed();
};

/// The cut-cells of one grid cell, in coordinates of that cell: 0 to 1 per axis.
struct GridCell {
  struct Face {
    uint32_t id;
    int32_t owner[2];       ///< cut-cell of side 0 and 1 if it lies in this grid cell, else -1
    uint32_t firstCorner, lastCorner;
    int side;               ///< 2 * axis + which end, if it lies in the cell's boundary, else -1
    Vec3 low, high;         ///< bounding box
    double volume;          ///< of the cone from the face to the grid cell's lowest corner
    double volumeNoise;     ///< how much of it one rounding changes
    Vec3 area, areaNoise;   ///< vector area, and the same for its components
  };
  explicit GridCell(const Context& context) : context(context), local_(context.cut.faceCount(), -1) {}
  void gather(size_t group);
  Vec3 local(const Vec3& p) const { return {{(p[0] - low[0]) / size[0], (p[1] - low[1]) / size[1], (p[2] - low[2]) / size[2]}}; }

  const Context& context;
  std::array<int32_t, 3> index{};
  Vec3 low, size;                      ///< in world units
  Vec3 noise;                          ///< one rounding
  std::span<const uint32_t> cells;     ///< its cut-cells
  std::vector<Face> faces;
  std::vector<uint32_t> cornerVertex;  ///< loops of all faces
  std::vector<uint32_t> cornerNext;    ///< the next corner of the loop
  std::vector<Vec3> corners;           ///< their positions

 private:
  Face& addFace(uint32_t id);
  void addLoop(Face& face, std::span<const uint32_t> loop);
  std::vector<int32_t> local_;  ///< per face of the cut-mesh: its place in faces or -1
};

/// An edge by its vertices, the lower one first.
using Edge = std::array<uint32_t, 2>;

/// Around each cut-edge, faces that follow one another face the same cut-cell; edges cancel.
class EdgeCheck {
 public:
  /// Unites in `shells` the half-faces (2 * face + side, by place in cell.faces) that bound the same shell.
  void run(const GridCell& cell, Sets& shells);
  void finish(std::vector<Check>& checks);
  /// Of the grid cell that was last run.
  const std::vector<Edge>& edges() const { return edges_; }

 private:
  struct Use {
    Edge edge;
    uint32_t face;
    bool forward;   ///< whether the face runs from the lower vertex to the higher one
  };
  void checkCancel(const GridCell& cell, std::span<const Use> uses);
  void join(const GridCell& cell, const Use& use, const Use& next, Sets& shells);
  bool sortByAngle(const GridCell& cell, std::span<Use> uses);
  void joinLoosely(const GridCell& cell, std::span<const Use> uses, Sets& shells);

  std::vector<Use> uses_;
  std::vector<Edge> edges_;
  std::vector<std::pair<int32_t, int32_t>> directions_;
  std::vector<std::pair<double, Use>> angles_;
  uint64_t unjudged_ = 0;
  Tally closed_{"closedCells"}, facing_{"facingFaces"};
};

/// No vertex lies inside of an edge of the same grid cell.
class ConformingCheck {
 public:
  void run(const GridCell& cell, const std::vector<Edge>& edges);
  void finish(std::vector<Check>& checks) { checks.push_back(conforming_.finish()); }

 private:
  struct Vertex {
    uint32_t id;
    Vec3 position;
  };
  void gatherVertices(const GridCell& cell, const std::vector<Edge>& edges);
  void checkVertex(const GridCell& cell, const Edge& edge, uint32_t vertex);

  std::vector<uint32_t> ids_;
  std::vector<Vertex> sorted_[3];  // vertices of the grid cell, along each axis
  Tally conforming_{"conforming"};
};

/// Shells and volumes of the cut-cells of a grid cell.
class ShellCheck {
 public:
  void run(const GridCell& cell, Sets& shells, std::vector<double>& cellVolumes);
  void finish(std::vector<Check>& checks);

 private:
  void checkSides(const GridCell& cell);
  void checkDistinct(const GridCell& cell);

  struct Shell {
    double volume = 0, noise = 0;
  };
  struct Cell {
    uint64_t faces = 0;  // sum of hashes: the same for cells with the same faces
    double volume = 0, noise = 0;
    int positive = 0, perhapsPositive = 0;  // shells
  };
  std::vector<Shell> shells_;  // per half-face, in use where that stands for its shell
  std::vector<Cell> cells_;
  Tally connected_{"connected"}, distinct_{"distinctCells"};
  Tally cellVolume_{"cellVolume", kTolerance}, gridCellVolume_{"gridCellVolume", kTolerance}, gridFaceArea_{"gridFaceArea", kTolerance};
};

/// The faces of a grid cell in square bins, seen along an axis; without those that lie in its boundary parallel to that.
class FaceBins {
 public:
  void build(const GridCell& cell, int axis);
  /// f(face) for the faces in the bins of a box, some of them repeatedly.
  template <class F>
  void forFaces(const Vec3& low, const Vec3& high, F&& f) const {
    const int d = (axis_ + 1) % 3, e = (axis_ + 2) % 3;
    for (size_t j = binOf(low[e]); j <= binOf(high[e]); ++j) {
      for (size_t b = j * size_t(bins_) + binOf(low[d]); b <= j * size_t(bins_) + binOf(high[d]); ++b) {
        for (uint32_t i = offsets_[b]; i < offsets_[b + 1]; ++i) f(faces_[i]);
      }
    }
  }

 private:
  size_t binOf(double x) const { return size_t(std::clamp(x * bins_, 0.0, bins_ - 1.0)); }

  int axis_ = 0, bins_ = 1;
  std::vector<uint32_t> offsets_, faces_;
};

/// A face seen along an axis.
enum class Place { outside, inside, open };
/// Where a point is on it; open if nearer to its edges than the margin.
Place placeOn(const GridCell& cell, const GridCell::Face& face, int axis, const Vec3& point, const Vec3& margin);

/// No edge crosses a tri-face.
class CrossingCheck {
 public:
  void run(const GridCell& cell, const std::vector<Edge>& edges);
  void finish(std::vector<Check>& checks) { checks.push_back(crossings_.finish()); }

 private:
  void checkEdge(const GridCell& cell, const Vec3& from, const Vec3& to, uint32_t face);

  FaceBins bins_;
  Tally crossings_{"crossings"};
};

/// A point known to lie in a region, for comparison with the input's own winding number.
struct Sample {
  Vec3 position;
  uint32_t region;
  const char* kind;  ///< what it lies in
  int64_t element;
};

/// Lines through a grid cell pass from cut-cell to cut-cell: each point in exactly one.
class LineCheck {
 public:
  explicit LineCheck(const Context& context);
  void run(const GridCell& cell, std::vector<Sample>& samples);
  void finish(std::vector<Check>& checks);

 private:
  struct Hit {
    double low, high;  ///< where on the line it is
    int32_t below, above;  ///< the cut-cells before and after it, -1 outside of the grid cell
    const GridCell::Face* face;
  };
  enum class Verdict { fine, unjudged, broken };
  Vec3 pointOn(const GridCell& cell, const GridCell::Face& face, int axis);
  void tryLine(const GridCell& cell, int axis, const GridCell::Face* through, std::vector<Sample>& samples);
  Verdict shoot(const GridCell& cell, int axis, const Vec3& point);
  bool addHit(const GridCell& cell, int axis, const Vec3& point, const GridCell::Face& face);
  Verdict follow(const GridCell& cell, int axis);
  void sample(const GridCell& cell, int axis, Vec3 point, std::vector<Sample>& samples);

  Random random_{1};
  uint64_t work_ = 0;  // edges compared with lines, in this grid cell
  uint64_t lines_ = 0, unjudged_ = 0, skipped_ = 0, stride_ = 1;
  FaceBins bins_;
  std::vector<Hit> hits_;
  Tally partition_{"partition"};
};

/// The input's triangles in square bins, seen along the axis in which the mesh is thinnest.
class TriangleBins {
 public:
  explicit TriangleBins(const Context& context);
  /// f(triangle) for all triangles in the bins of a box, some of them repeatedly.
  template <class F>
  void forTriangles(const Vec3& low, const Vec3& high, F&& f) const {
    for (size_t j = binOf(low, 1); j <= binOf(high, 1); ++j) {
      for (size_t b = j * size_t(bins_) + binOf(low, 0); b <= j * size_t(bins_) + binOf(high, 0); ++b) {
        for (uint32_t i = offsets_[b]; i < offsets_[b + 1]; ++i) f(triangles_[i]);
      }
    }
  }
  /// Winding number of the input at a point, by a ray along the axis; false where rounding leaves it open.
  bool winding(const Vec3& p, bool withDuplicates, int32_t& result) const;

 private:
  size_t binOf(const Vec3& p, int side) const {
    const int d = (axis_ + 1 + side) % 3;
    return size_t(std::clamp((p[d] - low_[d]) * scale_[d], 0.0, bins_ - 1.0));
  }
  void box(size_t triangle, Vec3& low, Vec3& high) const;

  const Context& x_;
  int axis_ = 0, bins_ = 1;
  Vec3 low_, scale_;
  std::vector<uint32_t> offsets_, triangles_;
};

// The checks. Each adds its results in the order in which they appear in Validation.
Check checkArrays(const MeshView& mesh, const CutMesh& cutMesh);
void checkVertices(const Context& context, std::vector<Check>& checks);
void checkFaces(const Context& context, std::vector<Check>& checks);
/// Marks triangles that overlap others in one plane.
void checkSurface(const Context& context, const TriangleBins& bins, std::vector<Check>& checks, std::vector<uint8_t>& overlapping);
/// Runs the checks by grid cell above on every grid cell that has cut-cells.
void checkGridCells(const Context& context, std::vector<Check>& checks, std::vector<double>& cellVolumes, std::vector<Sample>& samples);
void checkRegions(const Context& context, std::vector<Check>& checks);
void checkWinding(const Context& context, const TriangleBins& bins, const std::vector<double>& cellVolumes, const std::vector<uint8_t>& overlapping,
                  std::vector<Sample> samples, std::vector<Check>& checks);

}  // namespace mandoline::validation

// What the parts of validate() share: how a check is reported, and the cut-mesh and its input with what follows from their arrays.
//
// Measured checks are in roundings. One rounding along axis d is half an ulp of the largest coordinate there, the most that storing a
// position can move it. The deviation of a length, area or volume is divided by what it changes when all its boundary moves by one
// rounding, so one tolerance fits slivers, thin slabs and huge grids alike.
#pragma once

#include <algorithm>
#include <array>
#include <string>

#include "mandoline/validate.h"
#include "operators/validate/geometry.h"

namespace mandoline::validation {

/// A made vertex may be off by the 8 roundings of its own computation and is compared through a chain of at most some 20 more, each of
/// values up to twice the largest coordinate.
constexpr double kTolerance = 64;

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

/// All coordinates are scaled by one power of two that brings the largest up to here, so that products of up to eight of them neither
/// overflow nor underflow; and those smaller by a factor of 2^200 count as 0.
constexpr int kLargestExponent = 120, kNegligibleExponent = -80;
/// The exponent of that power of two.
int scaleOf(const MeshView& mesh, const Grid& grid);

/// The cut-mesh and its input, with what follows from their arrays. Needs arrays that passed checkArrays.
struct Context {
  Context(const MeshView& mesh, const CutMesh& cutMesh, double snapTolerance);

  const MeshView& mesh;
  const CutMesh& cut;

  std::array<std::vector<double>, 3> planes;  ///< scaled
  std::vector<double> positions;              ///< the cut-mesh's, scaled
  std::vector<double> triPositions;           ///< the input's, scaled and snapped onto planes
  std::vector<uint32_t> weld;                 ///< per tri-vertex: the lowest one at its position
  std::vector<uint8_t> dropped;               ///< per triangle
  Vec3 rounding;                              ///< one rounding per axis
  std::vector<int32_t> owner;                 ///< per half-face: its cut-cell (the first that lists it), or -1
  std::vector<int32_t> faceGridCell;   ///< 3 per face: the grid cell it lies in, on its axis the one above it; -1 if it is in no single one
  std::vector<uint32_t> cellOrder;     ///< cut-cells by grid cell, ordered z, y, x
  std::vector<uint32_t> groupOffsets;  ///< into cellOrder: one group per grid cell
  /// Whether the input may be called closed (every edge is run through equally often in both directions), and open. Both where triangles
  /// without area are all that makes the difference. By whether triangles dropped as duplicates count.
  bool mayBeClosed[2] = {true, true}, mayBeOpen[2] = {false, false};
  std::vector<int32_t> multiplicity;  ///< per triangle: sum of orientations of all with its vertices, relative to its own; empty if all 1
  std::vector<uint8_t> duplicate;     ///< per triangle: dropped, with another of its vertices that is kept or comes before; empty if none

  Vec3 vertex(uint32_t v) const { return {{positions[3 * size_t(v)], positions[3 * size_t(v) + 1], positions[3 * size_t(v) + 2]}}; }
  Vec3 triVertex(uint32_t v) const {
    return {{triPositions[3 * size_t(v)], triPositions[3 * size_t(v) + 1], triPositions[3 * size_t(v) + 2]}};
  }
  Vec3 corner(size_t triangle, int i) const { return triVertex(mesh.triangles[3 * triangle + i]); }
  Normal triangleNormal(size_t t) const { return normalOf(corner(t, 0), corner(t, 1), corner(t, 2)); }
  bool hasArea(size_t t) const { return !collinear(corner(t, 0), corner(t, 1), corner(t, 2)); }
  /// Coordinates relative to an origin, in roundings.
  Vec3 inRoundings(const Vec3& p, const Vec3& origin) const {
    return {{(p[0] - origin[0]) / rounding[0], (p[1] - origin[1]) / rounding[1], (p[2] - origin[2]) / rounding[2]}};
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
  void scale(double snapTolerance);
  void setRounding();
  void setOwners();
  void locateFaces();
  void groupCells();
  void setDuplicates();
  void setClosed();
};

/// A point known to lie in a region, for comparison with the input's own winding number.
struct Sample {
  Vec3 position;
  uint32_t region;
  const char* kind;  ///< what it lies in
  int64_t element;
};

class TriangleBins;  // bins.h

// The checks. Each adds its results in the order in which they appear in Validation.
void checkVertices(const Context& context, std::vector<Check>& checks);
void checkFaces(const Context& context, std::vector<Check>& checks);
/// Marks triangles that overlap others in one plane.
void checkSurface(const Context& context, const TriangleBins& bins, std::vector<Check>& checks, std::vector<uint8_t>& overlapping);
/// Works by grid cell. Fills in the volume of each cut-cell, and points that are known to lie in a region.
void checkGridCells(const Context& context, std::vector<Check>& checks, std::vector<double>& cellVolumes, std::vector<Sample>& samples);
void checkRegions(const Context& context, const TriangleBins& bins, std::vector<Check>& checks);
void checkWinding(const Context& context, const TriangleBins& bins, const std::vector<double>& cellVolumes,
                  const std::vector<uint8_t>& overlapping, std::vector<Sample> samples, std::vector<Check>& checks);

}  // namespace mandoline::validation

// The part of validate() that works by grid cell: one grid cell with its cut-cells, and the checks that look at it.
#pragma once

#include "operators/validate/bins.h"
#include "operators/validate/sets.h"

namespace mandoline::validation {

/// The cut-cells of one grid cell, in coordinates of that cell: 0 to 1 per axis.
struct GridCell {
  struct Face {
    uint32_t id;
    int32_t owner[2];  ///< cut-cell of side 0 and 1 if it lies in this grid cell, else -1
    uint32_t firstCorner, lastCorner;
    int side;              ///< 2 * axis + which end, if it lies in the cell's boundary, else -1
    Vec3 low, high;        ///< bounding box
    double volume;         ///< of the cone from the face to the grid cell's lowest corner
    double volumeNoise;    ///< how much of it one rounding changes
    Vec3 area, areaNoise;  ///< vector area, and the same for its components
  };
  explicit GridCell(const Context& context) : context(context), local_(context.cut.faceCount(), -1) {}
  void gather(size_t group);
  Vec3 local(const Vec3& p) const { return {{(p[0] - low[0]) / size[0], (p[1] - low[1]) / size[1], (p[2] - low[2]) / size[2]}}; }

  const Context& context;
  std::array<int32_t, 3> index{};
  Vec3 low, size;
  Vec3 noise;                       ///< one rounding
  std::span<const uint32_t> cells;  ///< its cut-cells
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
    bool forward;  ///< whether the face runs from the lower vertex to the higher one
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
  size_t binOf(double x) const { return binIndex(x * bins_, bins_); }

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

/// Lines through a grid cell pass from cut-cell to cut-cell: each point in exactly one.
class LineCheck {
 public:
  explicit LineCheck(const Context& context);
  void run(const GridCell& cell, std::vector<Sample>& samples);
  void finish(std::vector<Check>& checks);

 private:
  struct Hit {
    double low, high;      ///< where on the line it is
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

}  // namespace mandoline::validation

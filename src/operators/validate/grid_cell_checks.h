// The checks that look at one grid cell after the other. Each keeps its tallies and its buffers.
#pragma once

#include <deque>

#include "base/disjoint_sets.h"
#include "operators/validate/grid_cell.h"
#include "operators/validate/hubs.h"
#include "operators/validate/passes.h"
#include "operators/validate/spots.h"

namespace mandoline::validation {

/// What the edges of a grid cell tell.
struct CellEdges {
  std::vector<Edge> edges;      ///< ascending, without repeats
  std::vector<uint32_t> shell;  ///< per half-face (2 * face + side, by place in cell.faces): the lowest one that bounds the same shell
};

/// Around each cut-edge, faces that follow one another face the same cut-cell; edges cancel.
class EdgeCheck {
 public:
  const CellEdges& run(const GridCell& cell);
  void merge(const EdgeCheck& next);
  Check closedCells() const { return closed_.finish(); }
  Check facingFaces() const;

 private:
  struct Use {
    Edge edge;
    uint32_t face;
    bool forward;  ///< whether the face runs from the lower vertex to the higher one

    /// Orders by edge, then by face.
    std::pair<uint64_t, uint64_t> key() const { return {uint64_t(edge[0]) << 32 | edge[1], 2 * uint64_t(face) + forward}; }
  };
  void collectUses(const GridCell& cell);
  void checkCancel(const GridCell& cell, std::span<const Use> uses);
  void join(const GridCell& cell, const Use& use, const Use& next);
  bool sortByAngle(const GridCell& cell, std::span<Use> uses);
  void joinLoosely(const GridCell& cell, std::span<const Use> uses);

  std::vector<Use> uses_;
  detail::DisjointSets shells_;
  CellEdges found_;
  std::vector<std::pair<int32_t, int32_t>> directions_;
  std::vector<std::pair<double, Use>> angles_;
  uint64_t unjudged_ = 0;
  Tally closed_{"closedCells"}, facing_{"facingFaces"};
};

/// Things with numbers from 0 that are made when they are first needed.
template <class Thing>
class MadeOnce {
 public:
  void start(size_t count) { things_.clear(), places_.assign(count, kNone); }
  template <class Make>
  const Thing& at(size_t number, const Make& make) {
    if (places_[number] == kNone) {
      places_[number] = uint32_t(things_.size());
      things_.push_back(make());
    }
    return things_[places_[number]];
  }

 private:
  static constexpr uint32_t kNone = UINT32_MAX;
  std::deque<Thing> things_;  // which stay where they are
  std::vector<uint32_t> places_;
};

/// The spots of a grid cell's vertices.
class CellSpots {
 public:
  /// Starts anew.
  void start(const GridCell& cell) { spots_.start(cell.places.size()); }
  const Spot& at(const GridCell& cell, uint32_t vertex) {
    return spots_.at(cell.numbers.of(vertex), [&] { return spotOf(cell.context, vertex); });
  }

 private:
  MadeOnce<Spot> spots_;  // by number
};

/// No vertex lies inside an edge of the same grid cell.
class ConformingCheck {
 public:
  void run(const GridCell& cell, const std::vector<Edge>& edges, CellSpots& spots);
  void merge(const ConformingCheck& next) { conforming_.merge(next.conforming_); }
  Check conforming() const { return conforming_.finish(); }

 private:
  void gatherVertices(const GridCell& cell);
  void checkVertex(const GridCell& cell, const Edge& edge, uint32_t vertex, CellSpots& spots);
  static bool isBetween(const GridCell& cell, const Edge& edge, uint32_t vertex, CellSpots& spots);

  detail::BoxTree vertices_;  // of the grid cell, by place
  Tally conforming_{"conforming"};
};

/// Each grid-face is divided wherever edges on its two sides divide it.
class GridFaceCheck {
 public:
  void run(const GridCell& cell, const std::vector<Edge>& edges);
  void merge(const GridFaceCheck& next) { divided_.merge(next.divided_); }
  Check divided() const { return divided_.finish(); }

 private:
  void checkSide(const GridCell& cell, const std::vector<Edge>& edges, int side);

  std::vector<Edge> edges_;  // in the grid-face
  std::vector<uint32_t> vertices_;
  detail::DisjointSets components_;
  Tally divided_{"gridFaces"};
};

/// On which sides of one triangle's plane vertices lie: its faces are looked at one after the other, and have many vertices around them in
/// common.
class KnownSides {
 public:
  /// Starts anew, with vertices numbered below `count`.
  void start(size_t count) {
    triangle_ = -1;
    stamp_ = 0;
    known_.assign(count, {});
  }
  template <class Find>
  int at(int32_t triangle, size_t vertex, const Find& find) {
    if (triangle != triangle_) ++stamp_;
    triangle_ = triangle;
    Known& known = known_[vertex];
    if (known.stamp != stamp_) known = {stamp_, find()};
    return known.side;
  }

 private:
  struct Known {
    uint32_t stamp = 0;
    int side = 0;
  };
  int32_t triangle_ = -1;
  uint32_t stamp_ = 0;  // counts triangles
  std::vector<Known> known_;
};

/// Tri-faces and edges meet only in shared vertices and edges.
class CrossingCheck {
 public:
  void run(const GridCell& cell, const std::vector<Edge>& edges, CellSpots& spots);
  void merge(const CrossingCheck& next) { crossings_.merge(next.crossings_); }
  Check crossings() const { return crossings_.finish(); }

 private:
  /// That of a tri-face, in coordinates of the grid cell.
  struct Plane {
    Vec3 normal, origin;
    double doubt = 0;       ///< of heights over it
    uint64_t vertices = 0;  ///< sum of hashes: the same for faces with the same vertices

    double height(const Vec3& p) const { return dot(p - origin, normal); }
  };
  struct Segment {
    Edge ends;
    Vec3 from, to;
  };
  /// A vertex that may lie in the planes of two faces.
  struct Common {
    uint32_t vertex;
    Vec3 point;
  };
  static detail::Box boxOf(const Segment& segment, const Vec3& margin);
  void gatherPlanes(const GridCell& cell);
  void gatherSegments(const GridCell& cell, const std::vector<Edge>& edges);
  void buildTrees(const GridCell& cell);
  void checkAbout(const GridCell& cell, const Hubs::Hub& hub);
  void checkEdgeAndFace(const GridCell& cell, const Segment& edge, uint32_t face);
  void checkEdges(const GridCell& cell, const Segment& one, const Segment& other);
  void checkFaces(const GridCell& cell, uint32_t f, uint32_t g);
  bool gatherNear(const GridCell& cell, uint32_t face, uint32_t other);
  void sortAlongLine(const GridCell& cell);
  bool passesThrough(const GridCell& cell, const Segment& edge, double share, uint32_t face);
  bool holdsMiddle(const GridCell& cell, const Segment& points, uint32_t face);
  bool bounds(const GridCell& cell, const Edge& edge, const GridCell::Face& face) const;
  bool isInside(const GridCell& cell, const GridCell::Face& face, const Spot& point);
  int sideOf(const GridCell& cell, uint32_t vertex, double height, uint32_t face);
  const Spot& spotAt(const GridCell& cell, uint32_t vertex) { return spots_->at(cell, vertex); }
  const FinePlane& planeAt(const GridCell& cell, uint32_t face);
  static bool areKnown(const Context& context, const Edge& ends);
  bool isIn(const GridCell& cell, uint32_t vertex, uint32_t face) const;
  bool haveOnePlane(const GridCell& cell, uint32_t f, uint32_t g) const;

  Vec3 margin_;
  std::vector<Plane> planes_;  // per face, in use for tri-faces
  std::vector<Segment> segments_;
  Hubs hubs_;
  HubTree faceTree_, segmentTree_;  // of tri-faces and of segments
  detail::BoxTree directionTree_;   // of tri-faces, seen from a hub
  std::vector<Common> common_;
  CellSpots* spots_ = nullptr;
  MadeOnce<FinePlane> finePlanes_;  // of tri-faces
  KnownSides sides_;
  Tally crossings_{"crossings"};
};

/// Shells and volumes of the cut-cells of a grid cell.
class ShellCheck {
 public:
  /// Returns the volume of each of its cut-cells.
  std::vector<double> run(const GridCell& cell, const std::vector<uint32_t>& shell);
  void merge(const ShellCheck& next);
  Check connected() const { return connected_.finish(); }
  Check distinctCells() const { return distinct_.finish(); }
  Check cellVolume() const { return cellVolume_.finish(); }
  Check gridCellVolume() const { return gridCellVolume_.finish(); }
  Check gridFaceArea() const { return gridFaceArea_.finish(); }

 private:
  struct Shell {
    double volume = 0, noise = 0;
  };
  struct Cell {
    uint64_t faces = 0;  // sum of hashes: the same for cells with the same faces
    double volume = 0, noise = 0;
    int positive = 0, perhapsPositive = 0;  // shells
  };
  void sumShells(const GridCell& cell, const std::vector<uint32_t>& shell);
  void sumCells(const GridCell& cell, const std::vector<uint32_t>& shell);
  Cell& cellOf(const GridCell& cell, int32_t id);
  void checkCells(const GridCell& cell);
  void checkSides(const GridCell& cell);
  void checkDistinct(const GridCell& cell);

  std::vector<Shell> shells_;  // per half-face, in use where that stands for its shell
  std::vector<Cell> cells_;
  Tally connected_{"connected"}, distinct_{"distinctCells"};
  Tally cellVolume_{"cellVolume", kTolerance}, gridCellVolume_{"gridCellVolume", kTolerance}, gridFaceArea_{"gridFaceArea", kTolerance};
};

/// Lines through a grid cell pass from cut-cell to cut-cell: each point in exactly one.
class LineCheck {
 public:
  explicit LineCheck(const Context& context);
  void run(const GridCell& cell);
  void merge(const LineCheck& next);
  Check partition() const;
  /// Points found to lie in cut-cells.
  const std::vector<Sample>& samples() const { return samples_; }

 private:
  struct Hit {
    double low, high;      ///< where on the line it is
    int32_t below, above;  ///< the cut-cells before and after it, -1 outside the grid cell
    const GridCell::Face* face;
  };
  enum class Verdict { fine, unjudged, broken };
  bool pointOn(const GridCell& cell, const GridCell::Face& face, int axis, Vec3& point);
  void tryLine(const GridCell& cell, int axis, const GridCell::Face* through);
  Verdict shoot(const GridCell& cell, int axis, const Vec3& point);
  bool addHit(const GridCell& cell, int axis, const Vec3& point, const GridCell::Face& face);
  bool placeHit(const GridCell& cell, int axis, const Vec3& point, Hit& hit) const;
  Verdict follow(const GridCell& cell, int axis);
  void sample(const GridCell& cell, int axis, Vec3 point);

  Random random_{1};   // started anew in each grid cell
  uint64_t work_ = 0;  // edges compared with lines, in this grid cell
  uint64_t lines_ = 0, unjudged_ = 0, skipped_ = 0, stride_ = 1;
  std::vector<Hit> hits_;
  std::vector<double> cuts_;
  std::vector<Sample> samples_;
  Tally partition_{"partition"};
};

}  // namespace mandoline::validation

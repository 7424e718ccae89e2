// The cross-section is chained together from the triangles of the faces: geometry only tells which side of the plane each vertex lies on,
// how the triangles lie around an edge that several of a cell share, and which loops are holes in which.
#include "mandoline/slice.h"

#include <algorithm>
#include <cmath>

#include "operators/slice/loops.h"
#include "operators/slice/nesting.h"
#include "operators/slice/segments.h"
#include "operators/slice/slits.h"

namespace mandoline {
namespace operators {
namespace {

using GridCell = std::array<int32_t, 3>;

/// Fills in the result.
class Writer {
 public:
  Writer(const ScaledSpace& space, const CuttingPlane& plane, Slice& slice) : space_(space), plane_(plane), slice_(slice) {}

  uint32_t addPoint(const ScaledPoint& p) {
    at_.push_back(plane_.seen(p));
    for (int d = 0; d < 3; ++d) slice_.positions.push_back(space_.world(p[d]));
    return uint32_t(at_.size()) - 1;
  }
  /// Where points are, seen so that the normal points up.
  const std::vector<PlanePoint>& at() const { return at_; }

  void addLoop(std::span<const uint32_t> points) {
    slice_.loopPoints.insert(slice_.loopPoints.end(), points.begin(), points.end());
    slice_.loopOffsets.push_back(uint32_t(slice_.loopPoints.size()));
  }
  /// Adds a loop of what is to be filled, the outline first.
  void addFillLoop(std::span<const uint32_t> points) {
    triangulator_.startLoop();
    for (const uint32_t p : points) triangulator_.addCorner(p, at_[p]);
  }
  /// Ends a polygon of the loops that came since the last one.
  void endPolygon(int32_t cell, const GridCell& gridCell, uint32_t region) {
    triangulator_.run(slice_.triangles);
    slice_.polygonTriangleOffsets.push_back(uint32_t(slice_.triangles.size() / 3));
    slice_.polygonLoopOffsets.push_back(uint32_t(slice_.loopOffsets.size() - 1));
    slice_.polygonCell.push_back(cell);
    slice_.polygonGridCell.insert(slice_.polygonGridCell.end(), gridCell.begin(), gridCell.end());
    slice_.polygonRegion.push_back(region);
  }

 private:
  const ScaledSpace& space_;
  const CuttingPlane& plane_;
  Slice& slice_;
  std::vector<PlanePoint> at_;  // per point
  PolygonTriangulator triangulator_;
};

constexpr uint32_t kNone = ~0u;

/// Adds the points of the slice on edges; those at vertices are one for all edges there. Renames the ends of the segments to them.
void addPoints(const CutMesh& cutMesh, const ScaledSpace& space, const CuttingPlane& plane, SliceSegments& segments, Writer& writer) {
  std::vector<uint32_t> pointOfVertex(cutMesh.vertexCount(), kNone), pointOfEdge;
  const auto position = [&](uint32_t v) { return space.scaled(&cutMesh.positions[3 * size_t(v)]); };
  for (const auto& edge : segments.pointEdges) {
    const auto [at, end] = plane.crossing(position(edge[0]), position(edge[1]));
    if (end < 0) {
      pointOfEdge.push_back(writer.addPoint(at));
    } else {
      uint32_t& point = pointOfVertex[edge[size_t(end)]];
      if (point == kNone) point = writer.addPoint(at);
      pointOfEdge.push_back(point);
    }
  }
  for (SliceSegment& segment : segments.segments) segment = {pointOfEdge[segment[0]], pointOfEdge[segment[1]]};
}

void sliceCutCells(const CutMesh& cutMesh, const ScaledSpace& space, const CuttingPlane& plane, Writer& writer) {
  SliceSegments segments = makeSliceSegments(cutMesh, space, plane);
  addPoints(cutMesh, space, plane, segments, writer);
  SliceLoops cellLoops(cutMesh, segments, writer.at());
  SliceNesting nesting;
  SliceSlits slits;
  for (size_t c = 0; c < cutMesh.cellCount(); ++c) {
    const detail::Csr<uint32_t>& loops = cellLoops.run(c);
    if (loops.size() == 0) continue;
    const detail::Csr<uint32_t>& polygons = nesting.run(loops, writer.at());
    for (size_t p = 0; p < polygons.size(); ++p) {
      for (const uint32_t l : polygons[p]) writer.addLoop(loops[l]);
      const detail::Csr<uint32_t>& fill = slits.remove(loops, polygons[p], writer.at());
      for (size_t l = 0; l < fill.size(); ++l) writer.addFillLoop(fill[l]);
      const int32_t* gridCell = &cutMesh.cellGridCell[3 * c];
      writer.endPolygon(int32_t(c), {gridCell[0], gridCell[1], gridCell[2]}, cutMesh.cellRegion[c]);
    }
  }
}

/// Cuts grid cells as the boxes that they are.
class BoxSlicer {
 public:
  BoxSlicer(const CutMesh& cutMesh, const ScaledSpace& space, const CuttingPlane& plane, Writer& writer)
      : cutMesh_(cutMesh), plane_(plane), writer_(writer) {
    for (int d = 0; d < 3; ++d) {
      for (const double x : cutMesh.grid.planes[d]) planes_[d].push_back(space.scaled(x));
    }
  }

  void run() {
    const int32_t rows = int32_t(cutMesh_.grid.cells(1));
    for (size_t row = 0; row + 1 < cutMesh_.rowRunOffsets.size(); ++row) {
      const uint32_t first = cutMesh_.rowRunOffsets[row], last = cutMesh_.rowRunOffsets[row + 1];
      if (first == last) continue;
      GridCell gridCell = {0, int32_t(row) % rows, int32_t(row) / rows};
      const auto [begin, end] = cellsThatMeet(gridCell[1], gridCell[2]);
      for (uint32_t r = first; r < last; ++r) {
        for (int32_t i = std::max(begin, cutMesh_.runBegin[r]); i < std::min(end, cutMesh_.runEnd[r]); ++i) {
          gridCell[0] = i;
          cut(gridCell, cutMesh_.runRegion[r]);
        }
      }
    }
  }

 private:
  /// The range of grid cells of a row that have corners on both sides of the plane. Along a grid line the side changes once at most; a
  /// row's four grid lines change sides in the same sense.
  std::pair<int32_t, int32_t> cellsThatMeet(int32_t j, int32_t k) const {
    const bool sense = plane_.normal()[0] >= 0;
    int32_t least = INT32_MAX, most = 0;
    for (int32_t line = 0; line < 4; ++line) {
      const double y = planes_[1][size_t(j + line % 2)], z = planes_[2][size_t(k + line / 2)];
      const auto change = std::partition_point(planes_[0].begin(), planes_[0].end(), [&](double x) {
        return plane_.isAbove({x, y, z}) != sense;
      });
      least = std::min(least, int32_t(change - planes_[0].begin()));
      most = std::max(most, int32_t(change - planes_[0].begin()));
    }
    return {std::max(least - 1, 0), std::min(most, int32_t(planes_[0].size()) - 1)};
  }

  void cut(const GridCell& gridCell, uint32_t region) {
    std::array<ScaledPoint, 8> corners;  // bit d: on the upper plane of axis d
    std::array<bool, 8> above;
    for (size_t c = 0; c < 8; ++c) {
      for (size_t d = 0; d < 3; ++d) corners[c][d] = planes_[d][size_t(gridCell[d]) + (c >> d & 1)];
      above[c] = plane_.isAbove(corners[c]);
    }
    // On each side of the box that is cut, the way leads from the edge on which its outline goes down to that on which it goes up.
    std::array<uint8_t, 64> next;  // per edge, named by its two corners
    uint8_t start = 0;
    for (int side = 0; side < 6; ++side) {
      const int d = side / 2, upper = side % 2, u = 1 << (d + 2 - upper) % 3, v = 1 << (d + 1 + upper) % 3, base = upper << d;
      const std::array<int, 4> outline = {base, base + u, base + u + v, base + v};
      int down = -1, up = -1;
      for (size_t i = 0; i < 4; ++i) {
        const int a = outline[i], b = outline[(i + 1) % 4];
        if (above[size_t(a)] != above[size_t(b)]) (above[size_t(a)] ? down : up) = 8 * std::min(a, b) + std::max(a, b);
      }
      if (down < 0) continue;
      start = uint8_t(down);
      next[start] = uint8_t(up);
    }
    std::array<uint32_t, 8> pointOfCorner;
    pointOfCorner.fill(kNone);
    loop_.clear();
    uint8_t edge = start;
    do {
      const std::array<uint8_t, 2> ends = {uint8_t(edge / 8), uint8_t(edge % 8)};
      const auto [at, end] = plane_.crossing(corners[ends[0]], corners[ends[1]]);
      if (end < 0) {
        loop_.push_back(writer_.addPoint(at));
      } else {
        uint32_t& point = pointOfCorner[ends[size_t(end)]];
        if (point == kNone) point = writer_.addPoint(at);
        if (loop_.empty() || loop_.back() != point) loop_.push_back(point);
      }
      edge = next[edge];
    } while (edge != start);
    while (loop_.size() > 1 && loop_.back() == loop_.front()) loop_.pop_back();
    if (loop_.size() < 3) return;  // an edge or a corner
    writer_.addLoop(loop_);
    writer_.addFillLoop(loop_);
    writer_.endPolygon(-1, gridCell, region);
  }

  const CutMesh& cutMesh_;
  const CuttingPlane& plane_;
  Writer& writer_;
  std::array<std::vector<double>, 3> planes_;  // scaled
  std::vector<uint32_t> loop_;
};

Error checked(const Plane& plane) {
  const auto fail = [](int64_t element, const char* message) { return Error{Status::badOption, element, -1, message}; };
  for (int d = 0; d < 3; ++d) {
    if (!std::isfinite(plane.normal[d])) return fail(d, "The plane's normal has a component that is not finite.");
  }
  if (plane.normal == std::array<double, 3>{}) return fail(-1, "The plane's normal is zero.");
  if (!std::isfinite(plane.offset)) return fail(-1, "The plane's offset is not finite.");
  return {};
}

}  // namespace
}  // namespace operators

SliceResult slice(const CutMesh& cutMesh, const Plane& plane, const SliceOptions& options) {
  using namespace operators;
  SliceResult result;
  result.error = checked(plane);
  if (!result) return result;
  Slice& slice = result.slice;
  slice.loopOffsets = slice.polygonLoopOffsets = slice.polygonTriangleOffsets = {0};
  const ScaledSpace space(cutMesh.grid);
  const std::optional<CuttingPlane> cutting = CuttingPlane::make(plane, cutMesh.grid, space);
  if (!cutting) return result;
  Writer writer(space, *cutting, slice);
  sliceCutCells(cutMesh, space, *cutting, writer);
  if (options.untouched) BoxSlicer(cutMesh, space, *cutting, writer).run();
  return result;
}

}  // namespace mandoline

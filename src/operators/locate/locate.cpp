// A point's cut-cell is the one whose closed triangle surface winds around it: a ray runs upwards from the point, and every triangle that
// it meets adds to the winding number of the cell below and takes from that of the cell above.
//
// The point is moved by less than anything, first along z, then far less along x, then far less along y (simulation of simplicity), into
// the grid cell where it lies on the grid cell's border. So the ray meets no edge and the point lies on no triangle. Together, the surfaces
// of a grid cell's cut-cells are the surface of its box, so the winding numbers add up to 1: some cell has a positive one, even where
// rounded positions let cells overlap.
#include "mandoline/locate.h"

#include <algorithm>
#include <cmath>
#include <tuple>

#include "base/csr.h"
#include "grid/scaled_space.h"
#include "operators/triangulate/face_triangulator.h"

namespace mandoline {
namespace operators {
namespace {

constexpr int kRight = 0, kUp = 1, kRay = 2;  // axes: the ray's, and those of the plane that it is seen in as a point
constexpr uint32_t kNone = ~0u;

using GridCell = std::array<int32_t, 3>;

/// A point and the signs of its moves.
struct MovedPoint {
  ScaledPoint at;
  std::array<int, 3> move;
};

/// A triangle and the cut-cells of the grid cell on its two sides, as places in that grid cell; kNone outside.
struct Wall {
  std::array<ScaledPoint, 3> corners;
  std::array<uint32_t, 2> places;
};

/// How often the triangle winds around the point, seen along the ray: 1 or -1 if the point lies inside, as the triangle turns.
int windingInView(const Wall& wall, const MovedPoint& p, Predicates& predicates) {
  const auto isAbove = [&](const ScaledPoint& q) { return q[kUp] > p.at[kUp] || (q[kUp] == p.at[kUp] && p.move[kUp] < 0); };
  int winding = 0;
  for (int i = 0; i < 3; ++i) {
    const ScaledPoint &a = wall.corners[i], &b = wall.corners[(i + 1) % 3];
    const int direction = int(isAbove(b)) - int(isAbove(a));
    if (direction == 0) continue;
    int side = predicates.orient2d({a[kRight], a[kUp]}, {b[kRight], b[kUp]}, {p.at[kRight], p.at[kUp]});
    if (side == 0) side = -direction * p.move[kRight];  // to the right of an edge that goes up
    if (side == direction) winding += direction;
  }
  return winding;
}

/// What the triangle adds to the winding number of the cell on its side 0.
int windingOf(const Wall& wall, const MovedPoint& p, Predicates& predicates) {
  const auto& [a, b, c] = wall.corners;
  const double x = p.at[kRight], y = p.at[kUp];
  if (std::max({a[kRight], b[kRight], c[kRight]}) < x || std::min({a[kRight], b[kRight], c[kRight]}) > x) return 0;
  if (std::max({a[kUp], b[kUp], c[kUp]}) < y || std::min({a[kUp], b[kUp], c[kUp]}) > y) return 0;
  if (std::max({a[kRay], b[kRay], c[kRay]}) < p.at[kRay]) return 0;
  const int winding = windingInView(wall, p, predicates);
  if (winding == 0) return 0;
  int side = winding * predicates.orient3d(a.data(), b.data(), c.data(), p.at.data());
  if (side == 0) side = p.move[kRay];
  return side < 0 ? winding : 0;
}

/// The triangles of a grid cell's cut-cells in square bins, seen along the ray.
class Walls {
 public:
  Walls(const CutMesh& cutMesh, const ScaledSpace& space) : cutMesh_(cutMesh), space_(space), triangulator_(cutMesh) {}

  /// Loads the cut-cells firstCell .. lastCell - 1, which are all of the grid cell, to be asked about some number of points.
  void load(const GridCell& gridCell, size_t firstCell, size_t lastCell, size_t points) {
    gatherFaces(firstCell, lastCell);
    winding_.assign(lastCell - firstCell, 0);
    for (int d = 0; d < 3; ++d) {
      low_[d] = space_.scaled(cutMesh_.grid.planes[d][size_t(gridCell[d])]);
      high_[d] = space_.scaled(cutMesh_.grid.planes[d][size_t(gridCell[d]) + 1]);
    }
    makeBins(points);
  }

  /// The place of the cut-cell that holds a point of the grid cell; kNone only if the cut-mesh is not valid.
  uint32_t cellAt(const double* point) {
    MovedPoint p = {space_.scaled(point), {}};
    for (int d = 0; d < 3; ++d) p.move[d] = p.at[d] == high_[d] ? -1 : 1;
    for (const uint32_t w : bins_[binOf(p.at, kRight) + size_t(binCount_) * binOf(p.at, kUp)]) {
      const int winding = windingOf(walls_[w], p, predicates_);
      if (winding == 0) continue;
      add(walls_[w].places[0], winding);
      add(walls_[w].places[1], -winding);
    }
    uint32_t found = kNone;
    for (const uint32_t place : met_) {
      if (winding_[place] > 0) found = std::min(found, place);
      winding_[place] = 0;
    }
    met_.clear();
    return found;
  }

 private:
  struct HalfFace {
    uint32_t halfFace, place;
  };

  void add(uint32_t place, int winding) {
    if (place == kNone) return;
    winding_[place] += winding;
    met_.push_back(place);
  }

  void gatherFaces(size_t firstCell, size_t lastCell) {
    halfFaces_.clear();
    walls_.clear();
    for (size_t c = firstCell; c < lastCell; ++c) {
      for (const uint32_t h : cutMesh_.halfFaces(c)) halfFaces_.push_back({h, uint32_t(c - firstCell)});
    }
    std::sort(halfFaces_.begin(), halfFaces_.end(), [](const HalfFace& a, const HalfFace& b) { return a.halfFace < b.halfFace; });
    for (size_t i = 0; i < halfFaces_.size(); ++i) {
      const uint32_t face = halfFaces_[i].halfFace / 2;
      std::array<uint32_t, 2> places = {kNone, kNone};
      places[halfFaces_[i].halfFace % 2] = halfFaces_[i].place;
      if (i + 1 < halfFaces_.size() && halfFaces_[i + 1].halfFace / 2 == face) places[1] = halfFaces_[++i].place;
      if (places[0] != places[1]) addWalls(face, places);
    }
  }

  void addWalls(uint32_t face, const std::array<uint32_t, 2>& places) {
    triangles_.clear();
    triangulator_.run(face, triangles_);
    for (size_t t = 0; t < triangles_.size(); t += 3) {
      Wall& wall = walls_.emplace_back();
      for (int i = 0; i < 3; ++i) wall.corners[i] = space_.scaled(&cutMesh_.positions[3 * size_t(triangles_[t + i])]);
      wall.places = places;
    }
  }

  uint32_t binOf(const ScaledPoint& p, int axis) const {
    return uint32_t(std::clamp((p[axis] - low_[axis]) / (high_[axis] - low_[axis]) * binCount_, 0.0, binCount_ - 1.0));
  }

  /// f(bin) for the bins of a triangle's bounding box.
  template <class F>
  void forBins(const Wall& wall, const F& f) const {
    const auto range = [&](int axis) {
      const uint32_t a = binOf(wall.corners[0], axis), b = binOf(wall.corners[1], axis), c = binOf(wall.corners[2], axis);
      return std::pair(std::min({a, b, c}), std::max({a, b, c}));
    };
    const std::pair<uint32_t, uint32_t> x = range(kRight), y = range(kUp);
    for (uint32_t j = y.first; j <= y.second; ++j) {
      for (uint32_t i = x.first; i <= x.second; ++i) f(i + size_t(binCount_) * j);
    }
  }

  size_t binEntries() const {
    size_t count = 0;
    for (const Wall& wall : walls_) forBins(wall, [&](size_t) { ++count; });
    return count;
  }

  /// As many bins as there are triangles or points, but fewer if triangles would lie in many.
  void makeBins(size_t points) {
    constexpr size_t kEntriesPerTriangle = 8;
    binCount_ = uint32_t(std::clamp(std::sqrt(double(std::min(points, walls_.size()))), 1.0, 1024.0));
    while (binCount_ > 1 && binEntries() > kEntriesPerTriangle * walls_.size()) binCount_ /= 2;
    std::vector<detail::KeyedItem> entries;
    for (uint32_t w = 0; w < walls_.size(); ++w) {
      forBins(walls_[w], [&](size_t bin) { entries.push_back({bin, w}); });
    }
    bins_ = detail::groupBy<uint32_t>(
        size_t(binCount_) * binCount_, entries.size(), [&](size_t i) { return size_t(entries[i].key); },
        [&](size_t i) { return entries[i].item; });
  }

  const CutMesh& cutMesh_;
  const ScaledSpace& space_;
  FaceTriangulator triangulator_;
  Predicates predicates_;
  std::vector<HalfFace> halfFaces_;
  std::vector<uint32_t> triangles_;
  std::vector<Wall> walls_;
  uint32_t binCount_ = 1;
  ScaledPoint low_{}, high_{};
  detail::Csr<uint32_t> bins_;
  std::vector<int> winding_;   // per place
  std::vector<uint32_t> met_;  // places with a wall above the point
};

/// The grid cell of a point; false outside.
bool findGridCell(const Grid& grid, const double* point, GridCell& gridCell) {
  for (int d = 0; d < 3; ++d) {
    const std::vector<double>& planes = grid.planes[d];
    if (planes.size() < 2 || !(point[d] >= planes.front() && point[d] <= planes.back())) return false;
    const auto next = std::upper_bound(planes.begin(), planes.end() - 1, point[d]);
    gridCell[d] = int32_t(next - planes.begin()) - 1;
  }
  return true;
}

/// The region of an untouched grid cell, or -1.
int32_t regionOfUntouched(const CutMesh& cutMesh, const GridCell& gridCell) {
  const size_t row = size_t(gridCell[2]) * size_t(cutMesh.grid.cells(1)) + size_t(gridCell[1]);
  const auto first = cutMesh.runEnd.begin() + cutMesh.rowRunOffsets[row], last = cutMesh.runEnd.begin() + cutMesh.rowRunOffsets[row + 1];
  const size_t run = size_t(std::upper_bound(first, last, gridCell[0]) - cutMesh.runEnd.begin());
  const bool inRun = run < cutMesh.rowRunOffsets[row + 1] && cutMesh.runBegin[run] <= gridCell[0];
  return inRun ? int32_t(cutMesh.runRegion[run]) : -1;
}

/// Order of grid cells in which cut() makes cut-cells.
bool precedes(const int32_t* a, const int32_t* b) { return std::tie(a[2], a[1], a[0]) < std::tie(b[2], b[1], b[0]); }

/// The first cut-cell whose grid cell does not precede a grid cell.
size_t firstCellFrom(const CutMesh& cutMesh, const int32_t* gridCell) {
  size_t begin = 0, end = cutMesh.cellCount();
  while (begin < end) {
    const size_t middle = begin + (end - begin) / 2;
    if (precedes(&cutMesh.cellGridCell[3 * middle], gridCell)) {
      begin = middle + 1;
    } else {
      end = middle;
    }
  }
  return begin;
}

/// Fills in the cut-cells of points of one grid cell.
void locateInCutCells(const CutMesh& cutMesh, std::span<const double> points, std::span<const uint32_t> group, Walls& walls,
                      Locations& result) {
  const GridCell gridCell = {result.gridCell[3 * size_t(group[0])], result.gridCell[3 * size_t(group[0]) + 1],
                             result.gridCell[3 * size_t(group[0]) + 2]};
  const size_t first = firstCellFrom(cutMesh, gridCell.data());
  size_t last = first;
  while (last < cutMesh.cellCount() && std::equal(gridCell.begin(), gridCell.end(), &cutMesh.cellGridCell[3 * last])) ++last;
  walls.load(gridCell, first, last, group.size());
  for (const uint32_t i : group) {
    const uint32_t place = walls.cellAt(&points[3 * size_t(i)]);
    if (place == kNone) continue;
    result.cell[i] = int32_t(first + place);
    result.region[i] = int32_t(cutMesh.cellRegion[first + place]);
  }
}

}  // namespace
}  // namespace operators

Locations locate(const CutMesh& cutMesh, std::span<const double> points) {
  using namespace operators;
  const size_t count = points.size() / 3;
  Locations result;
  result.cell.assign(count, -1);
  result.gridCell.assign(3 * count, -1);
  result.region.assign(count, -1);
  std::vector<uint32_t> cut;  // points in cut grid cells
  for (size_t i = 0; i < count; ++i) {
    GridCell gridCell;
    if (!findGridCell(cutMesh.grid, &points[3 * i], gridCell)) continue;
    std::copy(gridCell.begin(), gridCell.end(), &result.gridCell[3 * i]);
    result.region[i] = regionOfUntouched(cutMesh, gridCell);
    if (result.region[i] < 0) cut.push_back(uint32_t(i));
  }

  const auto gridCellOf = [&](uint32_t i) { return &result.gridCell[3 * size_t(i)]; };
  std::sort(cut.begin(), cut.end(), [&](uint32_t a, uint32_t b) { return precedes(gridCellOf(a), gridCellOf(b)); });
  const ScaledSpace space(cutMesh.grid);
  Walls walls(cutMesh, space);
  for (size_t begin = 0, end; begin < cut.size(); begin = end) {
    end = begin + 1;
    while (end < cut.size() && !precedes(gridCellOf(cut[begin]), gridCellOf(cut[end]))) ++end;
    locateInCutCells(cutMesh, points, std::span(cut).subspan(begin, end - begin), walls, result);
  }
  return result;
}

}  // namespace mandoline

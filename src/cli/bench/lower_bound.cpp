// The lower bound of the benchmark: the least that every cutter has to do. Clips each triangle at the axial planes that it crosses and
// sorts the pieces by grid cell, in plain doubles: no exactness, no shared vertices, no grid-faces, no cells.
//
//   mandoline-lower-bound MESH N
//
// clips once, on one thread, and prints the processor time in ms (with page faults, without reading the file), then the numbers of pieces
// and of grid cells that hold any. The grid cells are those of mandoline's default, in a cube of N per axis.
#include <algorithm>
#include <array>
#include <charconv>
#include <iostream>
#include <limits>
#include <stdexcept>
#include <string>
#include <vector>

#include "cli/bench/cold_start.h"
#include "mandoline/io.h"

namespace mandoline::bench {
namespace {

using Point = std::array<double, 3>;

/// A convex piece of a triangle: each of a grid cell's planes adds a corner at most. Rounding may bend a piece so that a plane adds more;
/// corners beyond the room for them are left out.
struct Polygon {
  static constexpr int kMostCorners = 3 + 6;
  Point corners[kMostCorners];
  int size = 0;

  void add(const Point& p) {
    if (size < kMostCorners) corners[size++] = p;
  }
};

/// Piece p has corners offsets[p] .. offsets[p + 1] - 1.
struct Pieces {
  std::vector<double> positions;  ///< 3 per corner
  std::vector<uint32_t> offsets = {0}, cell, triangle;

  explicit Pieces(size_t triangleCount) {
    positions.reserve(24 * triangleCount);
    for (std::vector<uint32_t>* items : {&offsets, &cell, &triangle}) items->reserve(2 * triangleCount);
  }
  void add(const Polygon& polygon, uint32_t inCell, uint32_t ofTriangle) {
    const double* first = polygon.corners[0].data();
    positions.insert(positions.end(), first, first + 3 * polygon.size);
    offsets.push_back(uint32_t(positions.size() / 3));
    cell.push_back(inCell);
    triangle.push_back(ofTriangle);
  }
};

/// Pieces begin[c] .. begin[c + 1] - 1 of the order lie in cell c.
struct SortedPieces {
  std::vector<uint32_t> begin, order;
};

/// The part of the polygon below the plane goes to `below`, the rest stays.
template <int axis>
void takeBelow(Polygon& polygon, double plane, Polygon& below) {
  Polygon above;
  below.size = 0;
  const Point* a = &polygon.corners[polygon.size - 1];
  for (int i = 0; i < polygon.size; ++i) {
    const Point* b = &polygon.corners[i];
    const double fromA = (*a)[axis] - plane, fromB = (*b)[axis] - plane;
    if ((fromA < 0) != (fromB < 0)) {
      const double t = fromA / (fromA - fromB);
      Point crossing;
      for (int d = 0; d < 3; ++d) crossing[d] = (*a)[d] + t * ((*b)[d] - (*a)[d]);
      crossing[axis] = plane;
      below.add(crossing);
      above.add(crossing);
    }
    (fromB < 0 ? below : above).add(*b);
    a = b;
  }
  polygon = above;
}

class Clipper {
 public:
  Clipper(const Grid& grid, Pieces& pieces) : grid_(grid), pieces_(pieces) {}

  void clip(const Mesh& mesh, uint32_t triangle) {
    Polygon polygon;
    for (int k = 0; k < 3; ++k) {
      const double* p = &mesh.positions[3 * size_t(mesh.triangles[3 * size_t(triangle) + k])];
      polygon.add({p[0], p[1], p[2]});
    }
    triangle_ = triangle;
    clipAlong<2>(polygon, 0);
  }

 private:
  /// Clips into slabs along the axis, and these along the axes before it; `cell` counts in cells of the axes after it.
  template <int axis>
  void clipAlong(Polygon polygon, uint32_t cell) {
    double low = polygon.corners[0][axis], high = low;
    for (int i = 1; i < polygon.size; ++i) {
      low = std::min(low, polygon.corners[i][axis]);
      high = std::max(high, polygon.corners[i][axis]);
    }
    const std::vector<double>& planes = grid_.planes[axis];
    const int first = slabOf<axis>(low), last = slabOf<axis>(high);
    Polygon below;
    for (int slab = first; slab < last; ++slab) {
      takeBelow<axis>(polygon, planes[slab + 1], below);
      enter<axis>(below, cell, slab);
    }
    enter<axis>(polygon, cell, last);
  }

  template <int axis>
  void enter(const Polygon& piece, uint32_t cell, int slab) {
    if (piece.size < 3) return;
    const uint32_t inSlab = cell * uint32_t(grid_.cells(axis)) + uint32_t(slab);
    if constexpr (axis > 0)
      clipAlong<axis - 1>(piece, inSlab);
    else
      pieces_.add(piece, inSlab, triangle_);
  }

  /// The slab with planes[slab] <= x < planes[slab + 1].
  template <int axis>
  int slabOf(double x) const {
    const std::vector<double>& planes = grid_.planes[axis];
    int slab = int((x - grid_.origin[axis]) / grid_.spacing[axis]);
    while (x < planes[slab]) --slab;
    while (x >= planes[slab + 1]) ++slab;
    return slab;
  }

  const Grid& grid_;
  Pieces& pieces_;
  uint32_t triangle_ = 0;
};

SortedPieces sortByCell(const Pieces& pieces, size_t cellCount) {
  SortedPieces sorted{std::vector<uint32_t>(cellCount + 1), std::vector<uint32_t>(pieces.cell.size())};
  for (const uint32_t c : pieces.cell) ++sorted.begin[c + 1];
  for (size_t c = 0; c < cellCount; ++c) sorted.begin[c + 1] += sorted.begin[c];
  std::vector<uint32_t> next(sorted.begin.begin(), sorted.begin.end() - 1);
  for (uint32_t piece = 0; piece < pieces.cell.size(); ++piece) sorted.order[next[pieces.cell[piece]]++] = piece;
  return sorted;
}

Grid cubeAround(const Mesh& mesh, int64_t n) {
  Point min, max;
  min.fill(std::numeric_limits<double>::infinity());
  max.fill(-std::numeric_limits<double>::infinity());
  for (const uint32_t v : mesh.triangles) {
    for (int d = 0; d < 3; ++d) {
      min[d] = std::min(min[d], mesh.positions[3 * size_t(v) + d]);
      max[d] = std::max(max[d], mesh.positions[3 * size_t(v) + d]);
    }
  }
  const double side = 1.1 * std::max({max[0] - min[0], max[1] - min[1], max[2] - min[2]}), spacing = side / double(n);
  Point origin;
  for (int d = 0; d < 3; ++d) origin[d] = (min[d] + max[d] - side) / 2;
  if (!(spacing > 0)) throw std::runtime_error("the mesh has no size");
  return Grid::regular(origin, {spacing, spacing, spacing}, {n, n, n});
}

void run(const std::string& path, const std::string& cells) {
  constexpr int64_t kMostCells = 1024;  // per axis, so that grid cells have ids of 32 bits
  int64_t n = 0;
  std::from_chars(cells.data(), cells.data() + cells.size(), n);
  if (n < 1 || n > kMostCells) throw std::runtime_error("N must be 1 to " + std::to_string(kMostCells) + ", not " + cells);
  const Mesh mesh = readMesh(path);
  const Grid grid = cubeAround(mesh, n);

  returnFreePages();
  const double start = processorMs();
  Pieces pieces(mesh.triangleCount());
  Clipper clipper(grid, pieces);
  for (uint32_t t = 0; t < mesh.triangleCount(); ++t) clipper.clip(mesh, t);
  const SortedPieces sorted = sortByCell(pieces, size_t(n * n * n));
  const double ms = processorMs() - start;

  size_t cellCount = 0;
  for (size_t c = 0; c + 1 < sorted.begin.size(); ++c) cellCount += sorted.begin[c + 1] > sorted.begin[c];
  std::cout << ms << ' ' << sorted.order.size() << ' ' << cellCount << '\n';
}

}  // namespace
}  // namespace mandoline::bench

int main(int argc, char** argv) {
  if (argc != 3) {
    std::cerr << "usage: mandoline-lower-bound MESH N\n";
    return 2;
  }
  try {
    mandoline::bench::run(argv[1], argv[2]);
    return 0;
  } catch (const std::exception& error) {
    std::cerr << "mandoline-lower-bound: " << error.what() << '\n';
    return 1;
  }
}

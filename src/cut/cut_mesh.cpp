#include "mandoline/cut_mesh.h"

#include <algorithm>
#include <cstdint>
#include <new>
#include <tuple>

namespace mandoline {

IdRange CutMesh::cutCellsAt(int64_t i, int64_t j, int64_t k) const {
  if (i < 0 || i >= grid.cells(0)) return {0, 0};
  const auto firstNotBefore = [&](int64_t x) {
    size_t begin = 0, end = cellCount();
    while (begin < end) {
      const size_t middle = begin + (end - begin) / 2;
      const int32_t* at = &cellGridCell[3 * middle];
      if (std::tuple<int64_t, int64_t, int64_t>(at[2], at[1], at[0]) < std::tuple(k, j, x)) {
        begin = middle + 1;
      } else {
        end = middle;
      }
    }
    return begin;
  };
  return {firstNotBefore(i), firstNotBefore(i + 1)};
}

std::vector<int32_t> CutMesh::gridCellRegion() const {
  const double count = double(grid.cells(0)) * double(grid.cells(1)) * double(grid.cells(2));
  if (count > double(PTRDIFF_MAX)) throw std::bad_alloc();
  std::vector<int32_t> dense(size_t(count), -1);
  const int64_t nx = grid.cells(0), ny = grid.cells(1);
  UntouchedCells(*this).forEach([&](const UntouchedCells::Run& run) {
    const auto row = dense.begin() + nx * (run.j + ny * run.k);
    std::fill(row + run.begin, row + run.end, int32_t(run.region));
  });
  return dense;
}

uint64_t UntouchedCells::count() const {
  uint64_t count = 0;
  for (size_t r = 0; r < cutMesh_.runBegin.size(); ++r) count += uint64_t(cutMesh_.runEnd[r] - cutMesh_.runBegin[r]);
  return count;
}

int64_t UntouchedCells::find(int64_t i, int64_t j, int64_t k) const {
  const Grid& grid = cutMesh_.grid;
  if (i < 0 || j < 0 || k < 0 || i >= grid.cells(0) || j >= grid.cells(1) || k >= grid.cells(2)) return -1;
  const size_t row = size_t(k * grid.cells(1) + j);
  if (row + 1 >= cutMesh_.rowRunOffsets.size()) return -1;
  const auto first = cutMesh_.runEnd.begin() + cutMesh_.rowRunOffsets[row],
             last = cutMesh_.runEnd.begin() + cutMesh_.rowRunOffsets[row + 1];
  const auto run = std::upper_bound(first, last, i);
  const auto r = run - cutMesh_.runEnd.begin();
  return run != last && cutMesh_.runBegin[size_t(r)] <= i ? r : -1;
}

double UntouchedCells::volume(const Run& run) const {
  const auto& planes = cutMesh_.grid.planes;
  const auto side = [&](int axis, int32_t begin, int32_t end) {
    return planes[size_t(axis)][size_t(end)] - planes[size_t(axis)][size_t(begin)];
  };
  return side(0, run.begin, run.end) * side(1, run.j, run.j + 1) * side(2, run.k, run.k + 1);
}

double UntouchedCells::volume() const {
  double sum = 0;
  forEach([&](const Run& run) { sum += volume(run); });
  return sum;
}

CutCounts countsOf(const CutMesh& cutMesh) {
  return {cutMesh.cellCount(), UntouchedCells(cutMesh).count(), cutMesh.regionCount, cutMesh.vertexCount(), cutMesh.faceCount(),
          cutMesh.loopCount()};
}

}  // namespace mandoline

// Whether a cell complex is conforming, which follows from sums of its directed edges and of its areas.
#pragma once

#include <algorithm>
#include <cmath>
#include <tuple>

#include "catch.h"
#include "mandoline/cell_complex.h"
#include "mandoline/measure.h"
#include "mandoline/validate.h"

/// The directed edges of each cell's faces cancel: the boundary of its boundary is empty. So faces leave no gap, and edges have all
/// vertices that lie on them.
inline void requireClosedCells(const mandoline::CellComplex& cells) {
  struct Directed {
    uint32_t low, high;
    int sense;
    bool operator<(const Directed& e) const { return std::tie(low, high) < std::tie(e.low, e.high); }
  };
  std::vector<Directed> edges;
  for (size_t c = 0; c < cells.cellCount(); ++c) {
    edges.clear();
    for (const uint32_t h : cells.halfFaces(c)) {
      for (const auto loop : cells.loops(h / 2)) {
        for (size_t i = 0; i < loop.size(); ++i) {
          const uint32_t a = loop[i], b = loop[i + 1 < loop.size() ? i + 1 : 0];
          edges.push_back({std::min(a, b), std::max(a, b), (a < b) == (h % 2 == 0) ? 1 : -1});
        }
      }
    }
    std::sort(edges.begin(), edges.end());
    bool closed = true;
    for (size_t i = 0; i < edges.size();) {
      int sum = 0;
      for (const Directed first = edges[i]; i < edges.size() && !(first < edges[i]); ++i) sum += edges[i].sense;
      closed &= sum == 0;
    }
    CAPTURE(c);
    REQUIRE(closed);
  }
}

/// Each cell's areas, pointing outwards, have the sum zero, and give its volume by the divergence theorem; volumes per region are those of
/// the cut-mesh.
inline void requireAreasAndVolumes(const mandoline::CellComplex& cells, const mandoline::Mesh& mesh, const mandoline::CutMesh& cutMesh) {
  double size = 0;
  for (const auto& planes : cutMesh.grid.planes) size = std::max(size, planes.back() - planes.front());
  std::vector<double> volumes(cutMesh.regionCount);
  for (size_t c = 0; c < cells.cellCount(); ++c) {
    double sum[3] = {}, volume = 0, area = 0;
    for (const uint32_t h : cells.halfFaces(c)) {
      const size_t f = h / 2;
      const double outwards = h % 2 == 0 ? 1 : -1;
      area += cells.faceArea[f];
      for (size_t d = 0; d < 3; ++d) {
        const double part = outwards * cells.faceArea[f] * cells.faceNormal[3 * f + d];
        sum[d] += part;
        volume += part * (cells.faceCentroid[3 * f + d] - cells.cellCentroid[3 * c + d]) / 3;
      }
    }
    CAPTURE(c, cells.cutCells, area, volume, cells.cellVolume[c]);
    REQUIRE(std::max({std::fabs(sum[0]), std::fabs(sum[1]), std::fabs(sum[2])}) <= 1e-13 * size * size);
    REQUIRE(std::fabs(volume - cells.cellVolume[c]) <= 1e-13 * size * size * size);
    volumes[cells.cellRegion[c]] += cells.cellVolume[c];
  }
  const std::vector<double> expected = mandoline::regionVolumes(cutMesh, mandoline::measure(mesh, cutMesh));
  for (size_t r = 0; r < volumes.size(); ++r) REQUIRE(volumes[r] == Approx(expected[r]).epsilon(1e-12));
}

/// Cells on both sides of a face differ by one level at most; cut-cells count as cells of level 0.
inline void requireBalance(const mandoline::CellComplex& cells, const mandoline::OctreeCells& octree) {
  const auto levelOf = [&](int32_t c) { return uint32_t(c) < cells.cutCells ? 0 : int(octree.cellLevel[size_t(c) - cells.cutCells]); };
  for (size_t f = 0; f < cells.faceCount(); ++f) {
    const int32_t front = cells.faceCells[2 * f], back = cells.faceCells[2 * f + 1];
    if (front >= 0 && back >= 0) REQUIRE(std::abs(levelOf(front) - levelOf(back)) <= 1);
  }
}

/// The cell complex of a cut-mesh, which holds all of the above.
inline mandoline::CellComplex checkedComplex(const mandoline::Mesh& mesh, const mandoline::CutMesh& cutMesh,
                                             const mandoline::CoarsenOptions& options = {}) {
  const mandoline::OctreeCells octree = mandoline::coarsen(cutMesh, options);
  const mandoline::CellComplex cells = mandoline::cellComplex(mesh, cutMesh, octree);
  REQUIRE(cells.cellCount() == cutMesh.cellCount() + octree.cellCount());
  REQUIRE(mandoline::checkArrays(cells).message.empty());
  requireClosedCells(cells);
  requireAreasAndVolumes(cells, mesh, cutMesh);
  requireBalance(cells, octree);
  return cells;
}

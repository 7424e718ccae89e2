#include "cut/stages/regions.h"

#include "base/disjoint_sets.h"
#include "cut/stages/winding.h"

namespace mandoline::detail {
namespace {

/// The runs of grid cells between those of the stencil, row by row.
void findRuns(const Input& input, const Stencil& stencil, Regions& regions, Monitor& monitor) {
  const size_t rows = size_t(input.cells(1)) * size_t(input.cells(2));
  regions.rowRunOffsets.assign(1, 0);
  regions.rowRunOffsets.reserve(rows + 1);
  const std::vector<Stencil::Cell>& cells = stencil.cells;
  size_t c = 0;
  const auto addRun = [&](int32_t begin, int32_t end) {
    if (begin >= end) return;
    regions.runBegin.push_back(begin);
    regions.runEnd.push_back(end);
  };
  for (int32_t k = 0; k < input.cells(2); ++k) {
    for (int32_t j = 0; j < input.cells(1); ++j) {
      int32_t from = 0;
      for (; c < cells.size() && cells[c].at(1) == j && cells[c].at(2) == k; ++c) {
        addRun(from, cells[c].at(0));
        from = cells[c].at(0) + 1;
      }
      addRun(from, input.cells(0));
      regions.rowRunOffsets.push_back(uint32_t(regions.runBegin.size()));
    }
    monitor.report(size_t(k), size_t(input.cells(2)));
  }
}

/// The run that holds an untouched grid cell.
uint32_t runAt(const Input& input, const Regions& regions, const Slab& cell) {
  const size_t row = size_t(cell[2] >> 1) * size_t(input.cells(1)) + size_t(cell[1] >> 1);
  const auto first = regions.runEnd.begin() + regions.rowRunOffsets[row], past = regions.runEnd.begin() + regions.rowRunOffsets[row + 1];
  return uint32_t(std::upper_bound(first, past, cell[0] >> 1) - regions.runEnd.begin());
}

/// Joins nodes into regions. Nodes are the cut-cells, then the runs.
class RegionFinder {
 public:
  RegionFinder(const Input& input, const Sides& sides, Regions& regions)
      : input_(input),
        sides_(sides),
        regions_(regions),
        firstRun_(uint32_t(sides.cells.size())),
        nodes_(firstRun_ + regions.runBegin.size()) {}

  void run() {
    uniteRuns();
    for (size_t piece = 0; piece < sides_.faces.grid.size(); ++piece) uniteAcross(piece);
    number();
  }

 private:
  /// Joins runs that lie beside each other along y and z.
  void uniteRuns() {
    const size_t ny = size_t(input_.cells(1)), rows = ny * size_t(input_.cells(2));
    for (size_t r = 0; r < rows; ++r) {
      if (r % ny > 0) uniteRows(r - 1, r);
      if (r >= ny) uniteRows(r - ny, r);
    }
  }

  void uniteRows(size_t r, size_t s) {
    const std::vector<uint32_t>& offsets = regions_.rowRunOffsets;
    const std::vector<int32_t>&begin = regions_.runBegin, &end = regions_.runEnd;
    for (uint32_t a = offsets[r], b = offsets[s]; a < offsets[r + 1] && b < offsets[s + 1];) {
      if (std::max(begin[a], begin[b]) < std::min(end[a], end[b])) nodes_.unite(firstRun_ + a, firstRun_ + b);
      end[a] < end[b] ? ++a : ++b;
    }
  }

  /// A piece of a grid-face joins what lies on its two sides.
  void uniteAcross(size_t piece) {
    const FaceId face = sides_.faces.ofPiece(piece);
    const CellId below = sides_.cell(HalfFace(face, 0)), above = sides_.cell(HalfFace(face, 1));
    if (below != Sides::kNone && above != Sides::kNone) return nodes_.unite(below.number, above.number);
    const Stencil::Face& place = sides_.stencil.faces[sides_.faces.grid.gridFaces[piece]];
    Slab other = sides_.stencil.cells[place.cell].element;  // the first cell that has it, so the other side is the untouched one
    other[place.axis()] += place.side() == 1 ? 2 : -2;
    if (input_.inGrid(other)) nodes_.unite((below != Sides::kNone ? below : above).number, firstRun_ + runAt(input_, regions_, other));
  }

  /// In the order of their first grid cells.
  void number() {
    regionOf_.assign(firstRun_ + regions_.runBegin.size(), kUnset);
    regions_.cellRegion.resize(firstRun_);
    regions_.runRegion.resize(regions_.runBegin.size());
    CellId cell{0};
    for (size_t row = 0; row + 1 < regions_.rowRunOffsets.size(); ++row) {
      const uint32_t past = regions_.rowRunOffsets[row + 1];
      for (uint32_t run = regions_.rowRunOffsets[row]; run < past || isInRow(cell, row);) {
        if (run < past && (!isInRow(cell, row) || regions_.runBegin[run] < gridCellOf(cell).at(0))) {
          regions_.runRegion[run] = label(firstRun_ + run);
          ++run;
        } else {
          regions_.cellRegion[cell] = label(cell.number);
          ++cell.number;
        }
      }
    }
  }

  const Stencil::Cell& gridCellOf(CellId cell) const { return sides_.stencil.cells[sides_.cells.gridCells[cell]]; }
  bool isInRow(CellId cell, size_t row) const {
    return cell.number < firstRun_ && size_t(gridCellOf(cell).at(2)) * size_t(input_.cells(1)) + size_t(gridCellOf(cell).at(1)) == row;
  }
  uint32_t label(uint32_t node) {
    uint32_t& region = regionOf_[nodes_.find(node)];
    if (region == kUnset) region = regions_.count++;
    return region;
  }

  static constexpr uint32_t kUnset = ~0u;

  const Input& input_;
  const Sides& sides_;
  Regions& regions_;
  uint32_t firstRun_;
  DisjointSets nodes_;
  std::vector<uint32_t> regionOf_;  // per root
};

}  // namespace

Regions findRegions(const Surface& surface, const Stencil& stencil, const CutFaces& faces, const CutCells& cells, Run& run) {
  Regions regions;
  findRuns(surface.input, stencil, regions, run.monitor);
  const Sides sides(stencil, faces, cells);
  RegionFinder(surface.input, sides, regions).run();
  Predicates predicates;
  findWinding(surface, sides, regions, predicates);
  run.count(predicates);
  return regions;
}

}  // namespace mandoline::detail

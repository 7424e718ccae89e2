// Shells of cut-cells (paper, 3.5): each cell has one of positive volume; the cells of a grid cell fill it, their faces its sides.
#include <algorithm>

#include "base/sort.h"
#include "operators/validate/grid_cell_checks.h"

namespace mandoline::validation {

std::vector<double> ShellCheck::run(const GridCell& cell, const std::vector<uint32_t>& shell) {
  sumShells(cell, shell);
  sumCells(cell, shell);
  checkCells(cell);
  checkSides(cell);
  checkDistinct(cell);
  std::vector<double> volumes;
  for (const Cell& its : cells_) volumes.push_back(its.volume * cell.size[0] * cell.size[1] * cell.size[2]);
  return volumes;
}

void ShellCheck::sumShells(const GridCell& cell, const std::vector<uint32_t>& shell) {
  shells_.assign(2 * cell.faces.size(), {});
  for (uint32_t f = 0; f < cell.faces.size(); ++f) {
    const GridCell::Face& face = cell.faces[f];
    if (face.owner[0] == face.owner[1] && shell[2 * f] == shell[2 * f + 1]) continue;  // a sheet adds exactly nothing
    for (uint32_t side = 0; side < 2; ++side) {
      Shell& its = shells_[shell[2 * f + side]];
      its.volume += side == 0 ? face.volume : -face.volume;
      its.noise += face.volumeNoise;
    }
  }
}

void ShellCheck::sumCells(const GridCell& cell, const std::vector<uint32_t>& shell) {
  cells_.assign(cell.cells.size(), {});
  for (uint32_t h = 0; h < shells_.size(); ++h) {
    const GridCell::Face& face = cell.faces[h / 2];
    const int32_t owner = face.owner[h % 2];
    if (owner < 0) continue;
    Cell& its = cellOf(cell, owner);
    if (h % 2 == 0 || face.owner[0] != face.owner[1]) its.faces += Random::mix(face.id + 0x9e3779b97f4a7c15u);
    if (shell[h] != h) continue;
    const Shell& whole = shells_[h];
    its.volume += whole.volume;
    its.noise += whole.noise;
    its.positive += whole.volume > kTolerance * whole.noise;
    its.perhapsPositive += whole.noise > 0 && whole.volume > -kTolerance * whole.noise;
  }
}

ShellCheck::Cell& ShellCheck::cellOf(const GridCell& cell, int32_t id) {
  return cells_[size_t(std::lower_bound(cell.cells.begin(), cell.cells.end(), uint32_t(id)) - cell.cells.begin())];
}

void ShellCheck::checkCells(const GridCell& cell) {
  double sum = 0, noise = kRounding;
  for (size_t i = 0; i < cells_.size(); ++i) {
    const Cell& its = cells_[i];
    const int64_t id = cell.cells[i];
    if (its.positive > 1) connected_.violate("cell", id, "has several shells of positive volume");
    if (its.perhapsPositive == 0) connected_.violate("cell", id, "has no shell of positive volume");
    if (its.volume < 0) {
      cellVolume_.measure({-its.volume / its.noise, -its.volume}, "cell", id, "has a negative volume, {} of its grid cell's");
    }
    sum += its.volume;
    noise += its.noise;
  }
  const double deviation = std::fabs(sum - 1);
  gridCellVolume_.measure({deviation / noise, deviation}, "cell", cell.cells[0],
                          "and the others of its grid cell do not fill it: their volumes together are off by {}");
}

/// Each of the six grid-faces is covered once.
void ShellCheck::checkSides(const GridCell& cell) {
  double area[6] = {}, noise[6] = {kRounding, kRounding, kRounding, kRounding, kRounding, kRounding};
  int64_t last[6] = {-1, -1, -1, -1, -1, -1};
  for (const GridCell::Face& face : cell.faces) {
    if (face.side < 0) continue;
    area[face.side] += std::fabs(face.area[face.side / 2]);
    noise[face.side] += face.areaNoise[face.side / 2];
    last[face.side] = face.id;
  }
  for (int side = 0; side < 6; ++side) {
    const double share = std::fabs(area[side] - 1);
    const Deviation deviation{share / noise[side], share};
    if (last[side] < 0) {
      gridFaceArea_.measure(deviation, "cell", cell.cells[0], "and the others of its grid cell leave one side of it uncovered");
    } else {
      gridFaceArea_.measure(deviation, "face", last[side],
                            "and the others in its grid-face do not cover it exactly once: their areas together are off by {}");
    }
  }
}

void ShellCheck::checkDistinct(const GridCell& cell) {
  if (cells_.size() < 2) return;
  std::vector<std::pair<uint64_t, uint32_t>> byFaces;
  for (size_t i = 0; i < cells_.size(); ++i) byFaces.push_back({cells_[i].faces, cell.cells[i]});
  detail::sortItems(byFaces);
  for (size_t i = 1; i < byFaces.size(); ++i) {
    if (byFaces[i].first == byFaces[i - 1].first) distinct_.violate("cell", byFaces[i].second, "has the same faces as another");
  }
}

void ShellCheck::merge(const ShellCheck& next) {
  connected_.merge(next.connected_);
  distinct_.merge(next.distinct_);
  cellVolume_.merge(next.cellVolume_);
  gridCellVolume_.merge(next.gridCellVolume_);
  gridFaceArea_.merge(next.gridFaceArea_);
}

}  // namespace mandoline::validation

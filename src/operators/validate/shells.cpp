// Shells of cut-cells (paper, 3.5): each cell has one of positive volume; the cells of a grid cell fill it, their faces its sides.
#include <algorithm>

#include "operators/validate/grid_cells.h"

namespace mandoline::validation {

void ShellCheck::run(const GridCell& cell, Sets& shells, std::vector<double>& cellVolumes) {
  shells_.assign(2 * cell.faces.size(), {});
  cells_.assign(cell.cells.size(), {});
  const auto cellOf = [&](int32_t id) -> Cell& {  // cells of a grid cell are in ascending order
    return cells_[size_t(std::lower_bound(cell.cells.begin(), cell.cells.end(), uint32_t(id)) - cell.cells.begin())];
  };
  for (uint32_t f = 0; f < cell.faces.size(); ++f) {
    const GridCell::Face& face = cell.faces[f];
    const uint64_t hash = Random::mix(face.id + 0x9e3779b97f4a7c15u);
    for (int side = 0; side < 2; ++side) {
      if (face.owner[side] >= 0 && !(side == 1 && face.owner[0] == face.owner[1])) cellOf(face.owner[side]).faces += hash;
    }
    if (face.owner[0] == face.owner[1] && shells.find(2 * f) == shells.find(2 * f + 1)) continue;  // a sheet adds exactly nothing
    for (uint32_t side = 0; side < 2; ++side) {
      Shell& shell = shells_[shells.find(2 * f + side)];
      shell.volume += side == 0 ? face.volume : -face.volume;
      shell.noise += face.volumeNoise;
    }
  }
  for (uint32_t h = 0; h < shells_.size(); ++h) {
    const int32_t owner = cell.faces[h / 2].owner[h % 2];
    if (owner < 0 || shells.find(h) != h) continue;
    const Shell& shell = shells_[h];
    Cell& its = cellOf(owner);
    its.volume += shell.volume;
    its.noise += shell.noise;
    its.positive += shell.volume > kTolerance * shell.noise;
    its.perhapsPositive += shell.noise > 0 && shell.volume > -kTolerance * shell.noise;
  }
  double sum = 0, noise = kRounding;
  for (size_t i = 0; i < cells_.size(); ++i) {
    const Cell& its = cells_[i];
    if (its.positive > 1) connected_.violate("cell", cell.cells[i], "has several shells of positive volume");
    if (its.perhapsPositive == 0) connected_.violate("cell", cell.cells[i], "has no shell of positive volume");
    if (its.volume < 0) cellVolume_.measure(-its.volume / its.noise, "cell", cell.cells[i], "has a negative volume");
    cellVolumes[cell.cells[i]] = its.volume * cell.size[0] * cell.size[1] * cell.size[2];
    sum += its.volume;
    noise += its.noise;
  }
  gridCellVolume_.measure(std::fabs(sum - 1) / noise, "cell", cell.cells[0], "and the others of its grid cell do not fill that");
  checkSides(cell);
  checkDistinct(cell);
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
    const double deviation = std::fabs(area[side] - 1) / noise[side];
    if (last[side] < 0) {
      gridFaceArea_.measure(deviation, "cell", cell.cells[0], "and the others of its grid cell leave a side of that uncovered");
    } else {
      gridFaceArea_.measure(deviation, "face", last[side], "and the others in its grid-face do not cover that once");
    }
  }
}

void ShellCheck::checkDistinct(const GridCell& cell) {
  if (cells_.size() < 2) return;
  std::vector<std::pair<uint64_t, uint32_t>> byFaces;
  for (size_t i = 0; i < cells_.size(); ++i) byFaces.push_back({cells_[i].faces, cell.cells[i]});
  std::sort(byFaces.begin(), byFaces.end());
  for (size_t i = 1; i < byFaces.size(); ++i) {
    if (byFaces[i].first == byFaces[i - 1].first) distinct_.violate("cell", byFaces[i].second, "has the same faces as another");
  }
}

void ShellCheck::finish(std::vector<Check>& checks) {
  for (Tally* tally : {&connected_, &distinct_, &cellVolume_, &gridCellVolume_, &gridFaceArea_}) checks.push_back(tally->finish());
}

}  // namespace mandoline::validation

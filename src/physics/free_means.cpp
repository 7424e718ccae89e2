#include "physics/free_means.h"

#include <algorithm>

#include "physics/node_loops.h"

namespace mandoline::physics {

FreeMeans::FreeMeans(const CellComplex& cells, const CellComponents& components, const std::vector<char>& held)
    : cells_(cells), volume_(components.count) {
  const std::vector<uint32_t>& component = components.cellComponent;
  for (uint32_t c = 0; c < component.size(); ++c) {
    if (!held[component[c]]) volume_[component[c]] += cells.cellVolume[c];
    if (c > 0 && c % kBlock == 0) runs_.endGroup();
    if (c % kBlock == 0 || component[c] != component[c - 1]) runs_.items.push_back({component[c], c, c});
    runs_.items.back().end = c + 1;
  }
  runs_.endGroup();
}

std::vector<double> FreeMeans::meansOf(const std::vector<double>& z, const detail::Team& team) const {
  std::vector<double> means(volume_.size()), sums(runs_.items.size());
  if (std::all_of(volume_.begin(), volume_.end(), [](double volume) { return !(volume > 0); })) return means;
  forBlocks(z.size(), team, [&](size_t begin, size_t) {
    for (uint32_t r = runs_.offsets[begin / kBlock]; r < runs_.offsets[begin / kBlock + 1]; ++r) {
      const Run& run = runs_.items[r];
      for (size_t c = run.begin; c < run.end; ++c) sums[r] += z[c] * cells_.cellVolume[c];
    }
  });
  for (size_t r = 0; r < sums.size(); ++r) means[runs_.items[r].component] += sums[r];
  for (size_t k = 0; k < means.size(); ++k) means[k] = volume_[k] > 0 ? means[k] / volume_[k] : 0;
  return means;
}

double FreeMeans::takeOut(const std::vector<double>& r, std::vector<double>& z, const detail::Team& team) const {
  const std::vector<double> means = meansOf(z, team);
  return sumOfBlocks(z.size(), team, [&](size_t begin, size_t) {
    double sum = 0;
    for (const Run& run : runs_[begin / kBlock]) {
      for (size_t c = run.begin; c < run.end; ++c) z[c] -= means[run.component], sum += r[c] * z[c];
    }
    return sum;
  });
}

}  // namespace mandoline::physics

#include "physics/free_means.h"

#include <algorithm>

namespace mandoline::physics {

FreeMeans::FreeMeans(const CellComplex& cells, const ComponentRuns& runs, const std::vector<char>& held, const detail::Team& team)
    : cells_(cells), runs_(runs), volume_(runs.sums(team, [&](size_t begin, size_t end) {
        double sum = 0;
        for (size_t c = begin; c < end; ++c) sum += cells.cellVolume[c];
        return sum;
      })) {
  for (size_t k = 0; k < volume_.size(); ++k) {
    if (held[k]) volume_[k] = 0;
  }
}

std::vector<double> FreeMeans::meansOf(const std::vector<double>& z, const detail::Team& team) const {
  if (std::all_of(volume_.begin(), volume_.end(), [](double volume) { return !(volume > 0); })) return std::vector<double>(volume_.size());
  std::vector<double> means = runs_.sums(team, [&](size_t begin, size_t end) {
    double sum = 0;
    for (size_t c = begin; c < end; ++c) sum += z[c] * cells_.cellVolume[c];
    return sum;
  });
  for (size_t k = 0; k < means.size(); ++k) means[k] = volume_[k] > 0 ? means[k] / volume_[k] : 0;
  return means;
}

double FreeMeans::takeOut(const std::vector<double>& r, std::vector<double>& z, const detail::Team& team) const {
  const std::vector<double> means = meansOf(z, team);
  return sumOfBlocks(z.size(), team, [&](size_t begin, size_t) {
    double sum = 0;
    for (const ComponentRuns::Run& run : runs_.ofBlock(begin / kBlock)) {
      for (size_t c = run.begin; c < run.end; ++c) z[c] -= means[run.component], sum += r[c] * z[c];
    }
    return sum;
  });
}

}  // namespace mandoline::physics

#include "physics/component_runs.h"

namespace mandoline::physics {

ComponentRuns::ComponentRuns(const CellComponents& components) : components_(components.count), cells_(components.cellComponent.size()) {
  const std::vector<uint32_t>& component = components.cellComponent;
  for (uint32_t c = 0; c < component.size(); ++c) {
    if (c > 0 && c % kBlock == 0) runs_.endGroup();
    if (c % kBlock == 0 || component[c] != component[c - 1]) runs_.items.push_back({component[c], c, c});
    runs_.items.back().end = c + 1;
  }
  runs_.endGroup();
}

std::vector<double> ComponentRuns::sums(const detail::Team& team, detail::FunctionRef<double(size_t, size_t)> f) const {
  std::vector<double> ofRuns(runs_.items.size()), result(components_);
  forBlocks(cells_, team, [&](size_t begin, size_t) {
    for (uint32_t r = runs_.offsets[begin / kBlock]; r < runs_.offsets[begin / kBlock + 1]; ++r)
      ofRuns[r] = f(runs_.items[r].begin, runs_.items[r].end);
  });
  for (size_t r = 0; r < ofRuns.size(); ++r) result[runs_.items[r].component] += ofRuns[r];
  return result;
}

}  // namespace mandoline::physics

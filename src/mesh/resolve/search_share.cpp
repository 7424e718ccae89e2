#include "mesh/resolve/search_share.h"

#include <limits>

#include "base/sort.h"

namespace mandoline::detail {

SearchBand::SearchBand(const WeldedMesh& mesh, const ShareOf& shareOf) : mesh_(mesh) {
  constexpr double kFar = std::numeric_limits<double>::infinity();
  constexpr size_t kSamples = 1 << 16;
  const size_t step = mesh.triangles.size() / kSamples + 1;
  Box all = Box::empty();
  std::vector<std::array<double, 3>> samples;
  for (size_t t = 0; t < mesh.triangles.size(); t += step) {
    if (!mesh.kept(t)) continue;
    const Box box = boxOf(mesh, uint32_t(t));
    all.include(box);
    samples.push_back(box.low);
  }
  for (size_t d = 1; d < 3; ++d) {
    if (all.high[d] - all.low[d] > all.high[axis_] - all.low[axis_]) axis_ = d;
  }
  sortItems(samples, [&](const auto& a, const auto& b) { return a[axis_] < b[axis_]; });
  const auto boundary = [&](uint64_t share) { return samples[size_t(samples.size() * share / shareOf.count)][axis_]; };
  from_ = shareOf.index == 0 || samples.empty() ? -kFar : boundary(shareOf.index);
  to_ = shareOf.index + 1 == shareOf.count || samples.empty() ? kFar : boundary(shareOf.index + 1);
}

std::vector<TriangleState> SearchBand::states() const {
  std::vector<TriangleState> states = mesh_.states;
  for (uint32_t t = 0; t < states.size(); ++t) {
    if (states[t] != TriangleState::kept) continue;
    const Box box = boxOf(mesh_, t);
    if (box.low[axis_] >= to_ || box.high[axis_] < from_) states[t] = TriangleState::beside;
  }
  return states;
}

/// Decided by the lowest coordinate that both have.
bool SearchBand::has(const TrianglePair& pair) const {
  const double lowest = std::max(boxOf(mesh_, pair[0]).low[axis_], boxOf(mesh_, pair[1]).low[axis_]);
  return lowest >= from_ && lowest < to_;
}

Contacts contactsOfPairs(const WeldedMesh& mesh, const std::vector<TrianglePair>& pairs, Monitor& monitor, Predicates& predicates) {
  struct Chunk {
    std::vector<PairContact> found;
    uint64_t fallbacks = 0;
  };
  const auto chunks = forChunks<Chunk>(pairs.size(), monitor, [&](Chunk& chunk, size_t begin, size_t end) {
    PairTest test(mesh);
    PairContact pair;
    for (size_t i = begin; i < end; ++i) {
      if (test.find(pairs[i][0], pairs[i][1], pair)) chunk.found.push_back(pair);
    }
    chunk.fallbacks += test.fallbacks();
  });
  std::vector<PairContact> all;
  for (const Chunk& chunk : chunks) {
    predicates.fallbacks += chunk.fallbacks;
    all.insert(all.end(), chunk.found.begin(), chunk.found.end());
  }
  return contactsOf(mesh, std::move(all));
}

}  // namespace mandoline::detail

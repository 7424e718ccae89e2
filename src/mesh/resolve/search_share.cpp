#include "mesh/resolve/search_share.h"

#include <limits>

#include "base/sort.h"

namespace mandoline::detail {

SearchBand::SearchBand(const WeldedMesh& mesh, const ShareOf& shareOf) : mesh_(mesh) {
  constexpr double kFar = std::numeric_limits<double>::infinity();
  constexpr size_t kSamples = 1 << 10;  // for each share
  const size_t step = mesh.triangles.size() / (kSamples * shareOf.count) + 1;
  Box all = Box::empty();
  std::vector<Point> samples;
  for (size_t t = 0; t < mesh.triangles.size(); t += step) {
    if (!mesh.kept(t)) continue;
    const Box box = boxOf(mesh, uint32_t(t));
    all.include(box);
    samples.push_back(box.low);
  }
  for (size_t d = 1; d < 3; ++d) {
    if (all.high[d] - all.low[d] > all.high[axis_] - all.low[axis_]) axis_ = d;
  }
  std::vector<double> lowest;
  for (const Point& sample : samples) lowest.push_back(sample[axis_]);
  sortItems(lowest);
  const auto boundary = [&](uint64_t share) { return lowest[size_t(lowest.size() * share / shareOf.count)]; };
  from_ = shareOf.index == 0 || samples.empty() ? -kFar : boundary(shareOf.index);
  to_ = shareOf.index + 1 == shareOf.count || samples.empty() ? kFar : boundary(shareOf.index + 1);
}

std::vector<TriangleState> SearchBand::states() const {
  std::vector<TriangleState> states = mesh_.states;
  for (size_t t = 0; t < states.size(); ++t) {
    if (states[t] != TriangleState::kept) continue;
    const auto& v = mesh_.triangles[t];
    const double a = mesh_.points[v[0]][axis_], b = mesh_.points[v[1]][axis_], c = mesh_.points[v[2]][axis_];
    const bool reaches = std::min(std::min(a, b), c) < to_ && std::max(std::max(a, b), c) >= from_;
    if (!reaches) states[t] = TriangleState::beside;
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

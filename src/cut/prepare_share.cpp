#include "mandoline/prepare_share.h"

#include <optional>

#include "cut/driver.h"
#include "mesh/run_call.h"

namespace mandoline {

using namespace detail;

namespace {

constexpr const char* kNoun = "preparation";

std::vector<TrianglePair> pairsOf(std::span<const uint32_t> triangles, uint64_t triangleCount) {
  const auto isPair = [&](uint32_t s, uint32_t t) { return s < t && t < triangleCount; };
  std::vector<TrianglePair> pairs;
  for (size_t i = 0; i + 1 < triangles.size() && isPair(triangles[i], triangles[i + 1]); i += 2)
    pairs.push_back({triangles[i], triangles[i + 1]});
  if (2 * pairs.size() != triangles.size())
    throw Failure{{Status::badArgument, int64_t(2 * pairs.size()), -1, "pairs must have two triangles each, the lower one first."}};
  return pairs;
}

}  // namespace

struct PrepareShare::Data {
  Data(const ShareOf& shareOf_, const PrepareOptions& options_)
      : shareOf(shareOf_), options(options_), monitor(options, stagesBefore(options) + kMeshStages) {}

  std::vector<uint32_t> findPairs(const MeshToPrepare& mesh) {
    data = beginPreparing(mesh, options, monitor);
    clock.emplace(result.stats, monitor, stagesBefore(options));
    clock->begin("input");
    prepared = weldInput(*data->mesh, 0, monitor);
    dropFlat(*prepared, nullptr, monitor, predicates);
    std::vector<uint32_t> triangles;
    if (options.intersections == Intersections::assumeNone) return triangles;
    clock->begin("intersections");
    for (const TrianglePair& pair : detail::findPairs(*prepared, shareOf, monitor, predicates))
      triangles.insert(triangles.end(), pair.begin(), pair.end());
    return triangles;
  }

  PrepareResult resolve(std::span<const uint32_t> triangles) {
    const std::vector<TrianglePair> pairs = pairsOf(triangles, prepared->triangles.size());
    if (options.intersections != Intersections::assumeNone) resolvePairs(*prepared, pairs, {0, options.intersections}, monitor, predicates);
    prepared->counts.exactFallbacks = predicates.fallbacks;
    finishPreparing(std::move(data), std::move(prepared), result);
    clock.reset();
    return std::move(result);
  }

  ShareOf shareOf;
  PrepareOptions options;
  Monitor monitor;
  PrepareResult result;
  std::optional<Clock> clock;
  std::shared_ptr<PreparedMeshData> data;
  std::unique_ptr<Prepared> prepared;
  Predicates predicates;
};

PrepareShare::PrepareShare(const ShareOf& shareOf, const PrepareOptions& options) : data_(std::make_shared<Data>(shareOf, options)) {}

std::vector<uint32_t> PrepareShare::findPairs(const MeshView& mesh) {
  return runCall(kNoun, [&] { return data_->findPairs(mesh); });
}

std::vector<uint32_t> PrepareShare::findPairs(std::shared_ptr<const Mesh> mesh) {
  return runCall(kNoun, [&] { return data_->findPairs(std::move(mesh)); });
}

Fingerprint PrepareShare::fingerprint() const { return data_->data->fingerprint; }

void PrepareShare::findEdges() {
  runCall(kNoun, [&] { findInputEdges(*data_->prepared); });
}

PrepareResult PrepareShare::resolve(std::span<const uint32_t> pairs) {
  return runCall(kNoun, [&] { return data_->resolve(pairs); });
}

}  // namespace mandoline

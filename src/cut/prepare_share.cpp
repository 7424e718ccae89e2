#include "cut/prepare_share.h"

namespace mandoline::detail {

PrepareShare::PrepareShare(const ShareOf& shareOf, const PrepareOptions& options)
    : shareOf_(shareOf), options_(options), monitor_(options_, stagesBefore(options) + kMeshStages) {}

std::vector<TrianglePair> PrepareShare::findPairs(const MeshToPrepare& mesh) {
  data_ = beginPreparing(mesh, options_, monitor_);
  clock_.emplace(result_.stats, monitor_, stagesBefore(options_));
  clock_->begin("input");
  prepared_ = weldInput(*data_->mesh, 0, monitor_);
  dropFlat(*prepared_, nullptr, monitor_, predicates_);
  if (options_.intersections == Intersections::assumeNone) return {};
  clock_->begin("intersections");
  return findEdgesAndPairs(*prepared_, shareOf_, monitor_, predicates_);
}

PrepareResult PrepareShare::resolve(const std::vector<TrianglePair>& pairs) {
  const Preparation preparation{0, options_.intersections};
  if (options_.intersections == Intersections::assumeNone)
    resolveInput(*prepared_, preparation, monitor_, predicates_);
  else
    resolvePairs(*prepared_, pairs, preparation, monitor_, predicates_);
  prepared_->counts.exactFallbacks = predicates_.fallbacks;
  finishPreparing(std::move(data_), std::move(prepared_), result_);
  clock_.reset();
  return std::move(result_);
}

}  // namespace mandoline::detail

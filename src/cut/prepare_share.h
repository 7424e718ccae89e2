// prepare() by several processes that all have the mesh: they divide the search for triangles that meet.
#pragma once

#include <optional>

#include "cut/driver.h"

namespace mandoline::detail {

class MANDOLINE_SHARED PrepareShare {
 public:
  PrepareShare(const ShareOf& shareOf, const PrepareOptions& options);

  /// The first step: gives the pairs that this share finds, to be told to all. A share that is not below the count finds none.
  std::vector<TrianglePair> findPairs(const MeshToPrepare& mesh);
  /// That of the mesh, after the first step.
  Fingerprint fingerprint() const { return data_->fingerprint; }
  /// The second, of the pairs of all shares in any order. To be called once. Both fail as prepare() does.
  PrepareResult resolve(const std::vector<TrianglePair>& pairs);

 private:
  ShareOf shareOf_;
  PrepareOptions options_;
  Monitor monitor_;
  PrepareResult result_;
  std::optional<Clock> clock_;
  std::shared_ptr<PreparedMeshData> data_;
  std::unique_ptr<Prepared> prepared_;
  Predicates predicates_;
};

}  // namespace mandoline::detail

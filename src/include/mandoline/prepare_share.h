// prepare() by several processes that have no memory in common, and the whole mesh each: workers of a page, say. They divide the search for
// triangles that meet, and then each has the prepared mesh, the same as prepare() gives.
//
//   PrepareShare share({index, count}, options);           // in each
//   std::vector<uint32_t> pairs = share.findPairs(mesh);   // of the same mesh
//   ... pairs to all others ...
//   share.findEdges();                                     // while these are on their way
//   ... allPairs: those of all, one after the other in any order ...
//   PrepareResult result = share.resolve(allPairs);
#pragma once

#include "mandoline/prepare.h"

namespace MANDOLINE_API mandoline {

/// One of `count` shares.
struct ShareOf {
  uint32_t index = 0, count = 1;

  /// Where the share of so many items begins, and ends, if they are divided as evenly as can be.
  uint64_t begin(uint64_t items) const { return items * index / count; }
  uint64_t end(uint64_t items) const { return items * (uint64_t(index) + 1) / count; }
};

class PrepareShare {
 public:
  /// A share whose index is not below the count finds no pairs: that of a process which does something else meanwhile.
  explicit PrepareShare(const ShareOf& shareOf, const PrepareOptions& options = {});

  /// The first step: two triangles for each pair that this share finds. Throws CallError as prepare() has errors.
  std::vector<uint32_t> findPairs(const MeshView& mesh);
  /// The same of a mesh that is kept rather than copied.
  std::vector<uint32_t> findPairs(std::shared_ptr<const Mesh> mesh);
  /// That of the mesh, after the first step: the same in all shares.
  Fingerprint fingerprint() const;
  /// What is left to do before the pairs of others are there. Throws CallError as prepare() has errors.
  void findEdges();
  /// The last step, to be called once, with the pairs of all shares. Throws CallError as prepare() has errors, and for numbers that are no
  /// pairs of triangles (badArgument).
  PrepareResult resolve(std::span<const uint32_t> pairs);

 private:
  struct Data;
  std::shared_ptr<Data> data_;
};

}  // namespace mandoline

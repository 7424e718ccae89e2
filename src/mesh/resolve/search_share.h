// The search for triangles that meet, divided among processes that all have the mesh: each searches a band of space, and tells the others
// which pairs meet. What these have in common each finds by itself, which is quick.
#pragma once

#include "mandoline/prepare_share.h"
#include "mesh/resolve/contacts.h"

namespace mandoline::detail {

using TrianglePair = std::array<uint32_t, 2>;

/// The band of a share, across the mesh's longest side. Bands hold alike many lowest coordinates of triangles, about.
class SearchBand {
 public:
  SearchBand(const WeldedMesh& mesh, const ShareOf& shareOf);

  /// Those of the mesh, but only triangles that reach into the band are kept.
  std::vector<TriangleState> states() const;
  /// Whether a pair that meets is the band's, as it is of one of all bands. Both triangles then reach into it.
  bool has(const TrianglePair& pair) const;

 private:
  const WeldedMesh& mesh_;
  size_t axis_ = 0;
  double from_, to_;
};

/// What findContacts() gives. `pairs`: those of all bands, in any order.
Contacts contactsOfPairs(const WeldedMesh& mesh, const std::vector<TrianglePair>& pairs, Monitor& monitor, Predicates& predicates);

}  // namespace mandoline::detail

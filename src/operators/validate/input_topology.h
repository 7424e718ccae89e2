// What the input's connectivity says about winding numbers: duplicate triangles, and whether it is closed.
#pragma once

#include "operators/validate/context.h"

namespace mandoline::validation {

/// Triangles dropped as duplicates may count or not, so that some answers are by whether they do: [0] without them, [1] with.
struct InputTopology {
  /// Whether the input may be called closed (every edge is run through equally often in both directions), and open. Both where triangles
  /// without area are all that makes the difference.
  bool mayBeClosed[2] = {true, true}, mayBeOpen[2] = {false, false};
  std::vector<int32_t> multiplicity;  ///< per triangle: sum of orientations of all with its vertices, relative to its own; empty if all 1
  std::vector<uint8_t> duplicate;     ///< per triangle: dropped, with another of its vertices that is kept or comes before; empty if none

  bool isDuplicate(size_t t) const { return !duplicate.empty() && duplicate[t]; }
};
InputTopology findTopology(const Context& context);

}  // namespace mandoline::validation

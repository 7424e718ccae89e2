// What the input's connectivity says about winding numbers: whether it is closed.
#pragma once

#include "operators/validate/context.h"

namespace mandoline::validation {

/// Whether the input may be called closed (every edge is run through equally often in both directions), and open. Both where triangles
/// without area are all that makes the difference.
struct InputTopology {
  bool mayBeClosed = true, mayBeOpen = false;
};
InputTopology findTopology(const Context& context);

}  // namespace mandoline::validation

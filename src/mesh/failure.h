// What ends a cut, or the preparation of a mesh, early.
#pragma once

#include "mandoline/status.h"

namespace mandoline::detail {

/// Thrown inside the library, caught where a call of a public header ends (mesh/run_call.h).
struct Failure {
  Error error;
};

}  // namespace mandoline::detail

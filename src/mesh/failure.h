// What ends a cut, or the preparation of a mesh, early.
#pragma once

#include "mandoline/status.h"

namespace mandoline::detail {

/// Thrown by the stages, caught by the functions of the public headers.
struct Failure {
  Error error;
};

}  // namespace mandoline::detail

// What ends a cut early.
#pragma once

#include "mandoline/status.h"

namespace mandoline::detail {

/// Thrown by the stages, caught by cut() alone.
struct Failure {
  Error error;
};

}  // namespace mandoline::detail

// Where failures inside a call become the error that its caller sees.
#pragma once

#include "base/parallel.h"
#include "base/shared.h"
#include "mandoline/status.h"

namespace mandoline::detail {

/// The error for the exception that is being handled, if that is a Failure or Cancelled. Anything else is thrown on, and what
/// options.progress threw as it was. `noun` names the call: "cut".
MANDOLINE_SHARED Error caughtFailure(const char* noun);

/// Returns what body() returns. Throws CallError if it fails.
template <class Body>
auto runCall(const char* noun, const Body& body) {
  try {
    return body();
  } catch (...) {
    throw CallError(caughtFailure(noun));
  }
}

/// Runs body(). If it fails or memory runs out, `error` says so. Throws nothing but what options.progress throws.
MANDOLINE_SHARED void catchErrors(Error& error, const char* noun, FunctionRef<void()> body);

}  // namespace mandoline::detail

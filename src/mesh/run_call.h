// What calls that may take long have in common.
#pragma once

#include <exception>
#include <string>

#include "base/parallel.h"
#include "mandoline/status.h"

namespace mandoline::detail {

/// Returns what body() returns. If options.progress cancels, throws CallError; what it throws passes through unchanged.
template <class Body>
auto runCall(const char* noun, const Body& body) {
  try {
    return body();
  } catch (const Cancelled&) {
    throw CallError({Status::cancelled, -1, -1, std::string("The ") + noun + " was cancelled."});
  } catch (const ProgressFailed& failure) {
    std::rethrow_exception(failure.exception);
  }
}

}  // namespace mandoline::detail

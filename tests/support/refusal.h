// What a wrong call throws.
#pragma once

#include <utility>

#include "mandoline/status.h"

/// Status and element of the CallError that a call throws; ok if it throws none.
template <class Call>
std::pair<mandoline::Status, int64_t> refusal(const Call& call) {
  try {
    call();
  } catch (const mandoline::CallError& error) {
    return {error.error.message.empty() ? mandoline::Status::internalError : error.error.status, error.error.element};
  }
  return {mandoline::Status::ok, -1};
}

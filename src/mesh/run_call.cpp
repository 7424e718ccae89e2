#include "mesh/run_call.h"

#include <exception>
#include <new>
#include <stdexcept>

#include "mesh/failure.h"

namespace mandoline::detail {

Error caughtFailure(const char* noun) {
  try {
    throw;
  } catch (const Failure& failure) {
    return failure.error;
  } catch (const Cancelled&) {
    return {Status::cancelled, -1, -1, std::string("The ") + noun + " was cancelled."};
  } catch (const ProgressFailed& failure) {
    std::rethrow_exception(failure.exception);
  }
}

void catchErrors(Error& error, const char* noun, FunctionRef<void()> body) {
  const auto outOfMemory = [&] {
    return Error{Status::outOfMemory, -1, -1, std::string("There is not enough memory for the ") + noun + "."};
  };
  try {
    body();
  } catch (const CallError& failure) {
    error = failure.error;
  } catch (const std::bad_alloc&) {
    error = outOfMemory();
  } catch (const std::length_error&) {
    error = outOfMemory();
  } catch (...) {
    error = caughtFailure(noun);
  }
}

}  // namespace mandoline::detail

#include "values.h"

#include <new>
#include <stdexcept>

namespace mandoline::wasm {

/// Numbers in memory as a typed array, valid until memory grows.
static val viewOf(const char* type, const void* numbers, size_t count) {
  const val buffer = val(emscripten::typed_memory_view(0, static_cast<const uint8_t*>(nullptr)))["buffer"];
  return val::global(type).new_(buffer, reinterpret_cast<uintptr_t>(numbers), count);
}

val toArray(const char* type, const void* numbers, size_t count, const val& copy) {
  const val view = viewOf(type, numbers, count);
  return copy.isUndefined() ? val::global(type).new_(view) : copy(view);  // slice() would fill its copy with zeros first
}

void copyArray(const val& array, const char* type, void* numbers, size_t count) { viewOf(type, numbers, count).call<void>("set", array); }

val object(std::initializer_list<std::pair<const char*, val>> members) {
  val result = val::object();
  for (const auto& [name, value] : members) result.set(name, value);
  return result;
}

val success(const val& value) { return object({{"value", value}}); }

static val failed(const char* code, const Error& error, const val& stage) {
  const val what = object({{"code", val(std::string(code))},
                           {"message", val(error.message)},
                           {"stage", stage},
                           {"element", val(double(error.element))},
                           {"element2", val(double(error.element2))}});
  return object({{"error", what}});
}

val failure(const Error& error, const val& stage) { return failed(name(error.status), error, stage); }

val failure(const char* code, const std::string& message) { return failed(code, {Status::ok, -1, -1, message}, val::undefined()); }

val caughtFailure() {
  try {
    throw;
  } catch (const std::bad_alloc&) {
  } catch (const std::length_error&) {
  } catch (const CallError& exception) {
    return failure(exception.error);
  } catch (const FileError& exception) {
    return failure("badFile", std::string(exception.what()) + ".");
  } catch (const std::exception& exception) {
    return failure(name(Status::internalError), exception.what());
  }
  return failure(name(Status::outOfMemory), "There is not enough memory for this call.");
}

}  // namespace mandoline::wasm

#include "values.h"

namespace mandoline::wasm {

val success(const val& value) {
  val result = val::object();
  result.set("value", value);
  return result;
}

static val failed(const char* code, const Error& error, const val& stage) {
  val object = val::object();
  object.set("code", std::string(code));
  object.set("message", error.message);
  object.set("stage", stage);
  object.set("element", double(error.element));
  object.set("element2", double(error.element2));
  val result = val::object();
  result.set("error", object);
  return result;
}

val failure(const Error& error, const val& stage) { return failed(name(error.status), error, stage); }

val failure(const char* code, const std::string& message) { return failed(code, {Status::ok, -1, -1, message}, val::undefined()); }

}  // namespace mandoline::wasm

// Arrays, small values and errors between C++ and JavaScript.
#pragma once

#include <emscripten/val.h>

#include <array>
#include <initializer_list>
#include <string>
#include <type_traits>
#include <utility>
#include <vector>

#include "mandoline/io.h"

namespace mandoline::wasm {

using emscripten::val;

/// The name of the typed array that holds such numbers.
template <class Number>
constexpr const char* arrayType() {
  if constexpr (std::is_enum_v<Number>) return arrayType<std::underlying_type_t<Number>>();
  if constexpr (std::is_same_v<Number, double>) return "Float64Array";
  if constexpr (std::is_same_v<Number, uint32_t>) return "Uint32Array";
  if constexpr (std::is_same_v<Number, int32_t>) return "Int32Array";
  if constexpr (std::is_same_v<Number, int8_t>) return "Int8Array";
  if constexpr (std::is_same_v<Number, uint8_t>) return "Uint8Array";
}

/// The memory of numbers, or of enumerators as numbers, as a typed array.
template <class Number>
val viewOf(const std::vector<Number>& items) {
  if constexpr (std::is_enum_v<Number>)
    return val(emscripten::typed_memory_view(items.size(), reinterpret_cast<const std::underlying_type_t<Number>*>(items.data())));
  else
    return val(emscripten::typed_memory_view(items.size(), items.data()));
}

/// A typed array that owns its memory: the items are copied once.
template <class Number>
val toArray(const std::vector<Number>& items) {
  return viewOf(items).template call<val>("slice");
}

/// Enumerators are not checked.
template <class Number>
void readArray(const val& array, std::vector<Number>& items) {
  items.resize(array["length"].as<size_t>());
  viewOf(items).template call<void>("set", array);
}

template <class Number>
std::array<Number, 3> readTriple(const val& triple) {
  std::array<Number, 3> result;
  for (int d = 0; d < 3; ++d) result[d] = Number(triple[d].as<double>());
  return result;
}

template <class Number>
val toTriple(const std::array<Number, 3>& triple) {
  val result = val::array();
  for (int d = 0; d < 3; ++d) result.set(d, double(triple[d]));
  return result;
}

/// An object of named members.
val object(std::initializer_list<std::pair<const char*, val>> members);

val success(const val& value);
val failure(const Error& error, const val& stage = val::undefined());
val failure(const char* code, const std::string& message);

/// The error for the exception that is being handled.
val caughtFailure();

/// What f() gives, or the error for what it throws.
template <class F>
val guarded(const F& f) {
  try {
    return f();
  } catch (...) {
    return caughtFailure();
  }
}

}  // namespace mandoline::wasm

// Arrays, small values and errors between C++ and JavaScript.
#pragma once

#include <emscripten/val.h>

#include <array>
#include <initializer_list>
#include <string>
#include <type_traits>
#include <utility>
#include <vector>

#include "mandoline/mesh_files.h"
#include "mandoline/status.h"

namespace mandoline::wasm {

using emscripten::val;

/// The name of the typed array that holds such numbers.
template <class Number>
constexpr const char* arrayType() {
  if constexpr (std::is_enum_v<Number>) return arrayType<std::underlying_type_t<Number>>();
  if constexpr (std::is_same_v<Number, double>) return "Float64Array";
  if constexpr (std::is_same_v<Number, float>) return "Float32Array";
  if constexpr (std::is_same_v<Number, uint32_t>) return "Uint32Array";
  if constexpr (std::is_same_v<Number, int32_t>) return "Int32Array";
  if constexpr (std::is_same_v<Number, int8_t>) return "Int8Array";
  if constexpr (std::is_same_v<Number, uint8_t> || std::is_same_v<Number, char>) return "Uint8Array";
}

/// A typed array that owns its memory: `count` numbers are copied once, by a function of JavaScript if one is given.
val toArray(const char* type, const void* numbers, size_t count, const val& copy = val::undefined());
template <class Number>
val toArray(const std::vector<Number>& items, const val& copy = val::undefined()) {
  return toArray(arrayType<Number>(), items.data(), items.size(), copy);
}

/// The other way: copies an array's numbers, of any type, to memory.
void copyArray(const val& array, const char* type, void* numbers, size_t count);
/// Enumerators are not checked.
template <class Number>
void readArray(const val& array, std::vector<Number>& items) {
  items.resize(array["length"].as<size_t>());
  copyArray(array, arrayType<Number>(), items.data(), items.size());
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

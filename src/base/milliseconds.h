// A clock that only goes forward.
#pragma once

#ifdef __EMSCRIPTEN__
#include <emscripten.h>
#else
#include <chrono>
#endif

namespace mandoline::detail {

/// The time since some moment. Not by the standard library in WebAssembly, where that would bring along the texts of all errors of the
/// system.
inline double milliseconds() {
#ifdef __EMSCRIPTEN__
  return emscripten_get_now();
#else
  return std::chrono::duration<double, std::milli>(std::chrono::steady_clock::now().time_since_epoch()).count();
#endif
}

}  // namespace mandoline::detail

// Memory that is read soon at places that can't be foretold: asked for before.
#pragma once

namespace mandoline::detail {

/// In WebAssembly it is read: it has to be in an array, or at its end.
inline void prefetch([[maybe_unused]] const void* at) {
#ifdef __wasm__
  // It has no instruction for this, but the processor goes on while it waits for what it reads, so that waits of several overlap.
  static_cast<void>(*static_cast<const volatile char*>(at));
#elif defined(__GNUC__)
  __builtin_prefetch(at);
  asm volatile("");  // without it GCC takes the function for one that has no effect, and leaves out its calls
#endif
}

}  // namespace mandoline::detail

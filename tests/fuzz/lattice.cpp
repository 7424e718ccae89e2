// libFuzzer target: any bytes are a mesh on a coarse lattice and a small grid. Finds go to corpus/, which replay_test.cpp replays.
#include "lattice.h"

#include <cstdio>
#include <cstdlib>

extern "C" int LLVMFuzzerTestOneInput(const uint8_t* bytes, size_t size) {
  const std::string broken = brokenPromise(decodeLattice(bytes, size));
  if (!broken.empty()) {
    std::fprintf(stderr, "%s\n", broken.c_str());
    std::abort();
  }
  return 0;
}

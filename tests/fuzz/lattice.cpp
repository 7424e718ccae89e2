// libFuzzer target: any bytes are a mesh on a coarse lattice and a small grid, and choose a size of bricks, and whether and how the mesh
// moves. Finds go to corpus/, which replay_test.cpp replays.
#include "lattice.h"

#include <cstdio>
#include <cstdlib>
#include <numeric>

#include "brick_sizes.h"
#include "moving_mesh.h"

extern "C" int LLVMFuzzerTestOneInput(const uint8_t* bytes, size_t size) {
  const LatticeCase latticeCase = decodeLattice(bytes, size);
  std::string broken = brokenPromise(latticeCase);
  const unsigned choice = std::accumulate(bytes, bytes + size, 0u);
  if (broken.empty()) broken = brokenBricks(latticeCase.mesh, latticeCase.grid, int(choice % 4), 1 + choice / 4 % 2);
  if (broken.empty() && choice / 8 % 4 == 0) broken = brokenRecut(movingMesh(latticeCase.mesh, choice, 1), latticeCase.grid);
  if (!broken.empty()) {
    std::fprintf(stderr, "%s\n", broken.c_str());
    std::abort();
  }
  return 0;
}

// Output: numbers the vertices, lays the faces and cells of all bricks one after the other, and computes the coordinates.
//
// In: all stages before. Out: the public CutMesh (see cut_mesh.h for its arrays and their order).
#pragma once

#include "cut/stages/numbers.h"
#include "cut/stages/regions.h"

namespace mandoline::detail {

/// What the stages have made so far; each adds its part.
struct CutState {
  Surface surface;
  SurfaceParts parts;
  Bricks bricks;
  BrickCuts cuts;
  UntouchedRuns runs;
  IdVector<BrickId, BrickSeams> seams;
  Regions regions;

  CutBricks cut() const { return {surface, bricks, runs, cuts, seams}; }
};

/// Moves the arrays out of `state`. `mesh` was prepared; coordinates that it and `grid` have are handed back as they are.
CutMesh makeOutput(const MeshView& mesh, const Grid& grid, CutState& state, Run& run);

}  // namespace mandoline::detail

// What the calls that cut have in common: the clock of the stages, and all stages after "grid".
#pragma once

#include "cut/stages/output.h"
#include "mandoline/prepare.h"

namespace mandoline::detail {

/// A copy of a mesh, and the result of preparing it.
struct PreparedMeshData {
  Mesh mesh;
  Fingerprint fingerprint;
  Intersections intersections;
  std::unique_ptr<const Prepared> prepared;
};

/// Names the stages for progress and takes their times.
class Clock {
 public:
  /// Progress has so many stages before those of the clock.
  Clock(CutStats& stats, Monitor& monitor, int before = 0);
  ~Clock() { end(); }  // also of a cut that failed

  void begin(const char* stage);

 private:
  void end();

  CutStats& stats_;
  Monitor& monitor_;
  int before_;
  double start_, last_;
};

/// Whether a grid's planes are not so large that a mesh has to be scaled for them.
bool fits(const Prepared& prepared, const Grid& grid);

/// Cuts: the stages after "grid", which made `state.surface.input` of `mesh` and `grid`. Of a contradiction the Failure has the triangles
/// that are blamed at first: see explainContradiction().
CutMesh cutInput(CutState& state, const MeshView& mesh, const Grid& grid, Clock& clock, Run& run);

/// Notes in a cut-mesh what it was made of.
void sign(CutMesh& cutMesh, Fingerprint mesh, const CutOptions& options);

}  // namespace mandoline::detail

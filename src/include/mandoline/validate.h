// Checks of a cut-mesh against its input, worked out from its arrays alone: nothing that the cutter knew is trusted.
#pragma once

#include "mandoline/cut_mesh.h"
#include "mandoline/status.h"

namespace mandoline {

struct Check {
  std::string name;      ///< e.g. "surfaceArea"
  bool pass = true;      ///< true also if skipped
  bool skipped = false;  ///< does not apply to this input, e.g. winding numbers of an open mesh
  /// What was found: the number of violations; or where tolerance is above 0 the largest deviation, in roundings (half units in the last
  /// place of the largest coordinate). NaN where it can't be computed.
  double worst = 0;
  double tolerance = 0;     ///< what it may be
  std::string elementKind;  ///< "cell", "face", "triangle", ... of the worst deviation; empty if none
  int64_t element = -1;
  std::string message;  ///< for people, in plain sentences: what is wrong, or why it was skipped, or what was left out; may be empty
};

struct Validation {
  bool pass = true;
  std::vector<Check> checks;
};

/// The first check of validate(): lengths, offsets and id ranges. All functions that take a cut-mesh need one that passes, as those of
/// cut() do; one that comes from elsewhere may not. Without its input mesh, tri-vertex ids can't be held against it.
Check checkArrays(const CutMesh& cutMesh, const MeshView* mesh = nullptr);

struct ValidateOptions : RunOptions {
  double snapTolerance = 0;  ///< that of the cut
};

/// The paper's four checks (5.6) and the invariants of a cut-mesh. `mesh` is the input. Any arrays may be passed: if they don't fit
/// together, or not to the mesh, the first check says so and is the only one. Throws CallError if cancelled, or if the
/// snap tolerance is none that cut() takes.
Validation validate(const MeshView& mesh, const CutMesh& cutMesh, const ValidateOptions& options = {});

}  // namespace mandoline

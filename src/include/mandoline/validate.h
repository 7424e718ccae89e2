// Checks of a cut-mesh against its input, worked out from its arrays alone: nothing that the cutter knew is trusted.
#pragma once

#include "mandoline/mandoline.h"

namespace mandoline {

struct Check {
  std::string name;  ///< e.g. "surfaceArea"
  bool pass = true;
  bool skipped = false;  ///< does not apply to this input, e.g. winding numbers of an open mesh
  double worst =
      0;  ///< largest deviation found: in roundings (half units in the last place of the largest coordinate), or a number of violations
  double tolerance = 0;     ///< what it may be
  std::string elementKind;  ///< "cell", "face", "triangle", ... of the worst deviation; empty if none
  int64_t element = -1;
  std::string message;  ///< why it fails, or what was left out; may be empty
};

struct Validation {
  bool pass = true;
  std::vector<Check> checks;
};

/// The first check of validate(): lengths, offsets and id ranges. All functions that take a cut-mesh need one that passes, as those of
/// cut() do; one that comes from elsewhere may not. Without its input mesh, tri-vertex ids can't be held against it.
Check checkArrays(const CutMesh& cutMesh, const MeshView* mesh = nullptr);

/// The paper's four checks (5.6) and the invariants of a cut-mesh. `mesh` is the input, `snapTolerance` that of the cut.
Validation validate(const MeshView& mesh, const CutMesh& cutMesh, double snapTolerance = 0);

}  // namespace mandoline

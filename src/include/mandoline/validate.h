// Checks of a cut-mesh against its input, worked out from its arrays alone: nothing that the cutter knew is trusted.
#pragma once

#include "mandoline/cell_complex.h"

namespace MANDOLINE_API mandoline {

/// One thing that was looked at.
struct Check {
  std::string name;      ///< e.g. "surfaceArea"
  bool pass = true;      ///< true also if skipped
  bool skipped = false;  ///< whether it does not apply to this input, e.g. winding numbers of an open mesh
  /// What was found: the number of violations; or where tolerance is above 0 the largest deviation, in roundings (half units in the last
  /// place of the largest coordinate). NaN where it can't be computed.
  double worst = 0;
  double tolerance = 0;     ///< the largest `worst` that passes
  std::string elementKind;  ///< what the worst was found at: "cell", "face", "triangle", ...; empty if nothing
  int64_t element = -1;     ///< its id, or -1
  std::string message;      ///< for people, in plain sentences: what is wrong, or why it was skipped, or what was left out; may be empty

  static void fields(auto& self, const auto& f) {
    f("name", self.name);
    f("pass", self.pass);
    f("skipped", self.skipped);
    f("worst", self.worst);
    f("tolerance", self.tolerance);
    f("elementKind", self.elementKind);
    f("element", self.element);
    f("message", self.message);
  }
};

/// All of them.
struct Validation {
  bool pass = true;  ///< whether all do
  std::vector<Check> checks;

  static void fields(auto& self, const auto& f) {
    f("pass", self.pass);
    f("checks", self.checks);
  }
};

/// The first check of validate(): lengths, offsets and id ranges. All other functions that take a cut-mesh rely on it. What cut() gives
/// passes; a cut-mesh from elsewhere should be checked first. Without `mesh`, its input, tri-vertex ids are not checked against it.
Check checkArrays(const CutMesh& cutMesh, const MeshView* mesh = nullptr);

/// The same for a cell complex: lengths, offsets and id ranges; faces and cells name each other; numbers are finite. What cellComplex() and
/// subComplex() give passes.
Check checkArrays(const CellComplex& cells);

/// The paper's four checks (5.6) and the invariants of a cut-mesh. `mesh` is the input. Any arrays may be passed: if they don't fit
/// together or don't fit the mesh, the first check says so and is the only one. Throws CallError if cancelled.
Validation validate(const MeshView& mesh, const CutMesh& cutMesh, const RunOptions& options = {});

}  // namespace mandoline

// The reports of info and cut, as JSON for programs and as text for people.
#pragma once

#include <optional>
#include <string>

#include "mandoline/inspect.h"
#include "mandoline/mandoline.h"
#include "mandoline/mesh_files.h"
#include "mandoline/validate.h"

namespace mandoline::cli {

/// What info tells, and the head of what cut tells.
struct MeshReport {
  std::string name;  ///< path, or "standard input"
  MeshInfo info;
  /// Of info, with one pair; none for meshes that can't be searched.
  std::optional<MeshIntersections> intersections;
  TriangleGroups groups;
};

/// Everything there is to tell of a cut; both forms tell the same.
struct Report {
  MeshReport mesh;
  const Grid& grid;
  const CutResult& result;
  bool looksForIntersections = true;
  size_t peakMemoryBytes = 0;
  std::vector<double> regionVolumes;     ///< per region
  std::optional<Validation> validation;  ///< if it was asked for and the cut is ok
};

std::string infoJson(const MeshReport& mesh);
std::string infoText(const MeshReport& mesh);
std::string reportJson(const Report& report);
std::string reportText(const Report& report);

/// For example "10 crossing, 2 touching".
std::string describePairs(const PairCounts& pairs);

/// One line about a check that does not pass: its name, the offending element and why.
std::string describeFailure(const Check& check);

}  // namespace mandoline::cli

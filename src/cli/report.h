// The report of cut, as JSON for programs and as text for people.
#pragma once

#include <optional>
#include <string>

#include "cli/make_grid.h"
#include "cli/mesh_report.h"
#include "mandoline/mandoline.h"
#include "mandoline/validate.h"

namespace mandoline::cli {

/// How many cells there were before small ones were merged, and are then; and how many of those are still small.
struct MergeCounts {
  size_t before, after, pockets;
};
MergeCounts countMerged(const MergedCells& merged);
/// As the member "merge"; null if nothing was to be merged.
void addMerge(Json& json, const std::optional<MergeCounts>& counts);

/// Of a cut by several processes, what one of them has done.
struct RankReport {
  uint64_t cutCells = 0, peakMemoryBytes = 0, bytesSent = 0;
  double processorMs = 0;  ///< of all its threads
};

/// A table of them, and as the member "ranks"; nothing if there are none.
std::string ranksText(const std::vector<RankReport>& ranks);
void addRanks(Json& json, const std::vector<RankReport>& ranks);

/// Everything there is to tell of a cut; both forms tell the same.
struct Report {
  MeshReport mesh;
  const AskedGrid& grid;
  const CutResult& result;  ///< of several processes it may be without vertices, faces and cut-cells
  size_t peakMemoryBytes = 0;
  std::vector<double> regionVolumes;     ///< per region
  std::optional<Validation> validation;  ///< if it was asked for and the cut is ok
  double insideThreshold = 0.5;          ///< see InsideOptions
  std::optional<MergeCounts> merge;      ///< if it was asked for
  CutCounts counts;                      ///< of all processes
  std::vector<RankReport> ranks;         ///< by rank; empty of one process
};

std::string reportJson(const Report& report);
std::string reportText(const Report& report);

/// The grid in a line, and as a member of an open object.
std::string headline(const AskedGrid& asked);
void addGrid(Json& json, const AskedGrid& asked);

/// One line about a check that does not pass: its name, the offending element and why.
std::string describeFailure(const Check& check);

}  // namespace mandoline::cli

#include "cli/report.h"

#include <algorithm>
#include <cmath>
#include <iomanip>
#include <sstream>

#include "cli/inside.h"

namespace mandoline::cli {
namespace {

std::vector<Count> cutMeshCounts(const CutCounts& c) {
  return {{"cutCells", "cut-cells", c.cutCells},
          {"untouchedCells", "untouched grid cells", c.untouchedCells},
          {"cells", "cells in total", c.cutCells + c.untouchedCells},
          {"regions", "regions", c.regions},
          {"vertices", "cut-vertices", c.vertices},
          {"faces", "cut-faces", c.faces},
          {"loops", "loops of cut-faces", c.loops}};
}

/// What was unusual about the input.
std::vector<Count> inputCounts(const CutResult& result) {
  const CutStats& s = result.stats;
  return {{"droppedTriangles", "dropped triangles", result.mesh.droppedTriangles.size()},
          {"zeroAreaTriangles", "  of zero area", s.zeroAreaTriangles},
          {"outsideTriangles", "  outside the grid", s.outsideTriangles},
          {"duplicateTriangles", "duplicate triangles", s.duplicateTriangles},
          {"weldedVertices", "welded vertices", s.weldedVertices},
          {"snappedVertices", "snapped vertices", s.snappedVertices},
          {"flushedCoordinates", "coordinates taken as 0", s.flushedCoordinates}};
}

std::vector<Count> mergeCounts(const MergeCounts& counts) {
  return {{"before", "cells before", counts.before}, {"after", "cells after", counts.after}, {"pockets", "  still small", counts.pockets}};
}

/// Null where nobody has looked for them, or not to the end.
void addIntersections(Json& json, const Report& report) {
  const CutStats& stats = report.result.stats;
  const auto isStage = [](const StageTime& time) { return std::string_view(time.stage) == "intersections"; };
  const auto stage = std::find_if(stats.stages.begin(), stats.stages.end(), isStage);
  if (stage == stats.stages.end() || report.result.error.status == Status::selfIntersection) {
    json.key("intersections").null();
    return;
  }
  addPairs(json, "intersections", stats.intersections);
  json.member("curves", stats.intersectionCurves).member("madeVertices", stats.madeVertices).member("ms", stage->ms).close('}');
}

void addValidation(Json& json, const std::optional<Validation>& validation) {
  json.key("validation");
  if (!validation) {
    json.null();
    return;
  }
  json.open('{').member("pass", validation->pass).key("checks").open('[');
  for (const Check& check : validation->checks) {
    json.open('{').member("name", check.name).member("pass", check.pass).member("skipped", check.skipped).member("worst", check.worst);
    json.member("tolerance", check.tolerance).member("elementKind", check.elementKind);
    json.element("element", check.element);
    json.member("message", check.message).close('}');
  }
  json.close(']').close('}');
}

/// Text in columns.
class TextReport {
 public:
  explicit TextReport(const Report& report) : report_(report), mesh_(report.result.mesh) {}

  std::string text() {
    addHead();
    if (report_.result) {
      addCounts();
      if (report_.merge) addMerge(*report_.merge);
      addRegions();
    }
    addStages();
    out_ << ranksText(report_.ranks);
    if (report_.validation) addValidation(*report_.validation);
    return out_.str();
  }

 private:
  static constexpr int kLabelWidth = 26, kNumberWidth = 12;
  static constexpr uint32_t kMostRegions = 20;

  void addHead() {
    out_ << headline(report_.mesh) << headline(report_.grid);
    if (report_.result) return;
    out_ << "\nNot cut: " << name(report_.result.error.status) << "\n  " << report_.result.error.message << "\n";
  }

  void addCounts() {
    out_ << "\nCounts\n";
    for (const Count& count : cutMeshCounts(report_.counts)) addCount(count);
    const std::vector<Count> unusual = inputCounts(report_.result);
    for (const Count& count : unusual) {
      if (count.value > 0) addCount(count);
    }
    const CutStats& stats = report_.result.stats;
    if (stats.intersections.total() > 0) {
      addCount({"", "intersecting pairs", stats.intersections.total()});
      for (const Count& count : pairCounts(stats.intersections)) {
        if (count.value > 0) label("  " + std::string(count.label)) << std::setw(kNumberWidth) << count.value << "\n";
      }
      addCount({"", "  curves", stats.intersectionCurves});
      addCount({"", "  made vertices", stats.madeVertices});
    }
    if (stats.snappedVertices > 0) label("largest snap (cells)") << std::setw(kNumberWidth) << stats.largestSnap << "\n";
  }

  void addMerge(const MergeCounts& counts) {
    out_ << "\nMerging of small cells\n";
    for (const Count& count : mergeCounts(counts)) addCount(count);
  }

  void addRegions() {
    const std::optional<InsideRegions> inside = insideOf(mesh_, report_.insideThreshold);
    const std::string how = describeInside(inside, report_.result.stats.parts);
    out_ << "\nRegions" << (how.empty() ? "" : " (" + how + ")") << "\n  " << std::setw(8) << "id" << std::setw(10) << "winding"
         << std::setw(10) << "inside" << std::setw(16) << "volume"
         << "\n";
    const uint32_t shown = std::min(mesh_.regionCount, kMostRegions);
    for (uint32_t r = 0; r < shown; ++r) {
      out_ << "  " << std::setw(8) << r << std::setw(10) << (mesh_.hasWinding ? std::to_string(mesh_.regionWinding[r]) : "-")
           << std::setw(10)
           << (!inside               ? "-"
               : inside->isInside[r] ? "yes"
                                     : "no")
           << std::setw(16) << volumeText(report_.regionVolumes[r]) << "\n";
    }
    if (shown < mesh_.regionCount) out_ << "  and " << mesh_.regionCount - shown << " more\n";
    if (report_.result.stats.parts.open > 0 && mesh_.regionInsideness.empty()) {
      out_ << "  --inside-threshold " << report_.insideThreshold << " estimates what is inside of open parts\n";
    }
  }

  void addStages() {
    out_ << "\nStages (ms)\n" << std::fixed << std::setprecision(2);
    for (const StageTime& stage : report_.result.stats.stages) label(stage.stage) << std::setw(kNumberWidth) << stage.ms << "\n";
    label("total") << std::setw(kNumberWidth) << report_.result.stats.totalMs << "\n\n";
    label("Peak memory (MB)") << std::setw(kNumberWidth) << double(report_.peakMemoryBytes) / 1e6 << "\n";
    label("Exact fallbacks") << std::setw(kNumberWidth) << report_.result.stats.exactFallbacks << "\n";
    out_ << std::defaultfloat << std::setprecision(6);
  }

  void addValidation(const Validation& validation) {
    out_ << "\nValidation: " << (validation.pass ? "pass" : "FAIL") << "\n  " << std::left << std::setw(28) << "check" << std::setw(9)
         << "verdict" << std::setw(14) << "worst" << std::setw(14) << "tolerance"
         << "element\n";
    for (const Check& check : validation.checks) {
      out_ << "  " << std::setw(28) << check.name << std::setw(9) << (check.skipped ? "skipped" : check.pass ? "pass" : "FAIL");
      if (!check.skipped) out_ << std::setw(14) << check.worst << std::setw(14) << check.tolerance << element(check);
      out_ << "\n";
      if (!check.message.empty()) out_ << "    " << check.message << "\n";
    }
    out_ << std::right;
  }

  /// A dash where doubles overflow: there the JSON report has null.
  static std::string volumeText(double volume) {
    if (!std::isfinite(volume)) return "-";
    std::ostringstream text;
    text << volume;
    return text.str();
  }
  static std::string element(const Check& check) {
    return check.elementKind.empty() ? "-" : check.elementKind + " " + std::to_string(check.element);
  }
  std::ostream& label(const std::string& text) { return out_ << "  " << std::left << std::setw(kLabelWidth) << text << std::right; }
  void addCount(const Count& count) { label(count.label) << std::setw(kNumberWidth) << count.value << "\n"; }

  const Report& report_;
  const CutMesh& mesh_;
  std::ostringstream out_;
};

}  // namespace

void addRanks(Json& json, const std::vector<RankReport>& ranks) {
  json.key("ranks").open('[');
  for (const RankReport& r : ranks) {
    json.open('{').member("cutCells", r.cutCells).member("processorMs", r.processorMs).member("peakMemoryBytes", r.peakMemoryBytes);
    json.member("bytesSent", r.bytesSent).close('}');
  }
  json.close(']');
}

std::string ranksText(const std::vector<RankReport>& ranks) {
  if (ranks.empty()) return "";
  std::ostringstream out;
  out << "\nProcesses\n  " << std::setw(8) << "rank" << std::setw(14) << "cut-cells" << std::setw(14) << "CPU (ms)" << std::setw(14)
      << "memory (MB)" << std::setw(14) << "sent (MB)"
      << "\n"
      << std::fixed << std::setprecision(2);
  for (size_t rank = 0; rank < ranks.size(); ++rank) {
    const RankReport& r = ranks[rank];
    out << "  " << std::setw(8) << rank << std::setw(14) << r.cutCells << std::setw(14) << r.processorMs << std::setw(14)
        << double(r.peakMemoryBytes) / 1e6 << std::setw(14) << double(r.bytesSent) / 1e6 << "\n";
  }
  return out.str();
}

MergeCounts countMerged(const MergedCells& merged) { return {merged.mergedCell.size(), merged.cells.cellCount(), merged.pockets.size()}; }

void addMerge(Json& json, const std::optional<MergeCounts>& counts) {
  json.key("merge");
  if (!counts) {
    json.null();
    return;
  }
  json.open('{');
  for (const Count& count : mergeCounts(*counts)) json.member(count.key, count.value);
  json.close('}');
}

std::string headline(const AskedGrid& asked) {
  const auto& [g, cells] = asked;
  std::ostringstream out;
  out << "Grid of " << cells[0] << " x " << cells[1] << " x " << cells[2] << " cells";
  if (g.uniform) out << ", " << triple(g.spacing.data(), " x ") << " each, from (" << triple(g.origin.data(), ", ") << ")";
  return out.str() + "\n";
}

void addGrid(Json& json, const AskedGrid& asked) {
  json.key("grid").open('{').key("origin").values(asked.grid.origin).key("spacing");
  if (asked.grid.uniform) {
    json.values(asked.grid.spacing);
  } else {
    json.null();
  }
  json.key("cells").values(asked.cells).close('}');
}

std::string reportJson(const Report& report) {
  const CutStats& stats = report.result.stats;
  Json json;
  addHead(json, report.result.error, report.mesh);
  addGrid(json, report.grid);
  json.key("counts").open('{');
  for (const Count& count : cutMeshCounts(report.counts)) json.member(count.key, count.value);
  for (const Count& count : inputCounts(report.result)) json.member(count.key, count.value);
  json.close('}').member("largestSnap", stats.largestSnap);
  addIntersections(json, report);
  const std::optional<InsideRegions> inside = report.result ? insideOf(report.result.mesh, report.insideThreshold) : std::nullopt;
  addInside(json, stats.parts, inside);
  addRegions(json, report, inside);
  json.key("stages").open('[');
  for (const StageTime& stage : stats.stages) json.open('{').member("stage", stage.stage).member("ms", stage.ms).close('}');
  json.close(']').member("totalMs", stats.totalMs).member("exactFallbacks", stats.exactFallbacks);
  json.member("peakMemoryBytes", report.peakMemoryBytes);
  if (!report.ranks.empty()) addRanks(json, report.ranks);
  addMerge(json, report.merge);
  addValidation(json, report.validation);
  json.close('}');
  return json.text();
}

std::string reportText(const Report& report) { return TextReport(report).text(); }

std::string describeFailure(const Check& check) {
  std::string text = check.name;
  if (!check.elementKind.empty()) text += " at " + check.elementKind + " " + std::to_string(check.element);
  if (!check.message.empty()) text += ": " + check.message;
  return text;
}

}  // namespace mandoline::cli

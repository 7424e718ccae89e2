// What the commands that cut have in common.
#pragma once

#include <functional>
#include <optional>

#include "cli/arguments.h"
#include "cli/files.h"
#include "cli/progress_bar.h"
#include "cli/report.h"

namespace mandoline::cli {

/// In the name of an output of cut: one file for each region.
inline constexpr std::string_view kRegionMark = "{region}";

/// The mesh and the report, which no output may overwrite, nor the report the mesh: for requireDifferent(). Throws FileError for a report
/// in a folder that does not exist.
std::vector<NamedFile> filesBesideOutputs(const Arguments& arguments);

/// Throws UsageError for an output of a format that is not allowed, `rule` saying which are, for a name with {region}, and if two of the
/// files are the same; FileError for one in a folder that does not exist.
void checkOutputs(const Arguments& arguments, bool (*isAllowed)(FileFormat), const std::string& rule);

/// Calls work(). If a file can't be written, or there is nothing to write, says so and sets the exit code; the caller goes on with other
/// files.
void attempt(int& exitCode, const std::function<void()>& work);

/// Attempts write(output) for every output. Gives the exit code, which is that of what went before unless a file can't be written.
int writeOutputs(const Arguments& arguments, const std::function<void(const std::string&)>& write, int exitCode = 0);

/// Whether one of the outputs is standard output.
bool takesStandardOutput(const Arguments& arguments);

/// Writes the report as JSON where --report says, if it does.
void writeReport(const Arguments& arguments, const std::function<std::string()>& json);

/// Says why there is nothing to write, in the report too. Gives the exit code.
int failWith(const Arguments& arguments, const std::string& meshName, const Outcome& outcome, const std::function<std::string()>& json);

/// Writes the report as JSON where --report says, or as text to standard output; to standard error if one of the outputs is there.
void deliver(const Arguments& arguments, const std::function<std::string()>& text, const std::function<std::string()>& json);

/// The error of a cut; of a grid that is too large also how many cells were asked for.
Error withSize(Error error, const Arguments& arguments, const AskedGrid& asked);

/// Whether the command has to know which regions are inside.
bool needsInside(const Arguments& arguments);

/// Cuts; and where parts are open, estimates what is inside, if the command has to know. With progress.
CutResult cutMesh(const Arguments& arguments, const Mesh& mesh, const AskedGrid& asked);

/// Estimates what is inside of open parts. With progress.
void findInside(const Arguments& arguments, const Mesh& mesh, CutMesh& cutMesh);

/// The report of a cut, without the volumes of regions and the validation.
Report reportOf(const Arguments& arguments, MeshReport mesh, const AskedGrid& grid, const CutResult& result);

/// Cuts with the grid that is asked for. If that fails, says why, also in the report if there is to be one, and gives nothing.
std::optional<CutResult> cutOrComplain(const Arguments& arguments, const Input& input, const GridArguments& grid);

/// The regions inside, by the threshold that was asked for; nothing if nothing is known of any.
std::optional<InsideRegions> insideOf(const Arguments& arguments, const CutMesh& cutMesh);

/// All cells, merged or not.
struct MadeCells : MergedCells {
  std::optional<CutMesh> refined;

  /// That which goes with the cells, of which `whole` is the grid's.
  const CutMesh& cutMesh(const CutMesh& whole) const { return refined ? *refined : whole; }
};

/// All cells: refined as --refine and --refine-box say, untouched ones merged as far as --coarsen does and small ones as --merge does,
/// their walls united as --unite-walls does. With progress.
MadeCells makeCells(const Arguments& arguments, const Input& input, const CutMesh& cutMesh);

/// --merge, or what it is by default.
double mergeFraction(const Arguments& arguments);
/// What --coarsen says: with maxLevel 0 untouched cells are as they are.
CoarsenOptions coarsenOptions(const Arguments& arguments, const RunOptions& run);

/// What --only selects. Says on standard error what tells inside from outside, unless the whole input has winding numbers. Throws
/// UsageError for regions that the cut-mesh does not have, and for --only inside if nothing is known to be inside.
WriteOptions writeOptions(const Arguments& arguments, const CutResult& cut);

/// Throws UsageError if the options select no cell at all.
void requireSelection(const WriteOptions& options, const CutMesh& cutMesh);

/// Of an output whose extension or --format has been checked.
FileFormat formatFor(const Arguments& arguments, const std::string& output);

/// "path: status: message".
std::string refusal(const std::string& meshName, const Outcome& outcome);

}  // namespace mandoline::cli

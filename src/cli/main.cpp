// The command line: reads, cuts, reports, writes. What the words mean is in arguments.cpp.
#include <sys/resource.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cstring>
#include <exception>
#include <filesystem>
#include <fstream>
#include <iostream>
#include <new>

#include "cli/arguments.h"
#include "cli/inspect.h"
#include "cli/peak_memory.h"
#include "cli/progress_bar.h"
#include "cli/report.h"
#include "mandoline/io.h"
#include "mandoline/measure.h"

namespace mandoline::cli {
namespace {

enum ExitCode { kFine = 0, kNotCut = 1, kBadUsageOrFile = 2 };

void complain(const std::string& message) { std::cerr << "mandoline: " << message << "\n"; }

/// Lets allocations beyond the machine's memory fail, so that a cut too large for it ends with a status rather than by the system's hand.
void limitMemory() {
#if !defined(__SANITIZE_ADDRESS__) && defined(_SC_PHYS_PAGES)
  const long pages = sysconf(_SC_PHYS_PAGES), pageSize = sysconf(_SC_PAGESIZE);
  rlimit limit{};
  if (pages <= 0 || pageSize <= 0 || getrlimit(RLIMIT_DATA, &limit) != 0) return;
  const rlim_t most = rlim_t(pages) / 10 * 9 * rlim_t(pageSize);
  if (limit.rlim_cur != RLIM_INFINITY && limit.rlim_cur <= most) return;
  limit.rlim_cur = most;
  setrlimit(RLIMIT_DATA, &limit);
#endif
}

Grid makeGrid(const Arguments& arguments, const Mesh& mesh) {
  if (arguments.box) return Grid::box(arguments.box->low, arguments.box->high, arguments.cells);
  if (!arguments.cellsPerAxis) return Grid::around(mesh, arguments.cells[0]);
  Box box = boundingBox(mesh);
  double longest = 0;
  for (size_t d = 0; d < 3; ++d) longest = std::max(longest, box.high[d] - box.low[d]);
  if (!(longest > 0)) longest = 1;
  for (size_t d = 0; d < 3; ++d) {
    box.low[d] -= 0.05 * longest;
    box.high[d] += 0.05 * longest;
  }
  return Grid::box(box.low, box.high, arguments.cells);
}

CutResult cutWithProgress(const Arguments& arguments, const Mesh& mesh, const Grid& grid) {
  ProgressBar bar;
  CutOptions options;
  options.snapTolerance = arguments.snapTolerance;
  options.threads = arguments.threads;
  options.progress = [&](const Progress& progress) { return bar.update(progress); };
  return cut(mesh, grid, options);
}

/// Text goes to standard output, JSON to where --report says.
void deliver(const Arguments& arguments, const std::string& report) {
  if (arguments.report.empty() || arguments.report == "-") {
    if (!(std::cout << report << std::flush)) throw FileError("standard output: can't be written");
    return;
  }
  errno = 0;
  std::ofstream file(arguments.report, std::ios::binary);
  file << report;
  file.close();
  if (!file) throw FileError(arguments.report + ": can't be written" + (errno ? std::string(": ") + std::strerror(errno) : ""));
}

/// Every report and cut-mesh gets its chance, even if another can't be written.
template <class Work>
void attempt(int& exitCode, const Work& work) {
  try {
    work();
  } catch (const FileError& error) {
    complain(error.what());
    exitCode = kBadUsageOrFile;
  }
}

void checkOutputs(const Arguments& arguments) {
  for (const std::string& output : arguments.outputs) {
    checkOutput(output);
    std::error_code ignored;
    if (std::filesystem::equivalent(output, arguments.mesh, ignored)) throw UsageError("-o " + output + " would overwrite the mesh");
  }
}

int runCut(const Arguments& arguments) {
  checkOutputs(arguments);
  const Mesh mesh = readMesh(arguments.mesh);
  const Grid grid = makeGrid(arguments, mesh);
  const CutResult result = cutWithProgress(arguments, mesh, grid);
  Report report{arguments, mesh, grid, result, peakMemoryBytes(), {}, {}};
  int exitCode = kFine;
  if (!result) {
    complain(arguments.mesh + ": " + name(result.error.status) + ": " + result.error.message);
    exitCode = kNotCut;
  } else {
    report.regionVolumes = regionVolumes(result.mesh, measure(mesh, result.mesh));
    if (arguments.validate) report.validation = validate(mesh, result.mesh, arguments.snapTolerance);
  }
  if (report.validation && !report.validation->pass) {
    for (const Check& check : report.validation->checks) {
      if (!check.pass) complain(arguments.mesh + ": validation failed: " + describeFailure(check));
    }
    exitCode = kNotCut;
  }
  attempt(exitCode, [&] { deliver(arguments, arguments.report.empty() ? reportText(report) : reportJson(report)); });
  if (!result) return exitCode;
  for (const std::string& output : arguments.outputs) attempt(exitCode, [&] { writeCutMesh(output, mesh, result.mesh); });
  return exitCode;
}

int runInfo(const Arguments& arguments) {
  const Mesh mesh = readMesh(arguments.mesh);
  const MeshInfo info = inspect(mesh);
  deliver(arguments, arguments.report.empty() ? infoText(arguments.mesh, info) : infoJson(arguments.mesh, info));
  return kFine;
}

int run(const std::vector<std::string>& words) {
  const Arguments arguments = parseArguments(words);
  switch (arguments.command) {
    case Command::help:
      std::cout << kHelp;
      return kFine;
    case Command::version:
      std::cout << "mandoline " << MANDOLINE_VERSION << "\n";
      return kFine;
    case Command::cut:
      return runCut(arguments);
    case Command::info:
      return runInfo(arguments);
  }
  return kBadUsageOrFile;
}

}  // namespace
}  // namespace mandoline::cli

int main(int argc, char** argv) {
  using namespace mandoline::cli;
  limitMemory();
  try {
    return run(std::vector<std::string>(argv + 1, argv + argc));
  } catch (const UsageError& error) {
    complain(error.what());
    std::cerr << "Try 'mandoline --help'.\n";
    return kBadUsageOrFile;
  } catch (const mandoline::FileError& error) {
    complain(error.what());
    return kBadUsageOrFile;
  } catch (const std::bad_alloc&) {
    complain("there is not enough memory");
    return kNotCut;
  } catch (const std::exception& error) {
    complain(error.what());
    return kNotCut;
  }
}

// The benchmark: times cuts on one thread and two beside their lower bound, and beside those of another build and of WebAssembly.
#include <algorithm>
#include <filesystem>
#include <iostream>
#include <stdexcept>

#include "cli/bench/made_meshes.h"
#include "cli/bench/measure.h"
#include "cli/bench/tables.h"
#include "cli/mesh_paths.h"
#include "cli/values.h"

namespace mandoline::bench {
namespace {

namespace fs = std::filesystem;

constexpr const char* kHelp =
    R"(mandoline-bench [MESH N]... [--meshes FOLDER] [--cells N,...] [--repetitions R] [--compare PROGRAM]
                [--wasm COMMAND] [--markdown | --json]

Cuts meshes with the default grid of N cells along their longest side, on one thread, and prints per mesh and N:
  bound       ms of the lower bound: clip the triangles and sort the pieces by grid cell, in plain doubles
  cut         ms of the cut without reading the file, all stages
  ratio       cut / bound
  two         ms of the same cut on two threads, by the clock, and how many times that is as fast as on one
  peak        MB that the process needed, the input mesh and reading it included
  peak/out    the same over the size of the cut-mesh's arrays
  stages      of each stage: ms, ms of those on two threads that the second one does not shorten, page faults
Times are processor time, except those on two threads and of the stages, which are by the clock. Each is the median of
R fresh processes (default 5), which take turns.

  MESH N             this mesh at this N
  --meshes FOLDER    every mesh in the folder, at each N of --cells
  --cells N,...      default 50,100
  --compare PROGRAM  the mandoline-bench of another build, which takes its turns, too: its ms on one thread, and cut
                     over these
  --wasm COMMAND     what cuts in WebAssembly takes its turns, too: the command gets MESH N as last words, and prints ms
                     and the number of cut-cells
  --markdown         the table of the README
  --json             all numbers
Without MESH N also a few meshes that this program makes. A mesh that can't be cut is left out.
)";

using cli::UsageError;

struct Arguments {
  std::vector<Job> jobs;
  std::vector<int64_t> cells = {50, 100};
  std::string folder, compared, wasm;
  int64_t repetitions = 5;
  void (*print)(const std::vector<Row>&) = printText;
};

int64_t parseCount(const std::string& word, const char* what) {
  int64_t n = 0;
  if (!cli::parseNumber(word, n) || n < 1) throw UsageError(std::string(what) + " must be a whole number above 0, not " + word);
  return n;
}

std::vector<int64_t> parseCounts(const std::string& word) {
  const std::vector<int64_t> counts = cli::parseList<int64_t>(word);
  if (counts.empty() || *std::min_element(counts.begin(), counts.end()) < 1)
    throw UsageError("--cells needs whole numbers above 0, not " + word);
  return counts;
}

/// The file's name up to its first dot.
std::string nameOf(const fs::path& path) {
  const std::string file = path.filename().string();
  return file.substr(0, file.find('.'));
}

Arguments parse(const std::vector<std::string>& words) {
  Arguments arguments;
  for (size_t i = 0; i < words.size(); ++i) {
    const std::string& word = words[i];
    if (word == "--markdown" || word == "--json") {
      arguments.print = word == "--json" ? printJson : printMarkdown;
      continue;
    }
    const bool takesValue = word == "--meshes" || word == "--cells" || word == "--repetitions" || word == "--compare" || word == "--wasm";
    if (!takesValue && word.compare(0, 2, "--") == 0) throw UsageError("unknown option " + word);
    if (i + 1 == words.size()) throw UsageError("what follows " + word + " is missing");
    const std::string& value = words[++i];
    if (word == "--meshes")
      arguments.folder = value;
    else if (word == "--compare")
      arguments.compared = value;
    else if (word == "--wasm")
      arguments.wasm = value;
    else if (word == "--cells")
      arguments.cells = parseCounts(value);
    else if (word == "--repetitions")
      arguments.repetitions = parseCount(value, "R");
    else
      arguments.jobs.push_back({nameOf(word), word, parseCount(value, "N")});
  }
  return arguments;
}

std::vector<Job> jobsIn(const fs::path& folder, const std::vector<int64_t>& cells) {
  std::vector<Job> jobs;
  for (const fs::path& path : cli::meshesIn(folder)) {
    for (const int64_t n : cells) jobs.push_back({nameOf(path), path.string(), n});
  }
  return jobs;
}

std::vector<Job> jobsOf(const Arguments& arguments, const MadeMeshes& madeMeshes) {
  std::vector<Job> jobs = arguments.jobs;
  const auto add = [&](const std::vector<Job>& more) { jobs.insert(jobs.end(), more.begin(), more.end()); };
  if (!arguments.folder.empty()) add(jobsIn(arguments.folder, arguments.cells));
  if (arguments.jobs.empty()) add(madeMeshes.jobs(arguments.cells));
  return jobs;
}

Programs findPrograms(const char* asCalled, const Arguments& arguments) {
  std::error_code problem;
  const fs::path linked = fs::read_symlink("/proc/self/exe", problem);
  const fs::path self = problem ? fs::absolute(asCalled) : linked, lowerBound = self.parent_path() / "mandoline-lower-bound";
  if (!fs::exists(lowerBound)) throw std::runtime_error("the lower bound is missing: " + lowerBound.string());
  const std::string& compared = arguments.compared;
  if (!compared.empty() && !fs::exists(compared)) throw std::runtime_error("the program to compare with is missing: " + compared);
  return {self.string(), lowerBound.string(), compared.empty() ? "" : fs::absolute(compared).string(), arguments.wasm};
}

int run(const char* asCalled, const std::vector<std::string>& words) {
  if (words.size() >= 3 && words[0] == kCutOnce) {
    cutOnce(words[1], parseCount(words[2], "N"), words.size() > 3 ? unsigned(parseCount(words[3], "the number of threads")) : 1);
    return 0;
  }
  if (std::find(words.begin(), words.end(), "--help") != words.end()) {
    std::cout << kHelp;
    return 0;
  }
  const Arguments arguments = parse(words);
  const Programs programs = findPrograms(asCalled, arguments);
  const MadeMeshes madeMeshes;
  const std::vector<Job> jobs = jobsOf(arguments, madeMeshes);
  std::vector<Row> rows;
  for (const Job& job : jobs) {
    try {
      rows.push_back(measure(programs, job, arguments.repetitions));
    } catch (const std::runtime_error& error) {
      std::cerr << "left out: " << job.name << " at N = " << job.n << ": " << error.what() << '\n';
    }
  }
  if (rows.empty()) return 1;
  arguments.print(rows);
  return 0;
}

}  // namespace
}  // namespace mandoline::bench

int main(int argc, char** argv) {
  try {
    return mandoline::bench::run(argv[0], {argv + 1, argv + argc});
  } catch (const mandoline::bench::UsageError& error) {
    std::cerr << "mandoline-bench: " << error.what() << "\n" << mandoline::bench::kHelp;
    return 2;
  } catch (const std::exception& error) {
    std::cerr << "mandoline-bench: " << error.what() << "\n";
    return 1;
  }
}

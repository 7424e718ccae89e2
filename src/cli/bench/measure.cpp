#include "cli/bench/measure.h"

#include <sys/resource.h>
#include <sys/wait.h>

#include <algorithm>
#include <chrono>
#include <cstdio>
#include <iostream>
#include <sstream>
#include <stdexcept>

#include "cli/bench/cold_start.h"
#include "cli/peak_memory.h"
#include "mandoline/io.h"

namespace mandoline::bench {
namespace {

size_t bytesOf(const CutMesh& cutMesh) {
  size_t bytes = 0;
  forEachArray(cutMesh, [&](const ArrayInfo&, const auto& array) { bytes += array.size() * sizeof array[0]; });
  return bytes;
}

/// A word for the shell.
std::string quoted(const std::string& word) {
  std::string text = "'";
  for (const char c : word) text += c == '\'' ? std::string("'\\''") : std::string(1, c);
  return text + "'";
}

/// What a program prints, given a mesh, N and what follows. `program`: words for the shell.
std::istringstream outputOf(const std::string& program, const Job& job, const std::string& more = "") {
  const std::string command = program + ' ' + quoted(job.path) + ' ' + std::to_string(job.n) + more;
  FILE* pipe = popen(command.c_str(), "r");
  if (!pipe) throw std::runtime_error("can't run " + command);
  std::string text;
  char buffer[4096];
  while (const size_t count = fread(buffer, 1, sizeof buffer, pipe)) text.append(buffer, count);
  const int status = pclose(pipe);
  if (!WIFEXITED(status) || WEXITSTATUS(status) != 0) throw std::runtime_error("this failed: " + command);
  return std::istringstream(text);
}

double median(std::vector<double> values) {
  std::sort(values.begin(), values.end());
  const size_t half = values.size() / 2;
  return values.size() % 2 ? values[half] : (values[half - 1] + values[half]) / 2;
}

/// Fills all but what is measured on two threads.
void readCut(std::istringstream in, Row& row) {
  in >> row.triangles >> row.cutCells >> row.cutMs >> row.peakBytes >> row.outputBytes >> row.wallMs;
  if (!in) throw std::runtime_error("can't read what a cut of " + row.job.path + " printed");
  for (StageRow stage; in >> stage.name >> stage.ms >> stage.pageFaults;) row.stages.push_back(stage);
}

Row measureOnce(const Programs& programs, const Job& job) {
  const auto cutBy = [&](const std::string& program, const char* threads) {
    return outputOf(quoted(program) + ' ' + kCutOnce, job, threads);
  };
  Row row, onTwo;
  row.job = onTwo.job = job;
  outputOf(quoted(programs.lowerBound), job) >> row.lowerBoundMs;
  readCut(cutBy(programs.bench, ""), row);
  if (!programs.compared.empty()) {
    size_t triangles, cutCells;
    cutBy(programs.compared, "") >> triangles >> cutCells >> row.comparedMs;
  }
  if (!programs.wasm.empty()) {
    size_t cutCells = 0;
    outputOf(programs.wasm, job) >> row.wasmMs >> cutCells;
    if (cutCells != row.cutCells) throw std::runtime_error("WebAssembly makes another number of cut-cells: " + std::to_string(cutCells));
  }
  readCut(cutBy(programs.bench, " 2"), onTwo);
  row.wallMsOnTwo = onTwo.wallMs;
  for (size_t s = 0; s < row.stages.size(); ++s) row.stages[s].onTwoThreads = onTwo.stages.at(s).ms;
  return row;
}

double pageFaults() {
  rusage usage{};
  getrusage(RUSAGE_SELF, &usage);
  return double(usage.ru_minflt);
}

}  // namespace

void cutOnce(const std::string& path, int64_t n, unsigned threads) {
  const Mesh mesh = readMesh(path);
  const Grid grid = Grid::around(mesh, n);
  std::vector<double> faults;  // before each stage
  CutOptions options;
  options.threads = threads;
  options.progress = [&](const Progress& progress) {
    while (int(faults.size()) <= progress.stageIndex) faults.push_back(pageFaults());
    return true;
  };
  returnFreePages();
  const auto clock = std::chrono::steady_clock::now();
  const double start = processorMs();
  const CutResult result = cut(mesh, grid, options);
  const double ms = processorMs() - start;
  const std::chrono::duration<double, std::milli> wall = std::chrono::steady_clock::now() - clock;
  faults.push_back(pageFaults());
  if (!result) throw std::runtime_error(path + ": " + result.error.message);
  std::cout << mesh.triangleCount() << ' ' << result.mesh.cellCount() << ' ' << ms << ' ' << cli::peakMemoryBytes() << ' '
            << bytesOf(result.mesh) << ' ' << wall.count();
  for (size_t s = 0; s < result.stats.stages.size(); ++s) {
    const StageTime& stage = result.stats.stages[s];
    std::cout << ' ' << stage.stage << ' ' << stage.ms << ' ' << faults.at(s + 1) - faults[s];
  }
  std::cout << '\n';
}

Row measure(const Programs& programs, const Job& job, int64_t repetitions) {
  std::vector<Row> rows;
  for (int64_t r = 0; r < repetitions; ++r) rows.push_back(measureOnce(programs, job));
  const auto medianOf = [&](const auto& value) {
    std::vector<double> values;
    for (const Row& row : rows) values.push_back(value(row));
    return median(values);
  };
  Row result = rows[0];
  for (double Row::*of :
       {&Row::lowerBoundMs, &Row::cutMs, &Row::wallMs, &Row::wallMsOnTwo, &Row::peakBytes, &Row::comparedMs, &Row::wasmMs}) {
    result.*of = medianOf([of](const Row& row) { return row.*of; });
  }
  for (size_t s = 0; s < result.stages.size(); ++s) {
    for (double StageRow::*of : {&StageRow::ms, &StageRow::onTwoThreads, &StageRow::pageFaults}) {
      result.stages[s].*of = medianOf([of, s](const Row& row) { return row.stages.at(s).*of; });
    }
  }
  return result;
}

}  // namespace mandoline::bench

#include "cli/bench/measure.h"

#include <sys/wait.h>

#include <algorithm>
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

/// What a program prints, given a mesh and N.
std::istringstream outputOf(const std::string& program, const Job& job) {
  const std::string command = program + ' ' + quoted(job.path) + ' ' + std::to_string(job.n);
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

Row measureOnce(const Programs& programs, const Job& job) {
  Row row;
  row.job = job;
  outputOf(quoted(programs.lowerBound), job) >> row.lowerBoundMs;
  std::istringstream in = outputOf(quoted(programs.bench) + ' ' + kCutOnce, job);
  in >> row.triangles >> row.cutCells >> row.cutMs >> row.peakBytes >> row.outputBytes;
  if (!in) throw std::runtime_error("can't read what " + programs.bench + " printed");
  std::string stage;
  for (double ms; in >> stage >> ms;) {
    row.stages.push_back(stage);
    row.stageMs.push_back(ms);
  }
  return row;
}

}  // namespace

void cutOnce(const std::string& path, int64_t n) {
  const Mesh mesh = readMesh(path);
  const Grid grid = Grid::around(mesh, n);
  CutOptions options;
  options.threads = 1;
  returnFreePages();
  const double start = processorMs();
  const CutResult result = cut(mesh, grid, options);
  const double ms = processorMs() - start;
  if (!result) throw std::runtime_error(path + ": " + result.error.message);
  std::cout << mesh.triangleCount() << ' ' << result.mesh.cellCount() << ' ' << ms << ' ' << cli::peakMemoryBytes() << ' '
            << bytesOf(result.mesh);
  for (const StageTime& stage : result.stats.stages) std::cout << ' ' << stage.stage << ' ' << stage.ms;
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
  result.lowerBoundMs = medianOf([](const Row& row) { return row.lowerBoundMs; });
  result.cutMs = medianOf([](const Row& row) { return row.cutMs; });
  result.peakBytes = medianOf([](const Row& row) { return row.peakBytes; });
  for (size_t s = 0; s < result.stageMs.size(); ++s) result.stageMs[s] = medianOf([s](const Row& row) { return row.stageMs.at(s); });
  return result;
}

}  // namespace mandoline::bench

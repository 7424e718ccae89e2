#include "cli/bench/tables.h"

#include <algorithm>
#include <cstdio>
#include <iomanip>
#include <iostream>

#include "cli/bench/made_meshes.h"
#include "cli/json.h"

namespace mandoline::bench {
namespace {

using cli::Json;

std::string fixed(double value, int digits) {
  char text[64];
  std::snprintf(text, sizeof text, "%.*f", digits, value);
  return text;
}

/// Two cuts, and the time of the first over that of the second.
struct Comparison {
  const Row *a, *b;

  bool doubled() const { return a->job.path == b->job.path && a->job.n == 2 * b->job.n; }
  /// A mesh of few triangles beside one of many.
  bool fewTriangles() const { return a->job.name == kCube && b->triangles > 50000 && a->job.n == b->job.n; }
  double ratio() const { return a->cutMs / b->cutMs; }
  std::string label() const {
    return a->job.name + "(" + std::to_string(a->job.n) + ") / " + b->job.name + "(" + std::to_string(b->job.n) + ")";
  }
};

std::vector<Comparison> comparisons(const std::vector<Row>& rows) {
  std::vector<Comparison> found;
  for (const Row& a : rows) {
    for (const Row& b : rows) {
      const Comparison comparison{&a, &b};
      if (comparison.doubled() || comparison.fewTriangles()) found.push_back(comparison);
    }
  }
  return found;
}

/// "1.5 to 2.0", the values' smallest and largest.
std::string rangeOf(const std::vector<double>& values) {
  const auto [min, max] = std::minmax_element(values.begin(), values.end());
  return fixed(*min, 1) + " to " + fixed(*max, 1);
}

using Table = std::vector<std::vector<std::string>>;  // rows, the first one of titles

/// As Markdown, in columns of even width: names on the left, numbers on the right.
void printAligned(const Table& table) {
  std::vector<size_t> widths(table[0].size(), 3);  // Markdown's least
  for (size_t c = 0; c < widths.size(); ++c) {
    for (const auto& row : table) widths[c] = std::max(widths[c], row[c].size());
  }
  const auto printLine = [&](const std::vector<std::string>& row) {
    for (size_t c = 0; c < widths.size(); ++c)
      std::cout << "| " << std::setw(int(widths[c])) << (c == 0 ? std::left : std::right) << row[c] << ' ';
    std::cout << "|\n";
  };
  std::vector<std::string> rule;
  for (size_t c = 0; c < widths.size(); ++c) rule.push_back(std::string(widths[c] - 1, '-') + (c == 0 ? '-' : ':'));
  printLine(table[0]);
  printLine(rule);
  for (size_t r = 1; r < table.size(); ++r) printLine(table[r]);
}

}  // namespace

void printText(const std::vector<Row>& rows) {
  const int width = 11;
  size_t nameWidth = 4;
  for (const Row& row : rows) nameWidth = std::max(nameWidth, row.job.name.size());
  const auto printLine = [&](const std::string& name, const std::string& n, const std::vector<std::string>& items) {
    std::cout << std::left << std::setw(int(nameWidth)) << name << std::right << std::setw(6) << n;
    for (const std::string& item : items) std::cout << std::setw(width) << item;
    std::cout << '\n';
  };
  const bool isCompared = rows[0].comparedMs > 0, hasWasm = rows[0].wasmMs > 0;
  std::vector<std::string> titles = {"triangles", "cut-cells", "bound ms", "cut ms", "ratio", "two ms", "speed-up", "peak MB", "peak/out"};
  if (isCompared) titles.insert(titles.end(), {"other ms", "cut/other"});
  if (hasWasm) titles.insert(titles.end(), {"wasm ms", "wasm/cut"});
  printLine("mesh", "N", titles);
  for (const Row& row : rows) {
    std::vector<std::string> items = {
        std::to_string(row.triangles), std::to_string(row.cutCells),  fixed(row.lowerBoundMs, 2),
        fixed(row.cutMs, 2),           fixed(row.ratio(), 2),         fixed(row.wallMsOnTwo, 2),
        fixed(row.speedUp(), 2),       fixed(row.peakBytes / 1e6, 1), fixed(row.peakBytes / row.outputBytes, 2)};
    if (isCompared) items.insert(items.end(), {fixed(row.comparedMs, 2), fixed(row.cutMs / row.comparedMs, 2)});
    if (hasWasm) items.insert(items.end(), {fixed(row.wasmMs, 2), fixed(row.wasmMs / row.cutMs, 2)});
    printLine(row.job.name, std::to_string(row.job.n), items);
  }
  const auto printStages = [&](const char* title, int digits, const auto& valueOf) {
    std::cout << '\n' << title << '\n';
    std::vector<std::string> names;
    for (const StageRow& stage : rows[0].stages) names.push_back(stage.name);
    printLine("mesh", "N", names);
    for (const Row& row : rows) {
      std::vector<std::string> values;
      for (const StageRow& stage : row.stages) values.push_back(fixed(valueOf(stage), digits));
      printLine(row.job.name, std::to_string(row.job.n), values);
    }
  };
  printStages("ms of the stages", 2, [](const StageRow& stage) { return stage.ms; });
  printStages("ms of the stages on two threads that the second one does not shorten", 2,
              [](const StageRow& stage) { return stage.serialMs(); });
  printStages("page faults of the stages", 0, [](const StageRow& stage) { return stage.pageFaults; });
  const std::vector<Comparison> found = comparisons(rows);
  if (!found.empty()) std::cout << "\nms of one cut over another's\n";
  for (const Comparison& c : found) std::cout << fixed(c.ratio(), 2) << "  " << c.label() << '\n';
}

void printMarkdown(const std::vector<Row>& rows) {
  const bool hasWasm = rows[0].wasmMs > 0;
  Table table = {{"mesh", "N", "triangles", "cut-cells", "lower bound, ms", "cut, ms", "ratio", "two threads, ms"}};
  if (hasWasm) table[0].push_back("WebAssembly, ms");
  for (const Row& row : rows) {
    table.push_back({row.job.name, std::to_string(row.job.n), std::to_string(row.triangles), std::to_string(row.cutCells),
                     fixed(row.lowerBoundMs, 1), fixed(row.cutMs, 0), fixed(row.ratio(), 1), fixed(row.wallMsOnTwo, 0)});
    if (hasWasm) table.back().push_back(fixed(row.wasmMs, 0));
  }
  printAligned(table);
  std::vector<double> doubled, memory, wasm;
  for (const Comparison& c : comparisons(rows)) {
    if (c.doubled()) doubled.push_back(c.ratio());
  }
  for (const Row& row : rows) {
    memory.push_back(row.peakBytes / row.outputBytes);
    wasm.push_back(row.wasmMs / row.cutMs);
  }
  std::cout << '\n';
  if (!doubled.empty()) std::cout << "Doubling N costs " << rangeOf(doubled) << " times as much. ";
  std::cout << "Peak memory is " << rangeOf(memory) << " times the size of the result.";
  if (hasWasm) std::cout << " WebAssembly takes " << rangeOf(wasm) << " times as long as one native thread.";
  std::cout << '\n';
}

void printJson(const std::vector<Row>& rows) {
  Json json;
  json.open('{').key("cuts").open('[');
  for (const Row& row : rows) {
    json.open('{').member("mesh", row.job.name).member("n", row.job.n).member("triangles", row.triangles).member("cutCells", row.cutCells);
    json.member("lowerBoundMs", row.lowerBoundMs).member("cutMs", row.cutMs).member("ratio", row.ratio());
    json.member("wallMs", row.wallMs).member("wallMsOnTwoThreads", row.wallMsOnTwo);
    if (row.comparedMs > 0) json.member("comparedMs", row.comparedMs);
    if (row.wasmMs > 0) json.member("wasmMs", row.wasmMs);
    json.member("peakMemoryBytes", row.peakBytes).member("outputBytes", row.outputBytes).key("stages").open('[');
    for (const StageRow& stage : row.stages) {
      json.open('{').member("stage", stage.name).member("ms", stage.ms).member("serialMs", stage.serialMs());
      json.member("pageFaults", stage.pageFaults).close('}');
    }
    json.close(']').close('}');
  }
  json.close(']').key("comparisons").open('[');
  for (const Comparison& c : comparisons(rows)) json.open('{').member("cuts", c.label()).member("ratio", c.ratio()).close('}');
  json.close(']').close('}');
  std::cout << json.text();
}

}  // namespace mandoline::bench

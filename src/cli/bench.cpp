// The benchmark: times cuts on one thread beside a lower bound, a program that only clips every triangle and sorts the pieces by grid cell.
//
// Every time is that of a fresh process, page faults included, in turns with the lower bound's, so that both see the same machine. This
// program therefore runs itself, with kMeasure as its first word, once for each cut.
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <charconv>
#include <cstdio>
#include <ctime>
#include <filesystem>
#include <fstream>
#include <iomanip>
#include <iostream>
#include <optional>
#include <sstream>

#include "cli/json.h"
#include "cli/peak_memory.h"
#include "mandoline/io.h"

namespace mandoline::cli {
namespace {

namespace fs = std::filesystem;

constexpr const char* kMeasure = "--measure";
constexpr const char* kHelp =
    R"(mandoline-bench [MESH N]... [--repetitions R] [--json]

Cuts each MESH with the default grid of N cells along its longest side, on one thread, and prints per mesh and N:
  floor       ms that the lower bound takes (clip the triangles, sort the pieces by grid cell); OBJ files only
  cut         ms that the cut takes without reading the file, all stages
  ratio       cut / floor
  peak        MB that the process needed, the input mesh and reading it included
  peak/out    the same over the size of the cut-mesh's arrays
  stages      ms of each stage
Times are processor time, except those of the stages, which are by the clock. Each is the median of R fresh processes
(default 5), the lower bound and the cut taking turns.
Without MESH: four well-known meshes, if they are there, and a cube of 12 triangles.
)";

struct UsageError : std::runtime_error {
  using std::runtime_error::runtime_error;
};

struct Job {
  std::string name, path;
  int64_t n;
};

/// What is measured for one mesh and N: medians over the repetitions.
struct Row {
  Job job;
  size_t triangles = 0, cutCells = 0;
  std::optional<double> floorMs;
  double cutMs = 0, peakBytes = 0, outputBytes = 0;
  std::vector<std::string> stages;
  std::vector<double> stageMs;

  std::optional<double> ratio() const { return floorMs ? std::optional(cutMs / *floorMs) : std::nullopt; }
};

double processorMs() {
  timespec t{};
  clock_gettime(CLOCK_PROCESS_CPUTIME_ID, &t);
  return double(t.tv_sec) * 1e3 + double(t.tv_nsec) * 1e-6;
}

int64_t parseCount(const std::string& word, const char* what) {
  int64_t n = 0;
  const auto [end, problem] = std::from_chars(word.data(), word.data() + word.size(), n);
  if (problem != std::errc() || end != word.data() + word.size() || n < 1)
    throw UsageError(std::string(what) + " must be a whole number above 0, not " + word);
  return n;
}

// ------------------------------------------------------------------------------------------------------- one cut in this process

template <class Item>
size_t bytesOf(const std::vector<Item>& items) {
  return items.size() * sizeof(Item);
}

size_t bytesOf(const CutMesh& m) {
  return bytesOf(m.positions) + bytesOf(m.vertexCell) + bytesOf(m.vertexMask) + bytesOf(m.vertexTriVertex) + bytesOf(m.vertexParents) +
         bytesOf(m.loopOffsets) + bytesOf(m.loopVertices) + bytesOf(m.faceLoopOffsets) + bytesOf(m.faceTriangle) + bytesOf(m.faceAxis) +
         bytesOf(m.facePlane) + bytesOf(m.cellHalfFaceOffsets) + bytesOf(m.cellHalfFaces) + bytesOf(m.cellGridCell) +
         bytesOf(m.cellRegion) + bytesOf(m.rowRunOffsets) + bytesOf(m.runBegin) + bytesOf(m.runEnd) + bytesOf(m.runRegion) +
         bytesOf(m.regionWinding) + bytesOf(m.droppedTriangles);
}

/// Prints what measureCut() reads.
int printMeasurement(const std::string& path, int64_t n) {
  const Mesh mesh = readMesh(path);
  const Grid grid = Grid::around(mesh, n);
  const double start = processorMs();
  const CutResult result = cut(mesh, grid);
  const double ms = processorMs() - start;
  if (!result) {
    std::cerr << "mandoline-bench: " << path << ": " << result.error.message << "\n";
    return 1;
  }
  std::cout << mesh.triangleCount() << ' ' << result.mesh.cellCount() << ' ' << ms << ' ' << peakMemoryBytes() << ' '
            << bytesOf(result.mesh);
  for (const StageTime& stage : result.stats.stages) std::cout << ' ' << stage.stage << ' ' << stage.ms;
  std::cout << '\n';
  return 0;
}

// --------------------------------------------------------------------------------------------------------- measuring in others

std::string quoted(const std::string& word) {
  std::string text = "'";
  for (const char c : word) {
    if (c == '\'') {
      text += "'\\''";
    } else {
      text += c;
    }
  }
  return text + "'";
}

/// What a program prints. Throws if it fails.
std::string outputOf(const std::string& command) {
  FILE* pipe = popen(command.c_str(), "r");
  if (!pipe) throw std::runtime_error("can't run " + command);
  std::string text;
  char buffer[4096];
  while (const size_t count = fread(buffer, 1, sizeof buffer, pipe)) text.append(buffer, count);
  const int status = pclose(pipe);
  if (!WIFEXITED(status) || WEXITSTATUS(status) != 0) throw std::runtime_error("this failed: " + command);
  return text;
}

std::string commandFor(const std::string& program, const Job& job) {
  return quoted(program) + ' ' + quoted(job.path) + ' ' + std::to_string(job.n);
}

/// Milliseconds of the lower bound's first repetition; nothing if it is not there or can't read such files.
std::optional<double> measureFloor(const Job& job) {
#ifdef MANDOLINE_FLOOR
  const auto endsWith = [&](const std::string& ending) {
    return job.path.size() >= ending.size() && job.path.compare(job.path.size() - ending.size(), ending.size(), ending) == 0;
  };
  if (endsWith(".obj") || endsWith(".obj.gz")) {
    const std::string text = outputOf(commandFor(MANDOLINE_FLOOR, job) + " 1"), key = "\"coldMs\":";
    const size_t at = text.find(key);
    if (at == std::string::npos) throw std::runtime_error("the lower bound printed no time: " + text);
    return std::stod(text.substr(at + key.size()));
  }
#endif
  (void)job;
  return std::nullopt;
}

Row measureCut(const std::string& self, const Job& job) {
  Row row;
  row.job = job;
  std::istringstream in(outputOf(quoted(self) + ' ' + commandFor(kMeasure, job)));
  in >> row.triangles >> row.cutCells >> row.cutMs >> row.peakBytes >> row.outputBytes;
  std::string stage;
  for (double ms; in >> stage >> ms;) {
    row.stages.push_back(stage);
    row.stageMs.push_back(ms);
  }
  return row;
}

double median(std::vector<double> values) {
  std::sort(values.begin(), values.end());
  const size_t half = values.size() / 2;
  return values.size() % 2 ? values[half] : (values[half - 1] + values[half]) / 2;
}

Row measure(const std::string& self, const Job& job, int64_t repetitions) {
  std::vector<Row> rows;
  for (int64_t r = 0; r < repetitions; ++r) {
    const std::optional<double> floorMs = measureFloor(job);
    rows.push_back(measureCut(self, job));
    rows.back().floorMs = floorMs;
  }
  const auto medianOf = [&](const auto& value) {
    std::vector<double> values;
    for (const Row& row : rows) values.push_back(value(row));
    return median(values);
  };
  Row result = rows[0];
  if (result.floorMs) result.floorMs = medianOf([](const Row& row) { return *row.floorMs; });
  result.cutMs = medianOf([](const Row& row) { return row.cutMs; });
  result.peakBytes = medianOf([](const Row& row) { return row.peakBytes; });
  for (size_t s = 0; s < result.stageMs.size(); ++s) result.stageMs[s] = medianOf([s](const Row& row) { return row.stageMs[s]; });
  return result;
}

// --------------------------------------------------------------------------------------------------------------- what to measure

/// The file of a mesh that this program makes, as long as it runs.
class CubeFile {
 public:
  CubeFile() : path_((fs::temp_directory_path() / ("mandoline-bench-" + std::to_string(getpid()) + ".obj")).string()) {
    std::ofstream out(path_);
    for (int corner = 0; corner < 8; ++corner) out << "v " << (corner & 1) << ' ' << (corner >> 1 & 1) << ' ' << (corner >> 2) << '\n';
    out << "f 1 3 4 2\nf 5 6 8 7\nf 1 2 6 5\nf 3 7 8 4\nf 1 5 7 3\nf 2 4 8 6\n";
  }
  ~CubeFile() {
    std::error_code ignored;
    fs::remove(path_, ignored);
  }
  CubeFile(const CubeFile&) = delete;
  CubeFile& operator=(const CubeFile&) = delete;
  const std::string& path() const { return path_; }

 private:
  std::string path_;
};

std::string nameOf(const std::string& path) {
  const std::string file = fs::path(path).filename().string();
  return file.substr(0, file.find('.'));
}

constexpr const char* kCube = "cube";
constexpr const char* kBunny = "common_stanford-bunny";

std::vector<Job> usualJobs(const CubeFile& cube) {
  std::vector<Job> jobs;
  for (const char* mesh : {kBunny, "gcherchi_armadillo", "common_fandisk", "common_spot"}) {
    const fs::path path = fs::path(MANDOLINE_DATA) / (std::string(mesh) + ".obj.gz");
    if (!fs::exists(path)) continue;
    for (const int64_t n : {50, 100}) jobs.push_back({mesh, path.string(), n});
  }
  jobs.push_back({kCube, cube.path(), 50});
  return jobs;
}

// ------------------------------------------------------------------------------------------------------------------- what is told

/// A comparison of two cuts.
struct Comparison {
  std::string text;
  double ratio;
};

std::vector<Comparison> comparisons(const std::vector<Row>& rows) {
  std::vector<Comparison> found;
  for (const Row& a : rows) {
    for (const Row& b : rows) {
      const bool doubled = a.job.path == b.job.path && a.job.n == 2 * b.job.n;
      const bool few = a.job.name == kCube && b.job.name == kBunny && a.job.n == b.job.n;
      if (!doubled && !few) continue;
      const auto label = [](const Row& row) { return row.job.name + "(" + std::to_string(row.job.n) + ")"; };
      found.push_back({label(a) + " / " + label(b), a.cutMs / b.cutMs});
    }
  }
  return found;
}

void printText(const std::vector<Row>& rows) {
  size_t width = 4;
  for (const Row& row : rows) width = std::max(width, row.job.name.size());
  const auto beginLine = [&](const std::string& mesh, const std::string& n) -> std::ostream& {
    return std::cout << std::left << std::setw(int(width)) << mesh << std::right << std::setw(6) << n;
  };
  const auto beginRow = [&](const Row& row) -> std::ostream& { return beginLine(row.job.name, std::to_string(row.job.n)); };
  const auto optional = [](const std::optional<double>& value) {
    if (!value) return std::string("-");
    std::ostringstream text;
    text << std::fixed << std::setprecision(2) << *value;
    return text.str();
  };
  std::cout << std::fixed << std::setprecision(2);
  beginLine("mesh", "N") << std::setw(11) << "triangles" << std::setw(11) << "cut-cells" << std::setw(11) << "floor ms" << std::setw(11)
                         << "cut ms" << std::setw(8) << "ratio" << std::setw(10) << "peak MB" << std::setw(10) << "peak/out"
                         << "\n";
  for (const Row& row : rows) {
    beginRow(row) << std::setw(11) << row.triangles << std::setw(11) << row.cutCells << std::setw(11) << optional(row.floorMs)
                  << std::setw(11) << row.cutMs << std::setw(8) << optional(row.ratio()) << std::setw(10) << row.peakBytes / 1e6
                  << std::setw(10) << row.peakBytes / row.outputBytes << "\n";
  }
  beginLine("\nstages, ms", "");
  for (const std::string& stage : rows[0].stages) std::cout << std::setw(11) << stage;
  std::cout << "\n";
  for (const Row& row : rows) {
    beginRow(row);
    for (const double ms : row.stageMs) std::cout << std::setw(11) << ms;
    std::cout << "\n";
  }
  const std::vector<Comparison> found = comparisons(rows);
  if (!found.empty()) std::cout << "\ncut ms of one over another\n";
  for (const Comparison& c : found)
    std::cout << "  " << std::left << std::setw(int(2 * width) + 16) << c.text << std::right << std::setw(8) << c.ratio << "\n";
}

void printJson(const std::vector<Row>& rows) {
  Json json;
  const auto addOptional = [&](const char* key, const std::optional<double>& value) {
    json.key(key);
    if (value) {
      json.value(*value);
    } else {
      json.null();
    }
  };
  json.open('{').key("cuts").open('[');
  for (const Row& row : rows) {
    json.open('{').member("mesh", row.job.name).member("n", row.job.n).member("triangles", row.triangles).member("cutCells", row.cutCells);
    addOptional("floorMs", row.floorMs);
    json.member("cutMs", row.cutMs);
    addOptional("ratio", row.ratio());
    json.member("peakBytes", row.peakBytes).member("outputBytes", row.outputBytes).key("stagesMs").open('{');
    for (size_t s = 0; s < row.stages.size(); ++s) json.member(row.stages[s], row.stageMs[s]);
    json.close('}').close('}');
  }
  json.close(']').key("comparisons").open('[');
  for (const Comparison& c : comparisons(rows)) json.open('{').member("cuts", c.text).member("ratio", c.ratio).close('}');
  json.close(']').close('}');
  std::cout << json.text();
}

std::string pathOfThisProgram(const char* asCalled) {
  std::error_code problem;
  const fs::path path = fs::read_symlink("/proc/self/exe", problem);
  return problem ? asCalled : path.string();
}

int run(const std::string& self, const std::vector<std::string>& words) {
  if (words.size() == 3 && words[0] == kMeasure) return printMeasurement(words[1], parseCount(words[2], "N"));
  std::vector<Job> jobs;
  int64_t repetitions = 5;
  bool json = false;
  for (size_t i = 0; i < words.size(); ++i) {
    const std::string& word = words[i];
    if (word == "--help") {
      std::cout << kHelp;
      return 0;
    }
    if (word == "--json") {
      json = true;
    } else if (word != "--repetitions" && word.compare(0, 2, "--") == 0) {
      throw UsageError("unknown option " + word);
    } else if (i + 1 == words.size()) {
      throw UsageError("a number is missing after " + word);
    } else if (word == "--repetitions") {
      repetitions = parseCount(words[++i], "R");
    } else {
      jobs.push_back({nameOf(word), word, parseCount(words[++i], "N")});
    }
  }
  const CubeFile cube;
  if (jobs.empty()) jobs = usualJobs(cube);
  std::vector<Row> rows;
  for (const Job& job : jobs) rows.push_back(measure(self, job, repetitions));
  json ? printJson(rows) : printText(rows);
  return 0;
}

}  // namespace
}  // namespace mandoline::cli

int main(int argc, char** argv) {
  try {
    return mandoline::cli::run(mandoline::cli::pathOfThisProgram(argv[0]), {argv + 1, argv + argc});
  } catch (const mandoline::cli::UsageError& error) {
    std::cerr << "mandoline-bench: " << error.what() << "\n" << mandoline::cli::kHelp;
    return 2;
  } catch (const std::exception& error) {
    std::cerr << "mandoline-bench: " << error.what() << "\n";
    return 1;
  }
}

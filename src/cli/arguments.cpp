#include "cli/arguments.h"

#include <charconv>
#include <cmath>

namespace mandoline::cli {

const char* const kHelp =
    R"(mandoline cuts a triangle mesh with a Cartesian grid into polyhedral cut-cells.

  mandoline cut MESH [options]    cut, and print a report
  mandoline info MESH             tell what kind of mesh it is
  mandoline --help, --version

MESH is an OBJ, STL, PLY or OFF file, in text or binary, and may be gzipped.

Options of cut (a value may also be given as in --cells=32)
  --cells N              cubic cells of size 1.1 x longest side of the mesh / N, as many
                         along each axis as cover it with that margin (default: 32);
                         with --box, N cells along each axis
  --cells NX,NY,NZ       as many cells along x, y and z in the box; without --box, in the
                         mesh's bounding box grown by 5 % of its longest side all around
  --box X0,Y0,Z0,X1,Y1,Z1
                         the box that the grid fills exactly
  --snap-tolerance T     move vertices that are within T cells of an axial plane onto it
                         (0 <= T < 0.5; default: 0)
  --threads T            threads to use; 0 for all cores (default: 0). The result is the
                         same for any number
  --validate             check the result: the paper's four checks and all invariants
  -o FILE ...            write the cut-mesh, by extension:
                           .json  everything
                           .vtu   polyhedra for VTK and ParaView
                           .obj   the cut surface, one group per region

Options of cut and info
  --report FILE          write the report as JSON instead of text; - for standard output

Exit codes: 0 fine; 1 the mesh can't be cut, or validation failed; 2 wrong usage, or a
file can't be read or written.
)";

namespace {

/// The whole word as a number; false if it is none.
template <class Number>
bool parseNumber(std::string_view word, Number& number) {
  const auto [end, error] = std::from_chars(word.data(), word.data() + word.size(), number);
  return error == std::errc() && end == word.data() + word.size();
}

/// Numbers with commas between them; empty if any is none.
template <class Number>
std::vector<Number> parseList(std::string_view word) {
  std::vector<Number> numbers;
  for (size_t begin = 0;;) {
    const size_t comma = word.find(',', begin);
    Number number;
    if (!parseNumber(word.substr(begin, comma - begin), number)) return {};
    numbers.push_back(number);
    if (comma == std::string_view::npos) return numbers;
    begin = comma + 1;
  }
}

class Parser {
 public:
  explicit Parser(const std::vector<std::string>& words) : words_(words) {}

  Arguments parse() {
    if (words_.empty()) throw UsageError("a command is missing");
    for (const std::string& word : words_) {
      if (word == "--help" || word == "-h") return arguments_;
    }
    const std::string& command = words_[next_++];
    if (command == "--version") {
      arguments_.command = Command::version;
      return arguments_;
    }
    if (command == "cut") {
      arguments_.command = Command::cut;
    } else if (command == "info") {
      arguments_.command = Command::info;
    } else {
      throw UsageError("unknown command '" + command + "'");
    }
    while (next_ < words_.size()) parseWord(words_[next_++]);
    if (arguments_.mesh.empty()) throw UsageError("the mesh is missing");
    return arguments_;
  }

 private:
  /// An option's value is the next word, or comes after a '=' as in --cells=32.
  void parseWord(const std::string& whole) {
    const size_t equals = whole.starts_with("--") ? whole.find('=') : std::string::npos;
    const std::string word = whole.substr(0, equals);
    if (equals != std::string::npos) attached_ = whole.substr(equals + 1);
    const bool cuts = arguments_.command == Command::cut;
    if (word == "--report") {
      arguments_.report = value(word);
    } else if (cuts && word == "--cells") {
      parseCells(value(word));
    } else if (cuts && word == "--box") {
      parseBox(value(word));
    } else if (cuts && word == "--snap-tolerance") {
      parseSnapTolerance(value(word));
    } else if (cuts && word == "--threads") {
      parseThreads(value(word));
    } else if (cuts && word == "--validate") {
      arguments_.validate = true;
    } else if (cuts && word == "-o") {
      arguments_.outputs.push_back(value(word));
      while (next_ < words_.size() && words_[next_][0] != '-') arguments_.outputs.push_back(words_[next_++]);
    } else if (word.empty() || word[0] == '-') {
      throw UsageError("unknown option '" + word + "'");
    } else if (!arguments_.mesh.empty()) {
      throw UsageError("one mesh at a time: '" + arguments_.mesh + "' or '" + word + "'?");
    } else {
      arguments_.mesh = word;
    }
    if (attached_) throw UsageError(word + " takes no value");
  }

  std::string value(const std::string& option) {
    std::string value;
    if (attached_) {
      value.swap(*attached_);
      attached_.reset();
    } else if (next_ < words_.size()) {
      value = words_[next_++];
    }
    if (value.empty()) throw UsageError(option + " needs a value");
    return value;
  }

  void parseCells(const std::string& word) {
    const std::vector<int64_t> cells = parseList<int64_t>(word);
    if (cells.size() != 1 && cells.size() != 3) throw UsageError("--cells needs N or NX,NY,NZ, not '" + word + "'");
    for (size_t d = 0; d < 3; ++d) {
      arguments_.cells[d] = cells[cells.size() == 3 ? d : 0];
      if (arguments_.cells[d] < 1) throw UsageError("--cells needs numbers of at least 1, not '" + word + "'");
    }
    arguments_.cellsPerAxis = cells.size() == 3;
  }

  void parseBox(const std::string& word) {
    const std::vector<double> box = parseList<double>(word);
    if (box.size() != 6) throw UsageError("--box needs X0,Y0,Z0,X1,Y1,Z1, not '" + word + "'");
    arguments_.box.emplace();
    for (size_t d = 0; d < 3; ++d) {
      arguments_.box->low[d] = box[d];
      arguments_.box->high[d] = box[d + 3];
      if (!(box[d] < box[d + 3]) || !std::isfinite(box[d + 3] - box[d]))
        throw UsageError("--box needs a box that is not empty, not '" + word + "'");
    }
  }

  void parseSnapTolerance(const std::string& word) {
    double& tolerance = arguments_.snapTolerance;
    if (!parseNumber(word, tolerance) || !(tolerance >= 0 && tolerance < 0.5)) {
      throw UsageError("--snap-tolerance needs a number from 0 to below 0.5, not '" + word + "'");
    }
  }

  void parseThreads(const std::string& word) {
    if (!parseNumber(word, arguments_.threads)) throw UsageError("--threads needs a number of threads, not '" + word + "'");
  }

  const std::vector<std::string>& words_;
  size_t next_ = 0;
  std::optional<std::string> attached_;  ///< value of the option being parsed
  Arguments arguments_;
};

}  // namespace

Arguments parseArguments(const std::vector<std::string>& words) { return Parser(words).parse(); }

}  // namespace mandoline::cli

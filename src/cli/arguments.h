// What the user asks for on the command line.
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <stdexcept>
#include <string>
#include <vector>

namespace mandoline::cli {

struct UsageError : std::runtime_error {
  using std::runtime_error::runtime_error;
};

enum class Command { help, version, cut, info };

struct Box {
  std::array<double, 3> low, high;
};

struct Arguments {
  Command command = Command::help;
  std::string mesh;
  std::array<int64_t, 3> cells{32, 32, 32};
  bool cellsPerAxis = false;  ///< --cells NX,NY,NZ rather than --cells N
  std::optional<Box> box;
  double snapTolerance = 0;
  unsigned threads = 0;
  bool validate = false;
  std::string report;  ///< path of the JSON report, "-" for standard output; empty for text there
  std::vector<std::string> outputs;
};

/// The words after the program's name. Throws UsageError.
Arguments parseArguments(const std::vector<std::string>& words);

extern const char* const kHelp;

}  // namespace mandoline::cli

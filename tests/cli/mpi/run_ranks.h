// Runs mandoline-mpi, and reads what it leaves.
#pragma once

#include <cstdlib>

#include "command_line.h"
#include "mandoline/io.h"

namespace fs = std::filesystem;

using Names = std::vector<std::string>;

/// What MPI is to take of a test. What takes two minutes hangs.
inline Names wordsFor(int processes, const Names& words) {
  for (const auto& [name, value] : {std::pair("OMPI_ALLOW_RUN_AS_ROOT", "1"),
                                    {"OMPI_ALLOW_RUN_AS_ROOT_CONFIRM", "1"},
                                    {"OMPI_MCA_rmaps_base_oversubscribe", "1"},
                                    {"OMPI_MCA_hwloc_base_binding_policy", "none"}}) {
    setenv(name, value, 1);
  }
  Names all = {"timeout", "--foreground", "--kill-after=9", "120", MANDOLINE_MPIEXEC, "-n", std::to_string(processes), MANDOLINE_MPI};
  all.insert(all.end(), words.begin(), words.end());
  return all;
}

inline Outcome runRanks(const TemporaryFolder& folder, int processes, const Names& words, const Signal& signal = {}) {
  return runProgram(folder, wordsFor(processes, words), "", signal);
}

inline constexpr int kHangs = 124;  // timeout's exit code

inline std::string meshFile(const TemporaryFolder& folder, const mandoline::Mesh& mesh) {
  mandoline::writeMesh(folder.path("mesh.ply"), mesh);
  return folder.path("mesh.ply");
}

inline size_t countOf(const std::string& text, const std::string& part) {
  size_t count = 0;
  for (size_t at = text.find(part); at != std::string::npos; at = text.find(part, at + 1)) ++count;
  return count;
}

/// The files of the folder other than those of the streams.
inline Names names(const TemporaryFolder& folder) {
  Names names;
  for (const fs::directory_entry& file : fs::directory_iterator(folder.path(""))) {
    const std::string name = file.path().filename().string();
    if (!name.starts_with("std")) names.push_back(name);
  }
  std::sort(names.begin(), names.end());
  return names;
}

/// The numbers that a report has under a name.
inline std::vector<double> numbersOf(const std::string& report, const std::string& name) {
  std::vector<double> numbers;
  const std::string key = "\"" + name + "\": ";
  for (size_t at = report.find(key); at != std::string::npos; at = report.find(key, at + 1))
    numbers.push_back(std::strtod(report.c_str() + at + key.size(), nullptr));
  return numbers;
}

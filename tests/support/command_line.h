// The command line, run as a child process.
#pragma once

#include <fcntl.h>
#include <sys/wait.h>
#include <unistd.h>

#include <csignal>
#include <functional>
#include <string>
#include <vector>

#include "catch.h"
#include "temporary_folder.h"

struct Outcome {
  int exitCode = -1;
  std::string out, err;
};

/// A child process with its standard streams in files of the folder. Gets the signal once `ready` holds.
struct Signal {
  int number;
  std::function<bool()> ready;
};
/// `words`: the program, and its arguments.
inline Outcome runProgram(const TemporaryFolder& folder, std::vector<std::string> words, const std::string& input = "",
                          const Signal& signal = {}) {
  std::vector<char*> arguments;
  for (std::string& word : words) arguments.push_back(word.data());
  arguments.push_back(nullptr);
  const std::string in = folder.write("stdin", input), out = folder.path("stdout"), err = folder.path("stderr");
  const pid_t child = fork();
  if (child == 0) {
    dup2(open(in.c_str(), O_RDONLY), STDIN_FILENO);
    dup2(open(out.c_str(), O_WRONLY | O_CREAT | O_TRUNC, 0600), STDOUT_FILENO);
    dup2(open(err.c_str(), O_WRONLY | O_CREAT | O_TRUNC, 0600), STDERR_FILENO);
    if (signal.number) std::signal(signal.number, SIG_DFL);
    execvp(arguments[0], arguments.data());
    _exit(127);
  }
  REQUIRE(child > 0);
  int status = 0;
  if (signal.number) {
    while (!signal.ready() && waitpid(child, &status, WNOHANG) == 0) usleep(1000);
    kill(child, signal.number);
  }
  waitpid(child, &status, 0);
  return {WIFEXITED(status) ? WEXITSTATUS(status) : -WTERMSIG(status), folder.read("stdout"), folder.read("stderr")};
}

inline Outcome run(const TemporaryFolder& folder, const std::vector<std::string>& words, const std::string& input = "",
                   const Signal& signal = {}) {
  std::vector<std::string> all = {MANDOLINE_CLI};
  all.insert(all.end(), words.begin(), words.end());
  return runProgram(folder, std::move(all), input, signal);
}

inline bool contains(const std::string& text, const std::string& part) {
  CAPTURE(text, part);
  return text.find(part) != std::string::npos;
}

/// A report without its line breaks and their indentation, with a space after each comma.
inline std::string inOneLine(const std::string& json) {
  std::string line;
  for (size_t i = 0; i < json.size(); ++i) {
    if (json[i] != '\n') {
      line += json[i];
      continue;
    }
    if (line.ends_with(',')) line += ' ';
    i = std::min(json.find_first_not_of(' ', i + 1), json.size()) - 1;
  }
  return line;
}

// The command line: reads, cuts, reports, writes. arguments.cpp parses the options.
#include <exception>
#include <iostream>
#include <new>

#include "cli/commands.h"
#include "cli/files.h"
#include "cli/interrupt.h"
#include "cli/limit_memory.h"

namespace mandoline::cli {
namespace {

void print(std::string_view text) {
  writeOutput("-", [&](const Sink& sink) { sink(text); });
}

int run(const std::vector<std::string>& words) {
  const Arguments arguments = parseArguments(words);
  switch (arguments.command) {
    case Command::help:
      print(kHelp);
      return kFine;
    case Command::version:
      print("mandoline " MANDOLINE_VERSION "\n");
      return kFine;
    case Command::cut:
      return arguments.stream ? runStream(arguments) : runCut(arguments);
    case Command::slice:
      return runSlice(arguments);
    case Command::boundary:
      return runBoundary(arguments);
    case Command::flow:
      return runFlow(arguments);
    case Command::info:
      return runInfo(arguments);
    case Command::make:
      return runMake(arguments);
    case Command::resolve:
      return runResolve(arguments);
  }
  return kBadUsageOrFile;
}

}  // namespace

void complain(const std::string& message) { std::cerr << "mandoline: " << message << "\n"; }

}  // namespace mandoline::cli

int main(int argc, char** argv) {
  using namespace mandoline::cli;
  limitMemory();
  handleInterrupts();
  try {
    return run(std::vector<std::string>(argv + 1, argv + argc));
  } catch (const UsageError& error) {
    complain(error.what());
    std::cerr << "Try 'mandoline --help'.\n";
    return kBadUsageOrFile;
  } catch (const mandoline::FileError& error) {
    complain(error.what());
    return kBadUsageOrFile;
  } catch (const Interrupted& interrupted) {
    complain("interrupted");
    return 128 + interrupted.signal;
  } catch (const std::bad_alloc&) {
    complain("there is not enough memory");
    return kNotCut;
  } catch (const std::exception& error) {
    complain(error.what());
    return kNotCut;
  }
}

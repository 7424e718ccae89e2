#include "cli/mpi/ranks.h"

#include <climits>
#include <iostream>
#include <new>

#include "cli/commands.h"
#include "cli/interrupt.h"
#include "mandoline/io.h"

namespace mandoline::cli {

Ranks::Ranks() : comm_(MPI_COMM_WORLD, throwIfInterrupted) {}

int Ranks::onThisMachine() const {
  MPI_Comm machine;
  MPI_Comm_split_type(MPI_COMM_WORLD, MPI_COMM_TYPE_SHARED, 0, MPI_INFO_NULL, &machine);
  int count = 1;
  MPI_Comm_size(machine, &count);
  MPI_Comm_free(&machine);
  return count;
}

void Ranks::together(detail::FunctionRef<void()> work) {
  std::exception_ptr failure;
  try {
    work();
  } catch (...) {
    throwIfInterrupted();  // which also cancels calls
    failure = std::current_exception();
  }
  const int failed = comm_.reduce(failure ? rank() : INT_MAX, MPI_MIN);
  if (failed == INT_MAX) return;
  int exitCode = kFine;
  try {
    if (failure && rank() == failed) std::rethrow_exception(failure);
  } catch (...) {
    exitCode = complainOfException(rank());
  }
  throw Stopped{comm_.reduce(exitCode, MPI_MAX)};
}

void Ranks::inFirst(detail::FunctionRef<void()> work) {
  together([&] {
    if (isFirst()) work();
  });
}

int complainOfException(int rank) {
  const std::string who = "rank " + std::to_string(rank) + ": ";
  try {
    throw;
  } catch (const Interrupted&) {
    throw;
  } catch (const Stopped&) {
    throw;
  } catch (const UsageError& error) {
    complain(error.what());
    std::cerr << "Try 'mandoline-mpi --help'.\n";
    return kBadUsageOrFile;
  } catch (const FileError& error) {
    complain(who + error.what());
    return kBadUsageOrFile;
  } catch (const std::bad_alloc&) {
    complain(who + "there is not enough memory");
  } catch (const std::exception& error) {
    complain(who + error.what());
  }
  return kNotCut;
}

}  // namespace mandoline::cli

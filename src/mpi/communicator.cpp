#include "mpi/communicator.h"

#include <algorithm>
#include <chrono>
#include <climits>
#include <new>
#include <string_view>
#include <thread>

#include "mandoline/distributed.h"
#include "mandoline/mesh_files.h"
#include "mesh/run_call.h"

namespace mandoline::detail {
namespace {

constexpr int kTag = 1;
/// As a message, for which there has to be memory at all times: what is longer is cut off.
struct PlainError {
  Status status = Status::ok;
  int64_t element = -1, element2 = -1;
  uint64_t length = 0;
  char message[4096] = {};

  explicit PlainError(const Error& error) : status(error.status), element(error.element), element2(error.element2) { say(error.message); }
  void say(std::string_view text) {
    length = std::min(text.size(), sizeof message);
    std::copy_n(text.data(), length, message);
  }
  Error get() const { return {status, element, element2, std::string(message, length)}; }
};

}  // namespace

Communicator::Communicator(MPI_Comm comm, std::function<void()> onWait) : onWait_(std::move(onWait)) {
  MPI_Comm_dup(comm, &comm_);
  MPI_Comm_rank(comm_, &rank_);
  MPI_Comm_size(comm_, &size_);
}

Communicator::Communicator(MPI_Comm comm, const char* noun, const RunOptions& options) : Communicator(comm, nullptr) {
  together(noun, [&] {
    if (!options.progress) return;
    onWait_ = [noun, progress = options.progress] {
      if (!progress({"waiting", 0, 1, 0, 1})) throw CallError({Status::cancelled, -1, -1, std::string("The ") + noun + " was cancelled."});
    };
  });
}

Communicator::~Communicator() {
  int isOver = 0;
  MPI_Finalized(&isOver);
  if (comm_ != MPI_COMM_NULL && !isBroken_ && !isOver) MPI_Comm_free(&comm_);
}

Communicator& Communicator::operator=(Communicator&& other) noexcept {
  std::swap(comm_, other.comm_);
  std::swap(onWait_, other.onWait_);
  std::swap(rank_, other.rank_);
  std::swap(size_, other.size_);
  std::swap(bytesSent_, other.bytesSent_);
  std::swap(isBroken_, other.isBroken_);
  return *this;
}

/// MPI's own waiting keeps a core busy, which a process on the same machine may need, and answers no signals.
void Communicator::wait(MPI_Request* requests, int count) {
  constexpr int kQuickTests = 200;
  constexpr auto kShort = std::chrono::microseconds(20), kLong = std::chrono::microseconds(1000);
  auto pause = kShort;
  for (int tests = 0;; ++tests) {
    int isDone = 0;
    MPI_Testall(count, requests, &isDone, MPI_STATUSES_IGNORE);
    if (isDone) return;
    if (tests < kQuickTests) {
      std::this_thread::yield();
      continue;
    }
    std::this_thread::sleep_for(pause);
    pause = std::min(2 * pause, kLong);
    try {
      if (onWait_) onWait_();
    } catch (...) {
      isBroken_ = true;
      throw;
    }
  }
}

void Communicator::uniteFlags(std::vector<uint8_t>& flags) {
  std::vector<uint8_t> bits;
  together(kExchange, [&] { bits.assign((flags.size() + 7) / 8, 0); });
  for (size_t i = 0; i < flags.size(); ++i) bits[i / 8] |= uint8_t(flags[i] << i % 8);
  reduce(bits, MPI_BOR);
  for (size_t i = 0; i < flags.size(); ++i) flags[i] = bits[i / 8] >> i % 8 & 1;
}

std::vector<uint64_t> Communicator::gatherAll(uint64_t number) {
  std::vector<uint64_t> numbers;
  together(kExchange, [&] { numbers.assign(size_t(size_), 0); });
  numbers[size_t(rank_)] = number;
  reduce(numbers, MPI_SUM);
  return numbers;
}

std::vector<std::vector<uint32_t>> Communicator::gatherAll(const std::vector<uint32_t>& numbers) {
  const std::vector<uint64_t> counts = gatherAll(uint64_t(numbers.size()));
  std::vector<std::vector<uint32_t>> all;
  together(kExchange, [&] {
    all.resize(counts.size());
    for (size_t from = 0; from < all.size(); ++from) all[from].resize(counts[from]);
    all[size_t(rank_)] = numbers;
  });
  for (int from = 0; from < size_; ++from) broadcastBytes(all[size_t(from)].data(), all[size_t(from)].size() * sizeof numbers[0], from);
  return all;
}

uint64_t Communicator::broadcastCount(uint64_t count, int from) {
  broadcastBytes(&count, sizeof count, from);
  return count;
}

void Communicator::broadcastBytes(void* bytes, size_t count, int from) {
  if (size_ == 1) return;
  for (size_t at = 0; at < count; at += kMostBytes) {
    MPI_Request request;
    MPI_Ibcast(static_cast<std::byte*>(bytes) + at, int(std::min(kMostBytes, count - at)), MPI_BYTE, from, comm_, &request);
    wait(request);
  }
  if (rank_ == from) bytesSent_ += count * uint64_t(size_ - 1);
}

void Communicator::startParts(void* bytes, size_t count, int peer, bool isSent, std::vector<MPI_Request>& requests) {
  for (size_t at = 0; at < count; at += kMostBytes) {
    std::byte* const from = static_cast<std::byte*>(bytes) + at;
    const int some = int(std::min(kMostBytes, count - at));
    MPI_Request& request = requests.emplace_back();
    if (isSent)
      MPI_Isend(from, some, MPI_BYTE, peer, kTag, comm_, &request);
    else
      MPI_Irecv(from, some, MPI_BYTE, peer, kTag, comm_, &request);
  }
}

void Communicator::exchangeCounts(std::vector<uint64_t>& counts) {
  std::vector<uint64_t> received;
  together(kExchange, [&] { received.resize(counts.size()); });
  MPI_Request request;
  MPI_Ialltoall(counts.data(), 1, MPI_UINT64_T, received.data(), 1, MPI_UINT64_T, comm_, &request);
  wait(request);
  counts = std::move(received);
}

Communicator::Bytes Communicator::exchange(const Bytes& bytes, int to, int from) {
  const uint64_t sentCount = bytes.size();
  uint64_t count = 0;
  exchange(std::as_bytes(std::span(&sentCount, 1)), to, std::as_writable_bytes(std::span(&count, 1)), from);
  Bytes received;
  together(kExchange, [&] { received.resize(count); });
  exchange(std::span(bytes), to, std::span(received), from);
  return received;
}

void Communicator::exchange(std::span<const std::byte> sent, int to, std::span<std::byte> received, int from) {
  if (to < 0) sent = {};
  if (from < 0) received = {};
  for (size_t at = 0; at < std::max(sent.size(), received.size()); at += kMostBytes) {
    const auto some = [&](size_t bytes) { return int(std::min(kMostBytes, bytes - at)); };
    MPI_Request requests[2];
    int count = 0;
    if (at < sent.size()) MPI_Isend(sent.data() + at, some(sent.size()), MPI_BYTE, to, kTag, comm_, &requests[count++]);
    if (at < received.size()) MPI_Irecv(received.data() + at, some(received.size()), MPI_BYTE, from, kTag, comm_, &requests[count++]);
    wait(requests, count);
  }
  bytesSent_ += sent.size();
}

void Communicator::requireSame(uint64_t number, const char* what) {
  const std::vector<uint64_t> all = gatherAll(number);
  for (size_t rank = 0; rank < all.size(); ++rank) {
    if (all[rank] == all[0]) continue;
    const std::string message = "Process " + std::to_string(rank) + " has another " + what + " than process 0.";
    throw RankError({Status::badArgument, int64_t(rank), -1, message}, int(rank));
  }
}

void Communicator::agree(const Error& error) {
  const int failed = reduce(error.status == Status::ok ? INT_MAX : rank_, MPI_MIN);
  if (failed == INT_MAX) return;
  PlainError agreed(error);  // without a message, there was no memory for one
  if (agreed.length == 0) agreed.say("There is not enough memory.");
  broadcastBytes(&agreed, sizeof agreed, failed);
  throw RankError(agreed.get(), failed);
}

/// Gives what is to be thrown on in this process.
std::exception_ptr Communicator::catchAll(Error& error, const char* noun, FunctionRef<void()> body) {
  std::exception_ptr own;
  try {
    try {
      catchErrors(error, noun, body);
    } catch (const FileError& failure) {  // of a mesh that is read in pieces
      error = {Status::badArgument, -1, -1, failure.what()};
    } catch (const std::bad_alloc&) {
      throw;
    } catch (...) {
      own = std::current_exception();
      error = {Status::cancelled, -1, -1, std::string("The ") + noun + " was cancelled."};
    }
  } catch (...) {
    error.status = Status::outOfMemory;
  }
  return own;
}

void Communicator::together(const char* noun, FunctionRef<void()> body) {
  Error error;
  const std::exception_ptr own = catchAll(error, noun, body);
  try {
    agree(error);
  } catch (const RankError&) {
    if (own) std::rethrow_exception(own);
    throw;
  }
}

}  // namespace mandoline::detail

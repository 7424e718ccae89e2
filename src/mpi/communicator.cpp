#include "mpi/communicator.h"

#include <algorithm>
#include <chrono>
#include <climits>
#include <thread>

#include "mandoline/distributed.h"
#include "mesh/run_call.h"
#include "mpi/pack.h"

namespace mandoline::detail {
namespace {

constexpr int kTag = 1;
constexpr size_t kMostBytes = size_t(1) << 30;  // of one message

struct PackedError {
  uint8_t status = 0;
  int64_t element = -1, element2 = -1;
  std::string message;

  static void fields(auto& self, const auto& f) {
    f("status", self.status);
    f("element", self.element);
    f("element2", self.element2);
    f("message", self.message);
  }
};

}  // namespace

Communicator::Communicator(MPI_Comm comm, std::function<void()> onWait) : onWait_(std::move(onWait)) {
  MPI_Comm_dup(comm, &comm_);
  MPI_Comm_rank(comm_, &rank_);
  MPI_Comm_size(comm_, &size_);
}

Communicator::~Communicator() {
  int isOver = 0;
  MPI_Finalized(&isOver);
  if (!isBroken_ && !isOver) MPI_Comm_free(&comm_);
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
  together("exchange", [&] { bits.assign((flags.size() + 7) / 8, 0); });
  for (size_t i = 0; i < flags.size(); ++i) bits[i / 8] |= uint8_t(flags[i] << i % 8);
  reduce(bits, MPI_BOR);
  for (size_t i = 0; i < flags.size(); ++i) flags[i] = bits[i / 8] >> i % 8 & 1;
}

std::vector<uint64_t> Communicator::gatherAll(uint64_t number) {
  std::vector<uint64_t> numbers(size_t(size_), 0);
  numbers[size_t(rank_)] = number;
  reduce(numbers, MPI_SUM);
  return numbers;
}

std::vector<std::vector<uint32_t>> Communicator::gatherAll(const std::vector<uint32_t>& numbers) {
  const std::vector<uint64_t> counts = gatherAll(uint64_t(numbers.size()));
  std::vector<std::vector<uint32_t>> all(counts.size());
  together("exchange", [&] {
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

std::vector<uint64_t> Communicator::exchangeCounts(const std::vector<uint64_t>& sent) {
  std::vector<uint64_t> received(sent.size());
  MPI_Request request;
  MPI_Ialltoall(sent.data(), 1, MPI_UINT64_T, received.data(), 1, MPI_UINT64_T, comm_, &request);
  wait(request);
  return received;
}

Communicator::Bytes Communicator::exchange(const Bytes& bytes, int to, int from) {
  uint64_t sentCount = bytes.size(), count = 0;
  std::vector<MPI_Request> requests;
  if (to >= 0) MPI_Isend(&sentCount, 1, MPI_UINT64_T, to, kTag, comm_, &requests.emplace_back());
  if (from >= 0) MPI_Irecv(&count, 1, MPI_UINT64_T, from, kTag, comm_, &requests.emplace_back());
  wait(requests.data(), int(requests.size()));
  requests.clear();
  Bytes received(count);
  if (to >= 0) startParts(const_cast<std::byte*>(bytes.data()), bytes.size(), to, true, requests);
  if (from >= 0) startParts(received.data(), received.size(), from, false, requests);
  wait(requests.data(), int(requests.size()));
  if (to >= 0) bytesSent_ += sentCount;
  return received;
}

void Communicator::send(const Bytes& bytes, int to) { exchange(bytes, to, -1); }
Communicator::Bytes Communicator::receive(int from) { return exchange({}, -1, from); }

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
  Bytes bytes;
  if (failed == rank_) bytes = packed(PackedError{uint8_t(error.status), error.element, error.element2, error.message});
  broadcast(bytes, failed);
  PackedError agreed = unpacked<PackedError>(bytes);
  throw RankError({Status(agreed.status), agreed.element, agreed.element2, std::move(agreed.message)}, failed);
}

void Communicator::together(const char* noun, const std::function<void()>& body) {
  Error error;
  catchErrors(error, noun, body);
  agree(error);
}

std::function<void()> waiterFor(const char* noun, const RunOptions& options) {
  if (!options.progress) return nullptr;
  return [noun, progress = options.progress] {
    if (!progress({"waiting", 0, 1, 0, 1})) throw CallError({Status::cancelled, -1, -1, std::string("The ") + noun + " was cancelled."});
  };
}

}  // namespace mandoline::detail

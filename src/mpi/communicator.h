// MPI as this library uses it: whole arrays between processes, waiting that leaves the processor to others and can be given up, and
// failures that all processes learn of.
#pragma once

#include <mpi.h>

#include <algorithm>
#include <cstddef>
#include <functional>
#include <numeric>
#include <span>
#include <string>
#include <vector>

#include "base/function_ref.h"
#include "base/shared.h"
#include "mandoline/status.h"

namespace mandoline::detail {

template <class Number>
MPI_Datatype typeOf() {
  if constexpr (std::is_same_v<Number, uint8_t>) return MPI_UINT8_T;
  if constexpr (std::is_same_v<Number, int>) return MPI_INT;
  if constexpr (std::is_same_v<Number, int64_t>) return MPI_INT64_T;
  if constexpr (std::is_same_v<Number, uint64_t>) return MPI_UINT64_T;
  if constexpr (std::is_same_v<Number, double>) return MPI_DOUBLE;
}

/// A communicator of this library's own, with the processes of another. All calls are collective. What they need memory for all agree on:
/// where one process has not enough, all throw RankError. Callers likewise do between calls what may fail in together().
class MANDOLINE_SHARED Communicator {
 public:
  using Bytes = std::vector<std::byte>;

  Communicator() = default;
  /// `onWait` is called while a call waits; if it throws, what this process had begun with others can't be finished: then it has to end.
  Communicator(MPI_Comm comm, std::function<void()> onWait);
  /// Waiting shows no progress, but can be cancelled. `noun` as for runCall().
  Communicator(MPI_Comm comm, const char* noun, const RunOptions& options);
  ~Communicator();
  Communicator(const Communicator&) = delete;
  Communicator& operator=(Communicator&& other) noexcept;

  MPI_Comm handle() const { return comm_; }
  int rank() const { return rank_; }
  int size() const { return size_; }
  /// What this process has sent to others, each of them counted.
  uint64_t bytesSent() const { return bytesSent_; }

  /// The numbers of all, entry by entry as one.
  template <class Number>
  void reduce(std::span<Number> numbers, MPI_Op op) {
    for (size_t at = 0; at < numbers.size(); at += kMost) {
      const int count = int(std::min(kMost, numbers.size() - at));
      MPI_Request request;
      MPI_Iallreduce(MPI_IN_PLACE, numbers.data() + at, count, typeOf<Number>(), op, comm_, &request);
      wait(request);
      if (size_ > 1) bytesSent_ += size_t(count) * sizeof(Number);
    }
  }
  template <class Number>
  void reduce(std::vector<Number>& numbers, MPI_Op op) {
    reduce(std::span<Number>(numbers), op);
  }
  template <class Number>
  Number reduce(Number number, MPI_Op op) {
    reduce(std::span<Number>(&number, 1), op);
    return number;
  }
  /// Sets flags, which are 0 or 1, that any process has set.
  void uniteFlags(std::vector<uint8_t>& flags);
  /// One number of each process, by rank.
  std::vector<uint64_t> gatherAll(uint64_t number);
  /// One array of each process, by rank.
  std::vector<std::vector<uint32_t>> gatherAll(const std::vector<uint32_t>& numbers);
  /// Those of process `from` to all.
  template <class Item>
  void broadcast(std::vector<Item>& items, int from) {
    const uint64_t count = broadcastCount(items.size(), from);
    together(kExchange, [&] { items.resize(count); });
    broadcastBytes(items.data(), items.size() * sizeof(Item), from);
  }
  /// Those of each process one after the other, in all processes or in the first alone, straight to where they stay.
  template <class Item>
  std::vector<Item> gather(const std::vector<Item>& items, bool inAll) {
    const std::vector<uint64_t> counts = gatherAll(uint64_t(items.size()));
    std::vector<Item> whole;
    together(kExchange, [&] {
      if (inAll || rank_ == 0) whole.resize(size_t(std::accumulate(counts.begin(), counts.end(), uint64_t(0))));
    });
    std::span<Item> left(whole);
    for (int from = 0; from < size_; ++from) {
      const std::span<Item> part = left.empty() ? left : left.first(counts[size_t(from)]);
      left = left.subspan(part.size());
      if (from == rank_) std::copy(items.begin(), items.begin() + ptrdiff_t(part.size()), part.begin());
      if (inAll)
        broadcastBytes(part.data(), part.size_bytes(), from);
      else if (from > 0)
        exchange(std::as_bytes(std::span(items)), rank_ == from ? 0 : -1, std::as_writable_bytes(part), rank_ == 0 ? from : -1);
    }
    return whole;
  }
  /// Sends and receives at once; -1: nothing to or from there.
  Bytes exchange(const Bytes& bytes, int to, int from);
  /// The same where both know how much it is, which takes no memory.
  void exchange(std::span<const std::byte> sent, int to, std::span<std::byte> received, int from);
  /// Each process adds to what those before it have come to, by add(), which changes the items. All get the last one's. `noun` as for
  /// runCall().
  template <class Item>
  void addInOrder(const char* noun, std::span<Item> items, FunctionRef<void()> add) {
    const std::span<std::byte> bytes = std::as_writable_bytes(items);
    if (rank_ > 0) exchange({}, -1, bytes, rank_ - 1);
    Error error;
    catchAll(error, noun, add);
    if (rank_ + 1 < size_) exchange(bytes, rank_ + 1, {}, -1);
    agree(error);
    broadcastBytes(bytes.data(), bytes.size(), size_ - 1);
  }

  /// An array for each process, by rank; gives those of each for this one. What a process has for itself it gets.
  template <class Item>
  std::vector<std::vector<Item>> exchangeAll(const std::vector<std::vector<Item>>& sent) {
    std::vector<std::vector<Item>> received;
    std::vector<uint64_t> counts;
    together(kExchange, [&] {
      received.resize(sent.size());
      for (const std::vector<Item>& items : sent) counts.push_back(items.size());
    });
    exchangeCounts(counts);
    std::vector<MPI_Request> requests;
    together(kExchange, [&] {
      size_t parts = 0;
      for (size_t peer = 0; peer < received.size(); ++peer) {
        received[peer].resize(counts[peer]);
        parts += partsOf(sent[peer].size() * sizeof(Item)) + partsOf(counts[peer] * sizeof(Item));
      }
      requests.reserve(parts);
    });
    for (int peer = 0; peer < size_; ++peer) {
      std::vector<Item>& from = received[size_t(peer)];
      const std::vector<Item>& to = sent[size_t(peer)];
      if (peer == rank_) {
        std::copy(to.begin(), to.end(), from.begin());
        continue;
      }
      startParts(const_cast<Item*>(to.data()), to.size() * sizeof(Item), peer, true, requests);
      startParts(from.data(), from.size() * sizeof(Item), peer, false, requests);
      bytesSent_ += to.size() * sizeof(Item);
    }
    wait(requests.data(), int(requests.size()));
    return received;
  }

  /// Throws RankError (badArgument) where a process has another number than the first, alike in all: `what` it stands for.
  void requireSame(uint64_t number, const char* what);
  /// Waits for all, and throws RankError if one of them has an error: the same in each, that of the lowest rank.
  void agree(const Error& error);
  /// Runs body() in each process, then agrees on whether it failed. `noun` as for runCall(). What options.progress throws is thrown on in
  /// this process, and the others have the call cancelled.
  void together(const char* noun, FunctionRef<void()> body);

 private:
  static constexpr const char* kExchange = "exchange";
  static constexpr size_t kMost = size_t(1) << 26;       // items of one message
  static constexpr size_t kMostBytes = size_t(1) << 30;  // likewise

  static size_t partsOf(size_t bytes) { return (bytes + kMostBytes - 1) / kMostBytes; }
  static std::exception_ptr catchAll(Error& error, const char* noun, FunctionRef<void()> body);

  void wait(MPI_Request& request) { wait(&request, 1); }
  void wait(MPI_Request* requests, int count);
  uint64_t broadcastCount(uint64_t count, int from);
  void broadcastBytes(void* bytes, size_t count, int from);
  void startParts(void* bytes, size_t count, int peer, bool isSent, std::vector<MPI_Request>& requests);
  /// What the others have for this one, in the place of what this one has for them.
  void exchangeCounts(std::vector<uint64_t>& counts);

  MPI_Comm comm_ = MPI_COMM_NULL;
  std::function<void()> onWait_;
  int rank_ = 0, size_ = 1;
  uint64_t bytesSent_ = 0;
  bool isBroken_ = false;
};

}  // namespace mandoline::detail

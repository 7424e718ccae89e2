#include "cli/mpi/count_keys.h"

#include <algorithm>
#include <numeric>

#include "base/sort.h"

namespace mandoline::cli {
namespace {

constexpr const char* kCounting = "writing";

/// Keys that follow each other, of so many things each.
struct KeyRun {
  uint64_t key, length, count;
};

/// Where one comes from.
struct SentRun {
  size_t to, place;      ///< the process that counts it, and which of what that gets
  size_t first, length;  ///< of the keys here
};

/// Each process counts as many possible keys as any other.
class KeyCounter {
 public:
  KeyCounter(detail::Communicator& comm, const std::vector<KeyCount>& keys) : comm_(comm), keys_(keys) {}

  KeysBefore run() {
    uint64_t most = 0;
    for (const KeyCount& key : keys_) most = std::max(most, key.key + 1);
    block_ = comm_.reduce(most, MPI_MAX) / uint64_t(comm_.size()) + 1;
    std::vector<std::vector<KeyRun>> runs;
    comm_.together(kCounting, [&] { runs = findRuns(); });
    runs = comm_.exchangeAll(runs);
    std::vector<KeyRun> counted;  // each key once
    comm_.together(kCounting, [&] { counted = joined(runs); });
    uint64_t here = 0;
    for (const KeyRun& run : counted) here += run.length * run.count;
    const std::vector<uint64_t> counts = comm_.gatherAll(here);
    KeysBefore result;
    result.all = std::accumulate(counts.begin(), counts.end(), uint64_t(0));
    std::vector<std::vector<uint64_t>> first;
    comm_.together(kCounting,
                   [&] { first = firstOf(runs, counted, std::accumulate(counts.begin(), counts.begin() + comm_.rank(), uint64_t(0))); });
    first = comm_.exchangeAll(first);
    comm_.together(kCounting, [&] {
      result.before.resize(keys_.size());
      for (const SentRun& run : sent_) {
        for (size_t i = 0; i < run.length; ++i) result.before[run.first + i] = first[run.to][run.place] + i * keys_[run.first].count;
      }
    });
    return result;
  }

 private:
  /// Per process that counts them.
  std::vector<std::vector<KeyRun>> findRuns() {
    std::vector<std::vector<KeyRun>> runs(size_t(comm_.size()));
    for (size_t i = 0; i < keys_.size(); ++i) {
      const auto [key, count] = keys_[i];
      const size_t to = size_t(key / block_);
      const bool follows = i > 0 && key == keys_[i - 1].key + 1 && count == keys_[i - 1].count && sent_.back().to == to;
      if (follows) {
        ++runs[to].back().length, ++sent_.back().length;
        continue;
      }
      sent_.push_back({to, runs.at(to).size(), i, 1});
      runs[to].push_back({key, 1, count});
    }
    return runs;
  }

  /// In order, without what others have, too.
  static std::vector<KeyRun> joined(const std::vector<std::vector<KeyRun>>& runs) {
    std::vector<KeyRun> all, result;
    for (const std::vector<KeyRun>& some : runs) all.insert(all.end(), some.begin(), some.end());
    detail::sortItems(all, [](const KeyRun& a, const KeyRun& b) { return a.key < b.key; });
    uint64_t end = 0;
    for (const KeyRun& run : all) {
      const uint64_t begin = std::max(run.key, end), past = run.key + run.length;
      if (begin >= past) continue;
      result.push_back({begin, past - begin, run.count});
      end = past;
    }
    return result;
  }

  /// How many come before each of the runs, of which `before` come before this process's.
  static std::vector<std::vector<uint64_t>> firstOf(const std::vector<std::vector<KeyRun>>& runs, const std::vector<KeyRun>& counted,
                                                    uint64_t before) {
    std::vector<uint64_t> starts;
    for (const KeyRun& run : counted) {
      starts.push_back(before);
      before += run.length * run.count;
    }
    std::vector<std::vector<uint64_t>> first(runs.size());
    for (size_t rank = 0; rank < runs.size(); ++rank) {
      for (const KeyRun& run : runs[rank]) {
        const auto past =
            std::upper_bound(counted.begin(), counted.end(), run.key, [](uint64_t key, const KeyRun& r) { return key < r.key; });
        const size_t at = size_t(past - counted.begin()) - 1;
        first[rank].push_back(starts[at] + (run.key - counted[at].key) * counted[at].count);
      }
    }
    return first;
  }

  detail::Communicator& comm_;
  const std::vector<KeyCount>& keys_;
  uint64_t block_ = 1;
  std::vector<SentRun> sent_;
};

}  // namespace

KeysBefore countKeys(detail::Communicator& comm, const std::vector<KeyCount>& keys) { return KeyCounter(comm, keys).run(); }

}  // namespace mandoline::cli

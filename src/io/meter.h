// Progress of writers.
#pragma once

#include "base/parallel.h"
#include "mandoline/io.h"

namespace mandoline::detail {

/// Passes the pieces of a file on and tells the caller after each of them how far it has come; that may cancel the writing.
class Meter {
 public:
  Meter(const Sink& sink, const RunOptions& options, int stages = 1) : sink_(sink), monitor_(options, stages) {}

  /// `total` items, in any unit.
  void beginStage(const char* name, int index, uint64_t total) {
    done_ = 0;
    total_ = std::max(total, uint64_t(1));
    monitor_.beginStage(name, index);
  }
  void advance(uint64_t items = 1) { done_ += items; }
  void report() { monitor_.report(size_t(done_), size_t(total_)); }
  void write(std::string_view piece) {
    sink_(piece);
    report();
  }

 private:
  const Sink& sink_;
  Monitor monitor_;
  uint64_t done_ = 0, total_ = 1;
};

}  // namespace mandoline::detail

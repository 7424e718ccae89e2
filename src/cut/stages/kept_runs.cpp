#include "cut/stages/kept_runs.h"

#include <cstring>
#include <numeric>

namespace mandoline::detail {

std::unique_ptr<uint32_t[]> KeptRuns::numbersNow(size_t countBefore) const {
  std::unique_ptr<uint32_t[]> now(new uint32_t[countBefore]);
  for (const Run& run : runs) std::iota(now.get() + run.before, now.get() + run.before + run.count, run.first);
  return now;
}

void KeptRuns::move(void* things, size_t bytes, FunctionRef<void(const Run&, size_t)> then) const {
  constexpr uint32_t kPart = 2048;  // things, which are still in the cache when then() is called
  char* const data = static_cast<char*>(things);
  const auto bring = [&](size_t i, uint32_t begin) {
    const Run part{runs[i].first + begin, runs[i].before + begin, std::min(kPart, runs[i].count - begin)};
    if (part.first != part.before) std::memmove(data + bytes * part.first, data + bytes * part.before, bytes * part.count);
    then(part, i);
  };
  // What moves down comes to lie only on what such things before it have left, what moves up on what those after it have.
  for (size_t i = 0; i < runs.size(); ++i) {
    if (runs[i].first > runs[i].before) continue;
    for (uint32_t begin = 0; begin < runs[i].count; begin += kPart) bring(i, begin);
  }
  for (size_t i = runs.size(); i-- > 0;) {
    if (runs[i].first <= runs[i].before) continue;
    for (uint32_t part = (runs[i].count + kPart - 1) / kPart; part-- > 0;) bring(i, part * kPart);
  }
}

}  // namespace mandoline::detail

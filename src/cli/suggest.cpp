#include "cli/suggest.h"

#include <algorithm>
#include <cstdint>

namespace mandoline::cli {
namespace {

/// How many characters have to be taken away, added, replaced, or swapped with the next, to make b of a.
size_t distance(std::string_view a, std::string_view b) {
  std::vector<size_t> last, row(b.size() + 1), before;  // of the prefixes of a that end at i - 1, at i and at i - 2
  for (size_t j = 0; j <= b.size(); ++j) row[j] = j;
  for (size_t i = 1; i <= a.size(); ++i) {
    before.swap(last);
    last = row;
    row[0] = i;
    for (size_t j = 1; j <= b.size(); ++j) {
      row[j] = std::min({last[j] + 1, row[j - 1] + 1, last[j - 1] + (a[i - 1] != b[j - 1])});
      const bool isSwap = i > 1 && j > 1 && a[i - 1] == b[j - 2] && a[i - 2] == b[j - 1];
      if (isSwap) row[j] = std::min(row[j], before[j - 2] + 1);
    }
  }
  return row[b.size()];
}

}  // namespace

std::string nearest(std::string_view word, const std::vector<std::string>& words) {
  std::string found;
  size_t least = SIZE_MAX;
  for (const std::string& candidate : words) {
    const size_t d = distance(word, candidate);
    if (d >= least || d > std::max(size_t(1), candidate.size() / 3)) continue;
    least = d;
    found = candidate;
  }
  return found;
}

}  // namespace mandoline::cli

// What was meant by a word that is none of those expected.
#pragma once

#include <string>
#include <string_view>
#include <vector>

namespace mandoline::cli {

/// The nearest of the words, the first of equally near ones: at most a third of its characters, but at least one, are missing, too many,
/// wrong or swapped with the next. Empty if none is that near.
std::string nearest(std::string_view word, const std::vector<std::string>& words);

}  // namespace mandoline::cli

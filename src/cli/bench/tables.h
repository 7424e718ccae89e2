// What the benchmark prints.
#pragma once

#include "cli/bench/measure.h"

namespace mandoline::bench {

/// Columns, the times of the stages, and comparisons of one cut with another.
void printText(const std::vector<Row>& rows);
/// The README's table, and the ranges that it names below.
void printMarkdown(const std::vector<Row>& rows);
void printJson(const std::vector<Row>& rows);

}  // namespace mandoline::bench

// Errors of solutions about balls and in them.
#pragma once

#include "cli/orders/complaints.h"

namespace mandoline::orders {

/// Prints a table with each of the numbers of cells along a side of the grid.
void printBalls(const std::vector<int64_t>& cells, Orders& orders);

}  // namespace mandoline::orders

// A process's cells against the cell complex of the whole.
#pragma once

#include "mandoline/distributed.h"

/// Throws a std::runtime_error that says what differs. Collective: seams are compared with those of the other processes.
void compareComplex(const mandoline::RankComplex& mine, const mandoline::CellComplex& whole);

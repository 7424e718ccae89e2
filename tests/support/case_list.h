// A bit of everything that can be cut, for tests that compare the cuts of one input in several forms.
#pragma once

#include <vector>

#include "mandoline/mandoline.h"

struct NamedCase {
  const char* name;
  mandoline::Mesh mesh;
  mandoline::Grid grid;
};

/// All coordinates are multiples of 2^-20 below 16, so that they can be reflected, scaled and moved by whole cells without rounding.
std::vector<NamedCase> caseList();

/// The same, and 150 soups on a lattice.
std::vector<NamedCase> casesAndSoups();

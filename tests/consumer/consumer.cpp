#include <cstdio>

#include "outcome.h"

int main() {
  try {
    std::puts(outcome().c_str());
  } catch (const std::exception& error) {
    std::puts(error.what());
    return 1;
  }
}

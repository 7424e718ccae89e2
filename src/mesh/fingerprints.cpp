#include "mesh/fingerprints.h"

#include <cmath>
#include <cstring>

namespace mandoline::detail {

void Fingerprinter::add(double number) {
  number += 0.0;  // -0 becomes 0
  uint64_t bits = ~uint64_t(0);
  if (!std::isnan(number)) std::memcpy(&bits, &number, sizeof bits);
  add(bits);
}

void Fingerprinter::add(std::span<const double> numbers) {
  add(uint64_t(numbers.size()));
  for (const double number : numbers) add(number);
}

void Fingerprinter::add(std::span<const uint32_t> numbers) {
  add(uint64_t(numbers.size()));
  size_t i = 0;
  for (; i + 1 < numbers.size(); i += 2) add(uint64_t(numbers[i]) << 32 | numbers[i + 1]);
  if (i < numbers.size()) add(uint64_t(numbers[i]));
}

Fingerprint fingerprintOf(const MeshView& mesh) {
  Fingerprinter result("mesh");
  result.add(mesh.positions);
  result.add(mesh.triangles);
  return result.get();
}

}  // namespace mandoline::detail

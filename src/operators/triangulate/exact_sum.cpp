#include "operators/triangulate/exact_sum.h"

namespace mandoline::operators {

/// Grown to an expansion (Shewchuk 1997).
double leadingTerm(std::span<const detail::TwoTerms> products) {
  double terms[12];
  int count = 0;
  for (const detail::TwoTerms& product : products) {
    for (double carry : {product.low, product.high}) {
      for (int i = 0; i < count; ++i) {
        const detail::TwoTerms sum = detail::twoSum(carry, terms[i]);
        terms[i] = sum.low;
        carry = sum.high;
      }
      terms[count++] = carry;
    }
  }
  while (count > 0 && terms[count - 1] == 0) --count;
  return count > 0 ? terms[count - 1] : 0;
}

}  // namespace mandoline::operators

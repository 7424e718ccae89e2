#include "operators/triangulate/plane_point.h"

#include <array>

#include "base/error_free.h"

namespace mandoline::operators {

using detail::twoProduct;
using detail::TwoTerms;

/// The sum of six products, grown to an expansion (Shewchuk 1997).
double exactOrientation(const PlanePoint& a, const PlanePoint& b, const PlanePoint& c) {
  const TwoTerms products[6] = {twoProduct(a.x, b.y),  twoProduct(-a.y, b.x), twoProduct(b.x, c.y),
                                twoProduct(-b.y, c.x), twoProduct(c.x, a.y),  twoProduct(-c.y, a.x)};
  double terms[12];
  int count = 0;
  for (const TwoTerms& product : products) {
    for (double carry : std::array{product.low, product.high}) {
      for (int i = 0; i < count; ++i) {
        const TwoTerms sum = detail::twoSum(carry, terms[i]);
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

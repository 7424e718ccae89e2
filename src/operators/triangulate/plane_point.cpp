#include "operators/triangulate/plane_point.h"

#include "operators/triangulate/exact_sum.h"

namespace mandoline::operators {

using detail::twoProduct;
using detail::TwoTerms;

double exactOrientation(const PlanePoint& a, const PlanePoint& b, const PlanePoint& c) {
  const TwoTerms products[] = {twoProduct(a.x, b.y),  twoProduct(-a.y, b.x), twoProduct(b.x, c.y),
                               twoProduct(-b.y, c.x), twoProduct(c.x, a.y),  twoProduct(-c.y, a.x)};
  return leadingTerm(products);
}

}  // namespace mandoline::operators

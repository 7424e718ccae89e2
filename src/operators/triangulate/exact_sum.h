// The sign of a sum of products, exactly and without allocating.
#pragma once

#include <span>

#include "base/error_free.h"

namespace mandoline::operators {

/// The largest term of the exact sum of at most 6 products: it has the sum's sign, and is 0 if that is.
double leadingTerm(std::span<const detail::TwoTerms> products);

}  // namespace mandoline::operators

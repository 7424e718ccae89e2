// Refuses to compile where arithmetic is not plain IEEE in doubles, on which exactness rests. CMakeLists.txt sets the flags for it.
#pragma once

#include <cfloat>
#include <limits>

#if defined(__FAST_MATH__) || defined(_M_FP_FAST) || (defined(__FINITE_MATH_ONLY__) && __FINITE_MATH_ONLY__)
#error "mandoline has to be compiled without -ffast-math, -Ofast and the like (/fp:precise for MSVC)"
#endif
#if !defined(FLT_EVAL_METHOD) || FLT_EVAL_METHOD != 0
#error "mandoline has to be compiled for arithmetic that rounds to double each time (x86: -msse2 -mfpmath=sse)"
#endif
static_assert(std::numeric_limits<double>::is_iec559);

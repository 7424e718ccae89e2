#include "io/print_number.h"

#ifdef __EMSCRIPTEN__
#include <emscripten/emscripten.h>

EM_JS(int, mandolinePrintDouble, (double n, char* to), {
  const text = Object.is(n, -0) ? '-0' : String(n);
  for (let i = 0; i < text.length; ++i) HEAP8[to + i] = text.charCodeAt(i);
  return text.length;
});

namespace mandoline::detail {

char* printNumber(char* begin, char*, double n) { return begin + mandolinePrintDouble(n, begin); }

}  // namespace mandoline::detail
#endif

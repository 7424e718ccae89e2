#include "mesh/read/parse_number.h"

#include <system_error>

#ifdef MANDOLINE_HAVE_FAST_FLOAT

#include <fast_float/fast_float.h>

namespace mandoline::detail {

const char* parseNumber(const char* first, const char* last, double& value) {
  const auto [end, error] = fast_float::from_chars(first, last, value);
  return error == std::errc::invalid_argument ? first : end;  // out of range it gives 0 or infinity
}

}  // namespace mandoline::detail

#else

#include <algorithm>
#include <cctype>
#include <charconv>
#include <clocale>
#include <cstdlib>
#include <string>

namespace mandoline::detail {
namespace {

const char* parseByStrtod(const char* first, const char* last, double& value) {
  const auto belongs = [](unsigned char c) { return std::isalnum(c) || c == '+' || c == '-' || c == '.'; };
  std::string text(first, std::find_if_not(first, last, belongs));  // strtod looks for its end, and takes more
  text.resize(std::min(text.size(), text.find_first_of("xX")));
  if (text.find_first_of("0123456789.inIN") != (text[0] == '-')) return first;
  std::replace(text.begin(), text.end(), '.', *std::localeconv()->decimal_point);
  char* end = nullptr;
  const double parsed = std::strtod(text.c_str(), &end);
  if (end != text.c_str()) value = parsed;
  return first + (end - text.c_str());
}

}  // namespace

#if defined(_LIBCPP_VERSION) && _LIBCPP_VERSION < 200000  // where std::from_chars lacks doubles
const char* parseNumber(const char* first, const char* last, double& value) { return parseByStrtod(first, last, value); }
#else
const char* parseNumber(const char* first, const char* last, double& value) {
  const auto [end, error] = std::from_chars(first, last, value);
  if (error == std::errc::result_out_of_range) return parseByStrtod(first, end, value);  // for which std::from_chars gives no value
  return error == std::errc::invalid_argument ? first : end;
}
#endif

}  // namespace mandoline::detail

#endif

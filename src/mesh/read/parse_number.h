// Numbers in text.
#pragma once

namespace mandoline::detail {

/// Takes the number at `first`, as std::from_chars does: decimal, inf or nan in letters of any case, with no sign but '-'. Gives where it
/// ends, or `first` if there is none. Rounded to the nearest double; one too large for any is infinite.
const char* parseNumber(const char* first, const char* last, double& value);

}  // namespace mandoline::detail

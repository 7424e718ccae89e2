// Formats that people bring and that are not read.
#pragma once

#include <string_view>

namespace mandoline::detail {

struct UnreadFormat {
  std::string_view name;  ///< with its article
  std::string_view way;   ///< what to do with such a file
};

/// The format that the bytes are of, or null.
const UnreadFormat* unreadByContent(std::string_view bytes);
/// The format of files with that extension, in lower case with its dot, or null.
const UnreadFormat* unreadByExtension(std::string_view extension);

}  // namespace mandoline::detail

// Members of JSON objects.
#pragma once

#include <cmath>
#include <type_traits>

#include "io/output_buffer.h"
#include "mandoline/io.h"

namespace mandoline::detail {

/// Numbers that JSON can't hold become null: volumes of huge cells are beyond all doubles.
template <class Array>
void writeArray(OutputBuffer& out, const Array& array) {
  char separator = '[';
  for (const auto& item : array) {
    out.character(separator);
    if constexpr (sizeof item == 1) {
      out.number(int(item));  // not a character
    } else if (std::is_floating_point_v<std::decay_t<decltype(item)>> && !std::isfinite(double(item))) {
      out.text("null");
    } else {
      out.number(item);
    }
    separator = ',';
    out.advance();
  }
  if (separator == '[') out.character(separator);
  out.character(']');
}

template <class Array>
void writeMember(OutputBuffer& out, std::string_view key, const Array& array) {
  out.text(",\n\"");
  out.text(key);
  out.text("\":");
  writeArray(out, array);
}

/// Of a struct: madeFrom and fingerprint.
template <class Struct>
void writeFingerprints(OutputBuffer& out, const Struct& value) {
  out.text(",\n\"madeFrom\":\"" + value.madeFrom.text() + "\",\n\"fingerprint\":\"" + value.fingerprint.text() + '"');
}

/// groupNames and triangleGroup.
void writeGroups(OutputBuffer& out, const TriangleGroups& groups);

}  // namespace mandoline::detail

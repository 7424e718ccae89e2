// Numbers in binary files.
#pragma once

#include <algorithm>
#include <bit>
#include <cstring>

namespace mandoline::detail {

enum class ByteOrder { little, big };

inline constexpr ByteOrder kNativeOrder = std::endian::native == std::endian::little ? ByteOrder::little : ByteOrder::big;

template <class Scalar>
Scalar loadScalar(const char* bytes, ByteOrder order) {
  char copy[sizeof(Scalar)];
  std::memcpy(copy, bytes, sizeof copy);
  if (order != kNativeOrder) std::reverse(copy, copy + sizeof copy);
  Scalar value;
  std::memcpy(&value, copy, sizeof copy);
  return value;
}

}  // namespace mandoline::detail

// Structs as bytes, for messages between processes of the same program on machines of one kind.
#pragma once

#include <cstring>
#include <string>
#include <type_traits>

#include "mandoline/fields.h"
#include "mandoline/grid.h"
#include "mesh/failure.h"

namespace mandoline::detail {

class Packer {
 public:
  /// Grids are left out: all processes know them.
  template <class Field>
  void add(const Field& field) {
    if constexpr (std::is_same_v<Field, Grid>) {
    } else if constexpr (requires { field.isPresent(); }) {
      add(uint8_t(field.isPresent()));
      add(field.items);
    } else if constexpr (isVector<Field> || std::is_same_v<Field, std::string>) {
      add(uint64_t(field.size()));
      addBytes(field.data(), field.size() * sizeof(field[0]));
    } else if constexpr (requires { Field::fields(field, [](auto&&...) {}); }) {
      Field::fields(field, [&](const auto&, const auto& member) { add(member); });
    } else {
      static_assert(std::is_trivially_copyable_v<Field> && !std::is_pointer_v<Field>);
      addBytes(&field, sizeof field);
    }
  }

  std::vector<std::byte> bytes;

 private:
  void addBytes(const void* from, size_t count) {
    const size_t at = bytes.size();
    bytes.resize(at + count);
    if (count > 0) std::memcpy(bytes.data() + at, from, count);
  }
};

class Unpacker {
 public:
  explicit Unpacker(const std::vector<std::byte>& bytes) : bytes_(bytes) {}

  template <class Field>
  void get(Field&& field) {
    using Plain = std::remove_cvref_t<Field>;
    if constexpr (std::is_same_v<Plain, Grid>) {
    } else if constexpr (requires { field.isPresent(); }) {
      uint8_t isPresent = 0;
      get(isPresent);
      get(field.items);
      field.setPresent(isPresent != 0);
    } else if constexpr (isVector<Plain> || std::is_same_v<Plain, std::string>) {
      uint64_t count = 0;
      get(count);
      if (count > (bytes_.size() - at_) / sizeof(field[0])) fail();
      field.resize(count);
      getBytes(field.data(), count * sizeof(field[0]));
    } else if constexpr (requires { Plain::fields(field, [](auto&&...) {}); }) {
      Plain::fields(field, [&](const auto&, auto&& member) { get(member); });
    } else {
      static_assert(std::is_trivially_copyable_v<Plain>);
      getBytes(&field, sizeof field);
    }
  }

 private:
  [[noreturn]] static void fail() { throw Failure{{Status::internalError, -1, -1, "A message of another process is too short."}}; }
  void getBytes(void* to, size_t count) {
    if (count > bytes_.size() - at_) fail();
    if (count > 0) std::memcpy(to, bytes_.data() + at_, count);
    at_ += count;
  }

  const std::vector<std::byte>& bytes_;
  size_t at_ = 0;
};

template <class Struct>
std::vector<std::byte> packed(const Struct& from) {
  Packer packer;
  packer.add(from);
  return std::move(packer.bytes);
}
template <class Struct>
Struct unpacked(const std::vector<std::byte>& bytes) {
  Struct to;
  Unpacker(bytes).get(to);
  return to;
}

}  // namespace mandoline::detail

// The header of a PLY file.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "mesh/read/text_cursor.h"

namespace mandoline::detail::ply {

enum class Type : uint8_t { int8, uint8, int16, uint16, int32, uint32, float32, float64 };

struct TypeName {
  const char* name;
  Type type;
  size_t size;
};

enum class Role : uint8_t { skipped, x, y, z, corners };

struct Property {
  TypeName type;
  bool isList = false;
  TypeName countType;
  Role role = Role::skipped;
};

struct Element {
  std::string name;
  uint64_t count = 0;
  size_t line = 0;
  std::vector<Property> properties;

  bool has(Role role) const {
    for (const Property& p : properties) {
      if (p.role == role) return true;
    }
    return false;
  }
};

enum class Encoding : uint8_t { text, binaryLittle, binaryBig };

struct Header {
  Encoding encoding = Encoding::text;
  std::vector<Element> elements;
  uint64_t vertexCount = 0;
};

/// Leaves the cursor behind the line "end_header".
Header readHeader(TextCursor& cursor);

}  // namespace mandoline::detail::ply

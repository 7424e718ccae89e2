// Files of cut-meshes that were altered by someone who knows the format.
#pragma once

#include <string>

#include "io/mcm/record.h"
#include "mandoline/io.h"

inline std::string mcmOf(const mandoline::CutMesh& cutMesh) {
  std::string bytes;
  mandoline::writeMcm([&](std::string_view piece) { bytes += piece; }, cutMesh);
  return bytes;
}

inline mandoline::CutMesh readMcm(const std::string& bytes) { return mandoline::readCutMesh(bytes, "a.mcm"); }

/// Gives each record, as far as there are any, the checksum that it should have.
inline void repairChecksums(std::string& bytes) {
  using namespace mandoline::detail;
  std::string_view rest(bytes);
  try {
    takeBytes(rest, kMcmSignature.size());
    takeLength(rest);
    while (!rest.empty()) {
      RecordHead head;
      head.name = takeBytes(rest, takeLength(rest));
      head.length = takeLength(rest);
      head.payload = takeLength(rest);
      const size_t at = bytes.size() - takeBytes(rest, kChecksumBytes).size() - rest.size();
      std::string checksum;
      putWord(checksum, head.expectedChecksum(takeBytes(rest, head.payload)), kChecksumBytes);
      bytes.replace(at, checksum.size(), checksum);
    }
  } catch (const Damaged&) {
  }
}

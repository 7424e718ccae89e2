#include <new>
#include <stdexcept>

#include "io/mcm/record.h"
#include "mandoline/io.h"
#include "mandoline/validate.h"
#include "mesh/read/load_file.h"
#include "mesh/read/scalar.h"

namespace mandoline {
namespace detail {
namespace {

class McmReader {
 public:
  McmReader(std::string_view bytes, const std::string& path) : all_(bytes), rest_(bytes), path_(path) {}

  CutMesh read() {
    takeStart();
    CutMesh cutMesh;
    Record head = takeRecord(kHeadName);
    decode(head, [&] { codeHead<ReadStream>(head.payload, cutMesh); });
    std::vector<Record> records;
    forEachArray(cutMesh, [&](const ArrayInfo& info, auto&) { records.push_back(takeRecord(info.name)); });
    if (!rest_.empty()) fail(position(), "goes on after its last array");
    for (const bool derived : {false, true}) {
      auto record = records.begin();
      forEachArray(cutMesh, [&](const ArrayInfo& info, auto& array) {
        Record& r = *record++;
        if (isDerived(cutMesh, array) != derived) return;
        decode(r, [&] { codePayload<ReadStream>(r.payload, cutMesh, info, array, r.head.length); });
      });
    }
    const Check check = checkArrays(cutMesh);
    if (!check.pass) throw FileError(path_ + ": is no cut-mesh: " + check.message);
    return cutMesh;
  }

 private:
  struct Record {
    RecordHead head;
    std::string_view payload;
    size_t position;  ///< of the payload
  };

  size_t position() const { return all_.size() - rest_.size(); }
  [[noreturn]] void fail(size_t byte, const std::string& what) const {
    throw FileError(path_ + ": byte " + std::to_string(byte) + ": " + what);
  }
  [[noreturn]] void failInside(std::string_view name) const { fail(all_.size(), "the file ends inside of " + std::string(name)); }

  void takeStart() {
    if (!rest_.starts_with(kMcmSignature)) {
      if (kMcmSignature.starts_with(rest_)) failInside("its signature");
      throw FileError(path_ + ": is not a .mcm file");
    }
    rest_.remove_prefix(kMcmSignature.size());
    const uint64_t version = takeNumber("its version");
    if (version != kMcmVersion) {
      throw FileError(path_ + ": has the version " + std::to_string(version) + " of the format; this library reads version " +
                      std::to_string(kMcmVersion));
    }
  }

  uint64_t takeNumber(std::string_view name) {
    const size_t begin = position();
    try {
      return takeLength(rest_);
    } catch (const Damaged&) {
      if (rest_.empty()) failInside(name);
      fail(begin, "a length in " + std::string(name) + " can't be read");
    }
  }

  std::string_view take(uint64_t count, std::string_view name) {
    if (count > rest_.size()) failInside(name);
    return takeBytes(rest_, count);
  }

  Record takeRecord(std::string_view name) {
    const size_t begin = position();
    const uint64_t nameLength = takeNumber(name);
    const std::string_view found = rest_.substr(0, size_t(std::min<uint64_t>(nameLength, rest_.size())));
    if (found != name) {
      if (found.size() < nameLength && name.starts_with(found)) failInside(name);
      fail(begin, "the array " + std::string(name) + " should begin here");
    }
    rest_.remove_prefix(found.size());
    Record record;
    record.head = {name, takeNumber(name), takeNumber(name), 0};
    record.head.checksum = loadScalar<uint64_t>(take(kChecksumBytes, name).data(), ByteOrder::little);
    record.position = position();
    record.payload = take(record.head.payload, name);
    if (record.head.expectedChecksum(record.payload) != record.head.checksum) {
      fail(begin, std::string(name) + " has been altered: its checksum is another");
    }
    return record;
  }

  template <class Decode>
  void decode(Record& record, const Decode& work) const {
    const std::string name(record.head.name);
    try {
      work();
    } catch (const Damaged& damaged) {
      fail(record.position, name + ' ' + damaged.what);
    }
    if (!record.payload.empty()) fail(record.position, name + " has bytes left over");
  }

  std::string_view all_, rest_;
  const std::string& path_;
};

}  // namespace
}  // namespace detail

CutMesh readCutMesh(std::span<const char> bytes, const std::string& name) {
  try {
    return detail::McmReader({bytes.data(), bytes.size()}, name).read();
  } catch (const std::bad_alloc&) {
    throw FileError(name + ": does not fit into memory");
  } catch (const std::length_error&) {
    throw FileError(name + ": does not fit into memory");
  }
}

CutMesh readCutMesh(const std::string& path) {
  try {
    return readCutMesh(detail::loadFile(path), path);
  } catch (const std::bad_alloc&) {
    throw FileError(path + ": does not fit into memory");
  }
}

}  // namespace mandoline

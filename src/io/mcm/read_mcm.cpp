#include <algorithm>
#include <filesystem>
#include <new>
#include <stdexcept>

#include "io/mcm/piece_records.h"
#include "io/mcm/record.h"
#include "mandoline/io.h"
#include "mandoline/validate.h"
#include "mesh/read/load_file.h"
#include "mesh/read/scalar.h"
#include "operators/join/check_piece.h"

namespace mandoline {
namespace detail {
namespace {

namespace fs = std::filesystem;

class McmReader {
 public:
  McmReader(std::string_view bytes, const std::string& path) : all_(bytes), rest_(bytes), path_(path) {}

  /// A cut-mesh alone is what a piece has of it.
  RankPiece read() {
    takeStart();
    RankPiece piece;
    readCutMesh(piece.cutMesh);
    if (beginsWithPiece()) readPiece(piece);
    if (!rest_.empty()) fail(position(), "goes on after its last array");
    return piece;
  }
  bool isOfPiece() const { return isOfPiece_; }

 private:
  struct Record {
    RecordHead head;
    std::string_view payload;
    size_t position;  ///< of the payload
  };

  void readCutMesh(CutMesh& cutMesh) {
    Record head = takeRecord(kHeadName);
    decode(head, [&] { codeHead<ReadStream>(head.payload, cutMesh); });
    std::vector<Record> records;
    forEachArray(cutMesh, [&](const ArrayInfo& info, auto&) { records.push_back(takeRecord(info.name)); });
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
  }

  /// Also if what there is of it ends too soon.
  bool beginsWithPiece() const {
    std::string begin;
    putLength(begin, kPieceName.size());
    begin += kPieceName;
    return !rest_.empty() && (rest_.starts_with(begin) || std::string_view(begin).starts_with(rest_));
  }

  void readPiece(RankPiece& piece) {
    isOfPiece_ = true;
    Record head = takeRecord(kPieceName);
    decode(head, [&] { codePieceHead<ReadStream>(head.payload, piece); });
    forEachIdArray(piece, [&](const char* name, auto& array) {
      Record record = takeRecord(name);
      decode(record, [&] { codeArray<ReadStream>(record.payload, {name, Element::vertex}, array, record.head.length); });
    });
    Record seams = takeRecord(kSeamsName);
    decode(seams, [&] { codeSeams<ReadStream>(seams.payload, piece, seams.head.length); });
    if (const char* wrong = operators::whatIsWrong(piece)) throw FileError(path_ + ": is no piece of a cut: " + wrong);
  }

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
  bool isOfPiece_ = false;
};

/// Calls body() and gives what it does.
template <class Body>
auto readAs(const std::string& name, const Body& body) {
  try {
    return body();
  } catch (const std::bad_alloc&) {
    throw FileError(name + ": does not fit into memory");
  } catch (const std::length_error&) {
    throw FileError(name + ": does not fit into memory");
  }
}

/// Those of a folder, by their names.
std::vector<std::string> mcmFiles(const std::string& folder) {
  std::vector<std::string> files;
  try {
    for (const fs::directory_entry& entry : fs::directory_iterator(folder)) {
      if (formatOf(entry.path().string()) == FileFormat::mcm) files.push_back(entry.path().string());
    }
  } catch (const fs::filesystem_error& error) {
    throw FileError(folder + ": can't be read: " + error.code().message());
  }
  std::sort(files.begin(), files.end());
  return files;
}

CutMesh readPieces(const std::string& folder) {
  const std::vector<std::string> files = mcmFiles(folder);
  if (files.empty()) throw FileError(folder + ": there are no .mcm files in the folder");
  std::vector<RankPiece> pieces;
  for (const std::string& file : files) pieces.push_back(readRankPiece(file));
  try {
    return joinPieces(pieces);
  } catch (const CallError& error) {
    const int64_t piece = error.error.element;
    throw FileError((piece < 0 ? folder : files[size_t(piece)]) + ": " + error.error.message);
  }
}

}  // namespace
}  // namespace detail

CutMesh readCutMesh(std::span<const char> bytes, const std::string& name) {
  return detail::readAs(name, [&] { return detail::McmReader({bytes.data(), bytes.size()}, name).read().cutMesh; });
}

CutMesh readCutMesh(const std::string& path) {
  return detail::readAs(path, [&] {
    std::error_code none;
    return std::filesystem::is_directory(path, none) ? detail::readPieces(path) : readCutMesh(detail::loadFile(path), path);
  });
}

RankPiece readRankPiece(std::span<const char> bytes, const std::string& name) {
  return detail::readAs(name, [&] {
    detail::McmReader reader({bytes.data(), bytes.size()}, name);
    RankPiece piece = reader.read();
    if (!reader.isOfPiece()) throw FileError(name + ": has a whole cut-mesh, not a piece of one");
    return piece;
  });
}

RankPiece readRankPiece(const std::string& path) {
  return detail::readAs(path, [&] { return readRankPiece(detail::loadFile(path), path); });
}

}  // namespace mandoline

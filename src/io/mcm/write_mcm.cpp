#include "io/mcm/piece_records.h"
#include "io/mcm/record.h"
#include "io/meter.h"
#include "mesh/run_call.h"
#include "operators/require_cut_mesh.h"

namespace mandoline {
namespace detail {
namespace {

class McmWriter {
 public:
  McmWriter(Meter& meter, const CutMesh& cutMesh) : meter_(meter), cutMesh_(cutMesh) {}

  /// The cut-mesh, and what else there is of the piece that it is of, unless that is null.
  void write(const RankPiece* piece) {
    uint64_t entries = 0;
    forEachArray(cutMesh_, [&](const ArrayInfo&, const auto& array) { entries += array.size(); });
    if (piece) forEachIdArray(*piece, [&](const char*, const auto& array) { entries += array.size(); });
    meter_.beginStage("write", 0, entries);
    writeCutMesh();
    if (piece) writePiece(*piece);
  }

 private:
  void writeCutMesh() {
    std::string start(kMcmSignature);
    putLength(start, kMcmVersion);
    meter_.write(start);
    codeHead<WrittenStream>(payload_, cutMesh_);
    writeRecord(kHeadName, 0);
    forEachArray(cutMesh_, [&](const ArrayInfo& info, const auto& array) {
      codePayload<WrittenStream>(payload_, cutMesh_, info, array, array.size());
      meter_.advance(array.size());
      writeRecord(info.name, array.size());
    });
  }

  void writePiece(const RankPiece& piece) {
    codePieceHead<WrittenStream>(payload_, piece);
    writeRecord(kPieceName, 0);
    forEachIdArray(piece, [&](const char* name, const auto& array) {
      codeArray<WrittenStream>(payload_, {name, Element::vertex}, array, array.size());
      meter_.advance(array.size());
      writeRecord(name, array.size());
    });
    codeSeams<WrittenStream>(payload_, piece, piece.seams.size());
    writeRecord(kSeamsName, piece.seams.size());
  }

  void writeRecord(std::string_view name, uint64_t length) {
    const RecordHead head{name, length, payload_.size(), 0};
    std::string bytes;
    putLength(bytes, name.size());
    bytes += name;
    putLength(bytes, length);
    putLength(bytes, payload_.size());
    putWord(bytes, head.expectedChecksum(payload_), kChecksumBytes);
    meter_.write(bytes);
    meter_.write(payload_);
    payload_.clear();
  }

  Meter& meter_;
  const CutMesh& cutMesh_;
  std::string payload_;
};

void writeMcm(const Sink& sink, const CutMesh& cutMesh, const RankPiece* piece, const RunOptions& options) {
  operators::requireCutMesh(cutMesh);
  runCall("writing", [&] {
    Meter meter(sink, options);
    try {
      McmWriter(meter, cutMesh).write(piece);
    } catch (const Damaged& damaged) {
      operators::refuse(std::string("An array of the cut-mesh ") + damaged.what + ".");
    }
  });
}

}  // namespace
}  // namespace detail

void writeMcm(const Sink& sink, const CutMesh& cutMesh, const RunOptions& options) { detail::writeMcm(sink, cutMesh, nullptr, options); }

void writeMcm(const Sink& sink, const RankPiece& piece, const RunOptions& options) {
  detail::writeMcm(sink, piece.cutMesh, &piece, options);
}

}  // namespace mandoline

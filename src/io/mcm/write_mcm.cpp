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

  void write() {
    uint64_t entries = 0;
    forEachArray(cutMesh_, [&](const ArrayInfo&, const auto& array) { entries += array.size(); });
    meter_.beginStage("write", 0, entries);
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

 private:
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

}  // namespace
}  // namespace detail

void writeMcm(const Sink& sink, const CutMesh& cutMesh, const RunOptions& options) {
  operators::requireCutMesh(cutMesh);
  detail::runCall("writing", [&] {
    detail::Meter meter(sink, options);
    try {
      detail::McmWriter(meter, cutMesh).write();
    } catch (const detail::Damaged& damaged) {
      operators::refuse(std::string("An array of the cut-mesh ") + damaged.what + ".");
    }
  });
}

}  // namespace mandoline

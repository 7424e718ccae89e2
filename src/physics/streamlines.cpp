#include <optional>

#include "base/csr.h"
#include "mesh/run_call.h"
#include "physics/tracer.h"

namespace mandoline {
namespace {

struct Chunk {
  std::optional<physics::Tracer> tracer;
  Streamlines lines;
};

void append(const Streamlines& more, Streamlines& lines) {
  if (uint64_t(lines.speeds.size()) + more.speeds.size() >= uint64_t(1) << 32)
    throw CallError({Status::meshTooLarge, -1, -1, "The streamlines have 2^32 points or more."});
  for (const uint32_t first : more.offsets) lines.offsets.push_back(uint32_t(lines.speeds.size()) + first);
  lines.points.insert(lines.points.end(), more.points.begin(), more.points.end());
  lines.speeds.insert(lines.speeds.end(), more.speeds.begin(), more.speeds.end());
  lines.ends.insert(lines.ends.end(), more.ends.begin(), more.ends.end());
}

Streamlines traced(const FlowField& field, const MeshView& mesh, std::span<const double> seeds, const StreamlineOptions& options) {
  detail::Monitor monitor(options, 2);
  monitor.beginStage("seeds", 0);
  const physics::FieldMembers members(field);
  const std::vector<int64_t> starts = physics::membersAt(field, members, seeds);
  const physics::Obstacles obstacles(mesh, field.cutMesh.grid);
  monitor.beginStage("streamlines", 1);
  const auto trace = [&](Chunk& chunk, size_t begin, size_t end) {
    if (!chunk.tracer) chunk.tracer.emplace(field, members, obstacles, options);
    for (size_t i = begin; i < end; ++i) {
      if (starts[i] >= 0) {
        chunk.tracer->trace({seeds[3 * i], seeds[3 * i + 1], seeds[3 * i + 2]}, size_t(starts[i]), chunk.lines);
      } else {
        chunk.lines.offsets.push_back(uint32_t(chunk.lines.speeds.size()));
        chunk.lines.ends.push_back(StreamlineEnd::outside);
      }
    }
  };
  constexpr size_t kBlock = 16;
  Streamlines lines;
  for (const Chunk& chunk : detail::forChunks<Chunk>(starts.size(), monitor, trace, kBlock)) append(chunk.lines, lines);
  lines.offsets.push_back(uint32_t(lines.speeds.size()));
  return lines;
}

}  // namespace

Streamlines streamlines(const FlowField& field, std::span<const double> seeds, const StreamlineOptions& options) {
  const operators::CutInput input = physics::requireField(field, seeds);
  if (!(options.tolerance > 0)) throw CallError({Status::badOption, -1, -1, "The tolerance has to be positive."});
  if (!(options.maxLength >= 0)) throw CallError({Status::badOption, -1, -1, "The largest length has to be 0 or more."});
  return detail::runCall("tracing of streamlines", [&] { return traced(field, input.mesh(), seeds, options); });
}

}  // namespace mandoline

// The steps of a cut that several workers share (mandoline/cut_share.h): src/shares.js takes them.
#include <emscripten/bind.h>

#include "cut_meshes.h"
#include "mandoline/cut_share.h"

namespace {

using namespace mandoline;
using namespace mandoline::wasm;

constexpr int kCutStages = 6;

/// One share, which stays here from step to step, with the part that it made.
struct KeptShare {
  CutShare share;
  CutStats prepared;
  CutPart part;
  std::vector<int32_t> gridCellRegion;
};

/// `mesh` is null where options.prepared is the handle of one.
val beginShare(const val& mesh, const val& grid, const val& options) {
  return guarded([&] {
    PreparedMesh prepared;
    CutStats stats;
    if (mesh.isNull()) {
      prepared = options["prepared"].as<KeptMesh>().get();
    } else {
      PrepareOptions prepareOptions;
      prepareOptions.progress = progressBetween(options, 0, kCutStages);
      prepareOptions.intersections = Intersections(options["intersections"].as<int>());
      const Mesh input = fromObject<Mesh>(mesh);
      PrepareResult result = prepare(input, prepareOptions);
      if (!result) return failure(result.error, lastStage(result.stats));
      prepared = std::move(result.mesh);
      stats = std::move(result.stats);
    }
    const ShareOf shareOf{options["index"].as<uint32_t>(), options["count"].as<uint32_t>()};
    CutShare share(prepared, readGrid(grid, prepared.mesh()), shareOf, {1, progressBetween(options, stats.stages.size(), 0)});
    const val summary = toArray(share.summary());
    return success(object({{"share", val(KeptShare{std::move(share), std::move(stats), {}, {}})}, {"summary", summary}}));
  });
}

CutPart partOf(KeptShare& kept, const val& summaries, const val& options) {
  std::vector<std::vector<uint32_t>> all(summaries["length"].as<uint32_t>());
  for (uint32_t i = 0; i < all.size(); ++i) readArray(summaries[i], all[i]);
  return kept.share.part(all, {1, progressBetween(options, kept.prepared.stages.size(), 0)});
}

/// With what is known before others have made their parts.
val keepPart(KeptShare& kept, const val& summaries, const val& options) {
  return guarded([&] {
    kept.part = partOf(kept, summaries, options);
    if (options["gridCellRegion"].as<bool>()) kept.gridCellRegion = kept.share.gridCellRegion();
    return success(val::null());
  });
}

val makePart(KeptShare& kept, const val& summaries, const val& options) {
  return guarded([&] { return success(toObject(partOf(kept, summaries, options), options["copy"])); });
}

/// The whole of the part that was kept and those of the others.
val joinParts(KeptShare& kept, const val& others, const val& options) {
  return guarded([&] {
    std::vector<CutPart> parts;
    parts.push_back(std::move(kept.part));
    const uint32_t count = others["length"].as<uint32_t>();
    for (uint32_t i = 0; i < count; ++i) parts.push_back(fromObject<CutPart>(others[i]));
    CutResult result = kept.share.join(std::move(parts));
    std::vector<StageTime> stages = std::move(kept.prepared.stages);
    for (const StageTime& stage : result.stats.stages) stages.push_back(stage);
    result.stats.stages = std::move(stages);
    result.stats.totalMs += kept.prepared.totalMs;
    result.stats.exactFallbacks += kept.prepared.exactFallbacks;
    return outcomeOf(result, options, std::move(kept.gridCellRegion));
  });
}

val meshOf(const KeptMesh& kept) {
  return guarded([&] { return success(arraysOf(kept.get().mesh())); });
}

}  // namespace

EMSCRIPTEN_BINDINGS(shares) {
  emscripten::class_<KeptShare>("KeptShare");
  emscripten::function("beginShare", &beginShare);
  emscripten::function("keepPart", &keepPart);
  emscripten::function("makePart", &makePart);
  emscripten::function("joinParts", &joinParts);
  emscripten::function("meshOf", &meshOf);
}

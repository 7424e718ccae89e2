// The steps of a cut that several workers share (mandoline/cut_share.h): src/shares.js takes them.
#include <emscripten/bind.h>

#include "cut_meshes.h"
#include "mandoline/cut_share.h"
#include "mandoline/prepare_share.h"

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

ShareOf shareOf(const val& options) { return {options["index"].as<uint32_t>(), options["count"].as<uint32_t>()}; }

/// The search in a mesh that has not been prepared.
val findPairs(const val& mesh, const val& options) {
  return guarded([&] {
    PrepareOptions prepareOptions;
    prepareOptions.progress = progressBetween(options, 0, kCutStages);
    prepareOptions.intersections = Intersections(options["intersections"].as<int>());
    PrepareShare search(shareOf(options), prepareOptions);
    const val pairs = toArray(search.findPairs(std::make_shared<Mesh>(fromObject<Mesh>(mesh))));
    return success(object({{"search", val(std::move(search))}, {"pairs", pairs}}));
  });
}

/// While what others find is on its way.
val findEdges(PrepareShare& search) {
  return guarded([&] {
    search.findEdges();
    return success(val::null());
  });
}

val begin(const PreparedMesh& mesh, CutStats stats, const val& grid, const val& options) {
  CutShare share(mesh, readGrid(grid, mesh.mesh()), shareOf(options), {1, progressBetween(options, stats.stages.size(), 0)});
  const val summary = toArray(share.summary());
  return success(object({{"share", val(KeptShare{std::move(share), std::move(stats), {}, {}})}, {"summary", summary}}));
}

val beginShare(const KeptMesh& mesh, const val& grid, const val& options) {
  return guarded([&] { return begin(mesh.get(), {}, grid, options); });
}

/// After the search, of which options.pairs lists what each share found.
val beginSearched(PrepareShare& search, const val& grid, const val& options) {
  return guarded([&] {
    std::vector<uint32_t> pairs;
    const val found = options["pairs"];
    for (uint32_t i = 0; i < found["length"].as<uint32_t>(); ++i) {
      std::vector<uint32_t> some;
      readArray(found[i], some);
      pairs.insert(pairs.end(), some.begin(), some.end());
    }
    PrepareResult result = search.resolve(pairs);
    return begin(result.mesh, std::move(result.stats), grid, options);
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
  emscripten::class_<PrepareShare>("PrepareShare");
  emscripten::class_<KeptShare>("KeptShare");
  emscripten::function("findPairs", &findPairs);
  emscripten::function("findEdges", &findEdges);
  emscripten::function("beginShare", &beginShare);
  emscripten::function("beginSearched", &beginSearched);
  emscripten::function("keepPart", &keepPart);
  emscripten::function("makePart", &makePart);
  emscripten::function("joinParts", &joinParts);
  emscripten::function("meshOf", &meshOf);
}

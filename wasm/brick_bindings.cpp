// The calls that bricks/calls.js has: surfaces that move are cut again, grids are cut brick by brick, cells are refined. As in bindings.cpp
// nothing is decided here. A module of its own, which is loaded when the first of them is made.
#include <emscripten/bind.h>

#include <utility>

#include "cut_meshes.h"
#include "mandoline/for_each_brick.h"
#include "mandoline/recut.h"
#include "mandoline/refine.h"

namespace {

using namespace mandoline;
using namespace mandoline::wasm;

/// A recutter, until JavaScript deletes its handle.
class KeptRecutter {
 public:
  KeptRecutter(Grid grid, const CutOptions& options) : state_(std::make_shared<State>(std::move(grid), options)) {}

  val cut(const val& mesh, const val& options) {
    return guarded([&] {
      State& state = *state_;
      state.progress = progressOf(options);
      const Mesh input = fromObject<Mesh>(mesh);
      CutResult result = state.recutter.cut(input, std::exchange(state.spare, {}));
      state.progress = nullptr;
      const val outcome = outcomeOf(result, options);
      state.spare = std::move(result.mesh);
      return outcome;
    });
  }

  val counts() const {
    const auto [bricks, kept] = state_->recutter.counts();
    return success(object({{"bricks", val(double(bricks))}, {"kept", val(double(kept))}}));
  }

 private:
  struct State {
    State(Grid grid, const CutOptions& options) : recutter(std::move(grid), withProgress(options)) {}

    /// That of the cut that runs.
    CutOptions withProgress(CutOptions options) {
      options.progress = [this](const Progress& now) { return !progress || progress(now); };
      return options;
    }

    std::function<bool(const Progress&)> progress;
    CutMesh spare;  ///< of the last cut, if that did not become a twin
    Recutter recutter;
  };

  std::shared_ptr<State> state_;
};

val recutterOf(const val& grid, const val& options) {
  return guarded([&] {
    CutOptions cutOptions;
    cutOptions.snapTolerance = options["snapTolerance"].as<double>();
    cutOptions.intersections = Intersections(options["intersections"].as<int>());
    return success(val(KeptRecutter(readGrid(grid, MeshView({}, {})), cutOptions)));
  });
}

class KeptBrickCutter {
 public:
  explicit KeptBrickCutter(BrickCutter cutter) : cutter_(std::move(cutter)) {}

  val count() const { return success(val(double(cutter_.count()))); }

  val first(uint32_t brick) const {
    return guarded([&] { return success(toTriple(cutter_.first(brick))); });
  }

  val cut(uint32_t brick, const val& options) const {
    return guarded([&] {
      CutPiece piece = cutter_.cut(brick, runOptions(options));
      const val value = object({{"first", toTriple(piece.first)},
                                {"cutMesh", toObject(piece.cutMesh)},
                                {"mesh", toObject(piece.mesh)},
                                {"triangles", toArray(piece.triangles)},
                                {"triVertices", toArray(piece.triVertices)}});
      if (!options["keep"].as<bool>()) return success(object({{"value", value}}));
      return success(object({{"value", value}, {"twin", val(KeptCutMesh(std::move(piece.cutMesh)))}}));
    });
  }

 private:
  BrickCutter cutter_;
};

val brickCutterOf(const val& mesh, const val& grid, const val& options) {
  return guarded([&] {
    PrepareOptions prepareOptions;
    prepareOptions.progress = progressBetween(options, 0, 1);
    prepareOptions.intersections = Intersections(options["intersections"].as<int>());
    const Mesh input = fromObject<Mesh>(mesh);
    const PrepareResult prepared = prepare(input, prepareOptions);
    if (!prepared) return failure(prepared.error, lastStage(prepared.stats));
    ForEachBrickOptions brickOptions;
    brickOptions.progress = progressBetween(options, prepared.stats.stages.size(), 0);
    brickOptions.cells = int64_t(options["cells"].as<double>());
    brickOptions.untouched = options["untouched"].as<bool>();
    return success(val(KeptBrickCutter(BrickCutter(prepared.mesh, readGrid(grid, input), brickOptions))));
  });
}

/// A rule whose function gives null ends the call.
RefinementRule readRule(const val& rule) {
  if (rule.isUndefined()) return {};
  const auto divides = [callback = rule["divides"]](const std::array<double, 3>& min, const std::array<double, 3>& max, int depth) {
    const val answer = callback(min[0], min[1], min[2], max[0], max[1], max[2], depth);
    if (answer.isNull()) throw CallError({Status::cancelled, -1, -1, "The rule threw."});
    return answer.isTrue();
  };
  return {divides, rule["levels"].as<int>()};
}

val refinedOf(const val& mesh, const KeptCutMesh& kept, const val& options) {
  return guarded([&, cutMesh = kept.get()] {
    RefineOptions refineOptions;
    refineOptions.progress = progressOf(options);
    refineOptions.levels = options["levels"].as<int>();
    refineOptions.angle = options["angle"].as<double>();
    refineOptions.rule = readRule(options["rule"]);
    refineOptions.layers = options["layers"].as<int>();
    refineOptions.coarsening = readCoarsening(options["coarsening"]);
    for (const val& box : emscripten::vecFromJSArray<val>(options["boxes"]))
      refineOptions.boxes.push_back({readTriple<double>(box["min"]), readTriple<double>(box["max"]), box["levels"].as<int>()});
    const Mesh input = fromObject<Mesh>(mesh);
    const PrepareResult prepared = prepare(input, {runOptions(options), Intersections(options["intersections"].as<int>())});
    if (!prepared) throw CallError(prepared.error);
    return success(object({{"value", toObject(refineCells(prepared.mesh, *cutMesh, refineOptions))}}));
  });
}

std::string version() { return MANDOLINE_VERSION; }

}  // namespace

EMSCRIPTEN_BINDINGS(bricks) {
  emscripten::class_<KeptCutMesh>("KeptCutMesh").function("bytes", &KeptCutMesh::bytes);
  emscripten::class_<KeptRecutter>("KeptRecutter").function("cut", &KeptRecutter::cut).function("counts", &KeptRecutter::counts);
  emscripten::class_<KeptBrickCutter>("KeptBrickCutter")
      .function("count", &KeptBrickCutter::count)
      .function("first", &KeptBrickCutter::first)
      .function("cut", &KeptBrickCutter::cut);
  emscripten::function("version", &version);
  emscripten::function("keepCutMesh", &keepCutMesh);
  emscripten::function("dataOf", &dataOf);
  emscripten::function("refineCells", &refinedOf);
  emscripten::function("createRecutter", &recutterOf);
  emscripten::function("createBrickCutter", &brickCutterOf);
}

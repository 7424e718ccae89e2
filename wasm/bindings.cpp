// The calls for JavaScript: src/api.js checks the arguments and turns errors into exceptions; here arrays are copied in and out, and
// nothing is decided.
//
// Every call gives { value } or { error: { code, message, stage, element, element2 } }, since exceptions of C++ would arrive empty.
#include <emscripten/bind.h>

#include "cut_meshes.h"
#include "mandoline/drawing.h"
#include "mandoline/inspect.h"
#include "mandoline/locate.h"
#include "mandoline/measure.h"
#include "mandoline/mesh_files.h"
#include "mandoline/orient.h"
#include "mandoline/resolve.h"
#include "mandoline/slice.h"
#include "mandoline/triangulate.h"

namespace {

using namespace mandoline;
using namespace mandoline::wasm;

/// What f(prepared mesh) gives.
template <class F>
val withPrepared(const val& mesh, const val& options, const F& f) {
  return guarded([&] {
    PrepareOptions prepareOptions;
    prepareOptions.progress = progressOf(options);
    prepareOptions.intersections = Intersections(options["intersections"].as<int>());
    prepareOptions.orient = options["orient"].isTrue();
    const Mesh input = fromObject<Mesh>(mesh);
    const PrepareResult result = prepare(input, prepareOptions);
    return result ? success(f(result.mesh)) : failure(result.error, lastStage(result.stats));
  });
}

val prepareMesh(const val& mesh, const val& options) {
  return withPrepared(mesh, options, [](const PreparedMesh& prepared) {
    return object({{"value", arraysOf(prepared.mesh())}, {"twin", val(KeptMesh(prepared))}});
  });
}

/// Of a mesh that was prepared before: it is oriented if it was to be.
val keepMesh(const val& mesh, const val& options) {
  return withPrepared(mesh, options, [](const PreparedMesh& prepared) { return val(KeptMesh(prepared)); });
}

/// `mesh` is null where options.prepared is the handle of one.
val cutMesh(const val& mesh, const val& grid, const val& options) {
  return guarded([&] {
    CutOptions cutOptions;
    cutOptions.progress = progressOf(options);
    cutOptions.snapTolerance = options["snapTolerance"].as<double>();
    cutOptions.intersections = Intersections(options["intersections"].as<int>());
    CutResult result;
    if (mesh.isNull()) {
      const PreparedMesh prepared = options["prepared"].as<KeptMesh>().get();
      result = cut(prepared, readGrid(grid, prepared.mesh()), cutOptions);
    } else {
      const Mesh input = fromObject<Mesh>(mesh);
      result = cut(input, readGrid(grid, input), cutOptions);
    }
    return outcomeOf(result, options);
  });
}

val intersectionsOf(const val& mesh, const val& options) {
  return guarded([&] {
    IntersectionOptions findOptions;
    findOptions.progress = progressOf(options);
    findOptions.maxPairs = options["maxPairs"].as<uint32_t>();
    const Mesh input = fromObject<Mesh>(mesh);
    return success(toObject(findIntersections(input, findOptions)));
  });
}

val inspectMesh(const val& mesh) {
  return guarded([&] {
    const Mesh input = fromObject<Mesh>(mesh);
    return success(toObject(inspect(input)));
  });
}

val orientMesh(const val& mesh, const val& options) {
  return guarded([&] {
    const Mesh input = fromObject<Mesh>(mesh);
    return success(toObject(orient(input, runOptions(options))));
  });
}

val resolveMesh(const val& mesh, const val& options) {
  return guarded([&] {
    const Mesh input = fromObject<Mesh>(mesh);
    const ResolveResult result = resolve(input, runOptions(options));
    if (!result) return failure(result.error, lastStage(result.stats));
    val value = toObject(result.mesh);
    value.set("remaining", toObject(result.remaining));
    value.set("stats", toObject(result.stats));
    return success(value);
  });
}

val boundaryOfResolved(const val& resolved, int rule) {
  return guarded([&] { return success(toObject(boundary(fromObject<ResolvedMesh>(resolved), WindingRule(rule)))); });
}

val boundaryOf(const KeptCutMesh& kept, int rule) {
  return guarded([&, cutMesh = kept.get()] { return success(toObject(boundary(*cutMesh, WindingRule(rule)))); });
}

val boundaryOfRegions(const KeptCutMesh& kept, const val& isInside) {
  return guarded([&, cutMesh = kept.get()] {
    std::vector<uint8_t> flags;
    readArray(isInside, flags);
    return success(toObject(boundary(*cutMesh, flags)));
  });
}

val insideOf(const KeptCutMesh& kept, const val& options) {
  return guarded([&, cutMesh = kept.get()] {
    const InsideOptions insideOptions{WindingRule(options["rule"].as<int>()), options["threshold"].as<double>()};
    return success(toObject(insideRegions(*cutMesh, insideOptions)));
  });
}

val estimated(const val& mesh, const KeptCutMesh& kept, const val& options) {
  return guarded([&, cutMesh = kept.get()] {
    const Mesh input = fromObject<Mesh>(mesh);
    CutMesh result = estimateInside(input, *cutMesh, {runOptions(options), options["threshold"].as<double>()});
    const val value = toObject(result);
    return success(object({{"value", value}, {"twin", val(KeptCutMesh(std::move(result)))}}));
  });
}

val windingNumbersAt(const val& mesh, const val& points, const val& options) {
  return guarded([&] {
    const Mesh input = fromObject<Mesh>(mesh);
    std::vector<double> coordinates;
    readArray(points, coordinates);
    return success(toArray(generalizedWindingNumbers(input, coordinates, runOptions(options))));
  });
}

val measureCutMesh(const val& mesh, const KeptCutMesh& kept, const val& options) {
  return guarded([&, cutMesh = kept.get()] {
    const Mesh input = fromObject<Mesh>(mesh);
    const Measures measures = measure(input, *cutMesh, runOptions(options));
    val value = toObject(measures);
    value.set("regionVolume", toArray(regionVolumes(*cutMesh, measures)));
    return success(value);
  });
}

val edgesOf(const val& mesh, const KeptCutMesh& kept) {
  return guarded([&, cutMesh = kept.get()] {
    const Mesh input = fromObject<Mesh>(mesh);
    return success(toObject(cutEdges(input, *cutMesh)));
  });
}

val adjacencyOf(const KeptCutMesh& kept) {
  return guarded([&, cutMesh = kept.get()] { return success(toObject(adjacency(*cutMesh))); });
}

val triangulateAll(const KeptCutMesh& kept) {
  return guarded([&, cutMesh = kept.get()] { return success(toObject(triangulateFaces(*cutMesh))); });
}

val triangulateOne(const KeptCutMesh& kept, uint32_t cell) {
  return guarded([&, cutMesh = kept.get()] { return success(toArray(triangulateCell(*cutMesh, cell))); });
}

val triangulateRegionOf(const KeptCutMesh& kept, uint32_t region) {
  return guarded([&, cutMesh = kept.get()] { return success(toArray(triangulateRegion(*cutMesh, region))); });
}

val drawingOf(const val& mesh, const KeptCutMesh& kept, const val& options) {
  return guarded([&, cutMesh = kept.get()] {
    const Mesh input = fromObject<Mesh>(mesh);
    return success(toObject(cellDrawing(input, *cutMesh, readTriple<double>(options["origin"])), options["copy"]));
  });
}

val cellsAtPoints(const KeptCutMesh& kept, const val& points) {
  return guarded([&, cutMesh = kept.get()] {
    std::vector<double> coordinates;
    readArray(points, coordinates);
    return success(toObject(cellsAt(*cutMesh, coordinates)));
  });
}

val sliceCutMesh(const KeptCutMesh& kept, const val& plane, bool untouched) {
  return guarded([&, cutMesh = kept.get()] {
    const Plane cutPlane = {readTriple<double>(plane["normal"]), plane["offset"].as<double>()};
    return success(toObject(slice(*cutMesh, cutPlane, {untouched})));
  });
}

/// The results of f(cutMesh, normal, offsets), one for each plane.
template <class F>
val ofPlanes(const KeptCutMesh& kept, const val& normal, const val& offsets, const F& f) {
  return guarded([&, cutMesh = kept.get()] {
    std::vector<double> distances;
    readArray(offsets, distances);
    val result = val::array();
    for (const auto& plane : f(*cutMesh, readTriple<double>(normal), distances)) result.call<void>("push", toObject(plane));
    return success(result);
  });
}

val sliceByPlanes(const KeptCutMesh& kept, const val& normal, const val& offsets, bool untouched) {
  return ofPlanes(kept, normal, offsets, [&](const auto&... of) { return slices(of..., {untouched}); });
}

val outlinesOf(const KeptCutMesh& kept, const val& normal, const val& offsets) {
  return ofPlanes(kept, normal, offsets, [&](const auto&... of) { return outlines(of...); });
}

/// Null for what the module of files reads or refuses.
val readMeshFile(const val& bytes, const std::string& name) {
  return guarded([&] {
    std::vector<char> content;
    readArray(bytes, content);
    const std::optional<Mesh> mesh = readObjOrStl(content, name);
    return success(mesh ? toObject(*mesh) : val::null());
  });
}

std::string version() { return MANDOLINE_VERSION; }

}  // namespace

EMSCRIPTEN_BINDINGS(mandoline) {
  emscripten::class_<KeptCutMesh>("KeptCutMesh").function("bytes", &KeptCutMesh::bytes);
  emscripten::class_<KeptMesh>("KeptMesh").function("bytes", &KeptMesh::bytes);
  emscripten::function("version", &version);
  emscripten::function("prepare", &prepareMesh);
  emscripten::function("keepMesh", &keepMesh);
  emscripten::function("cut", &cutMesh);
  emscripten::function("findIntersections", &intersectionsOf);
  emscripten::function("inspect", &inspectMesh);
  emscripten::function("orient", &orientMesh);
  emscripten::function("resolve", &resolveMesh);
  emscripten::function("boundaryOfResolved", &boundaryOfResolved);
  emscripten::function("boundary", &boundaryOf);
  emscripten::function("boundaryOfRegions", &boundaryOfRegions);
  emscripten::function("insideRegions", &insideOf);
  emscripten::function("estimateInside", &estimated);
  emscripten::function("generalizedWindingNumbers", &windingNumbersAt);
  emscripten::function("keepCutMesh", &keepCutMesh);
  emscripten::function("dataOf", &dataOf);
  emscripten::function("measure", &measureCutMesh);
  emscripten::function("cutEdges", &edgesOf);
  emscripten::function("adjacency", &adjacencyOf);
  emscripten::function("triangulate", &triangulateAll);
  emscripten::function("triangulateCell", &triangulateOne);
  emscripten::function("triangulateRegion", &triangulateRegionOf);
  emscripten::function("cellDrawing", &drawingOf);
  emscripten::function("cellsAt", &cellsAtPoints);
  emscripten::function("slice", &sliceCutMesh);
  emscripten::function("slices", &sliceByPlanes);
  emscripten::function("outlines", &outlinesOf);
  emscripten::function("readMesh", &readMeshFile);
}

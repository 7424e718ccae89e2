// The core for JavaScript. src/index.js checks the arguments and turns errors into exceptions; here arrays are copied in and out.
//
// Every function gives { value } or { error: { code, message, stage, element, element2 } }, since what C++ throws would arrive opaque.
#include <emscripten/bind.h>
#include <emscripten/val.h>

#include <new>
#include <optional>
#include <stdexcept>

#include "mandoline/io.h"
#include "mandoline/locate.h"
#include "mandoline/measure.h"
#include "mandoline/slice.h"
#include "mandoline/triangulate.h"
#include "mandoline/validate.h"

namespace {

using emscripten::val;
using namespace mandoline;

// Arrays, each copied once.

/// A typed array that owns its memory.
template <class Number>
val toArray(const std::vector<Number>& items) {
  return val(emscripten::typed_memory_view(items.size(), items.data())).template call<val>("slice");
}

template <class Number>
void read(const val& array, std::vector<Number>& items) {
  items.resize(array["length"].as<size_t>());
  val(emscripten::typed_memory_view(items.size(), items.data())).call<void>("set", array);
}

template <class Number>
std::array<Number, 3> readTriple(const val& triple) {
  std::array<Number, 3> result;
  for (int d = 0; d < 3; ++d) result[d] = Number(triple[d].as<double>());
  return result;
}

template <class Number>
val toTriple(const std::array<Number, 3>& triple) {
  val result = val::array();
  for (int d = 0; d < 3; ++d) result.set(d, double(triple[d]));
  return result;
}

// Results and errors.

val failure(const char* code, const std::string& message, const val& stage = val::undefined(), int64_t element = -1,
            int64_t element2 = -1) {
  val error = val::object();
  error.set("code", std::string(code));
  error.set("message", message);
  error.set("stage", stage);
  error.set("element", double(element));
  error.set("element2", double(element2));
  val result = val::object();
  result.set("error", error);
  return result;
}

val failure(const Error& error, const val& stage = val::undefined()) {
  return failure(name(error.status), error.message, stage, error.element, error.element2);
}

val success(const val& value) {
  val result = val::object();
  result.set("value", value);
  return result;
}

struct BadArgument : std::runtime_error {
  using std::runtime_error::runtime_error;
};

/// What f() gives, or the error for what it throws.
template <class F>
val guarded(const F& f) {
  try {
    return f();
  } catch (const std::bad_alloc&) {
  } catch (const std::length_error&) {
  } catch (const FileError& error) {
    return failure("badFile", error.what() + std::string("."));
  } catch (const BadArgument& exception) {
    return failure("badArgument", exception.what());
  } catch (const CallError& exception) {
    return failure(exception.error);
  } catch (const std::exception& exception) {
    return failure(name(Status::internalError), exception.what());
  }
  return failure(name(Status::outOfMemory), "There is not enough memory for this call.");
}

// Meshes and grids.

Mesh readMeshArrays(const val& mesh) {
  Mesh result;
  read(mesh["positions"], result.positions);
  read(mesh["triangles"], result.triangles);
  return result;
}

Grid readPlanes(const val& grid) {
  std::array<std::vector<double>, 3> planes;
  for (int d = 0; d < 3; ++d) read(grid["planes"][d], planes[d]);
  Grid result = Grid::rectilinear(std::move(planes));
  if (!grid["spacing"].isNull()) {
    result.uniform = true;
    result.origin = readTriple<double>(grid["origin"]);
    result.spacing = readTriple<double>(grid["spacing"]);
  }
  return result;
}

Grid readGrid(const val& grid, const Mesh& mesh) {
  const std::string kind = grid["kind"].as<std::string>();
  if (kind == "planes") return readPlanes(grid);
  if (kind == "around") return Grid::around(mesh, int64_t(grid["cells"].as<double>()));
  const auto cells = readTriple<int64_t>(grid["cells"]);
  if (kind == "box") return Grid::box(readTriple<double>(grid["min"]), readTriple<double>(grid["max"]), cells);
  return Grid::regular(readTriple<double>(grid["origin"]), readTriple<double>(grid["spacing"]), cells);
}

val toObject(const Grid& grid) {
  val result = val::object(), planes = val::array();
  for (int d = 0; d < 3; ++d) planes.set(d, toArray(grid.planes[d]));
  result.set("origin", toTriple(grid.origin));
  result.set("spacing", grid.uniform ? toTriple(grid.spacing) : val::null());
  result.set("cells", toTriple(std::array<int64_t, 3>{grid.cells(0), grid.cells(1), grid.cells(2)}));
  result.set("planes", planes);
  return result;
}

// Cut-meshes: the arrays have the same names on both sides.

template <class Mesh, class F>
void forEachArray(Mesh& mesh, const F& f) {
  f("positions", mesh.positions);
  f("vertexCell", mesh.vertexCell);
  f("vertexMask", mesh.vertexMask);
  f("vertexTriVertex", mesh.vertexTriVertex);
  f("vertexParents", mesh.vertexParents);
  f("loopOffsets", mesh.loopOffsets);
  f("loopVertices", mesh.loopVertices);
  f("faceLoopOffsets", mesh.faceLoopOffsets);
  f("faceTriangle", mesh.faceTriangle);
  f("faceAxis", mesh.faceAxis);
  f("facePlane", mesh.facePlane);
  f("cellHalfFaceOffsets", mesh.cellHalfFaceOffsets);
  f("cellHalfFaces", mesh.cellHalfFaces);
  f("cellGridCell", mesh.cellGridCell);
  f("cellRegion", mesh.cellRegion);
  f("rowRunOffsets", mesh.rowRunOffsets);
  f("runBegin", mesh.runBegin);
  f("runEnd", mesh.runEnd);
  f("runRegion", mesh.runRegion);
  f("droppedTriangles", mesh.droppedTriangles);
}

CutMesh readUnchecked(const val& object) {
  CutMesh result;
  result.grid = readPlanes(object["grid"]);
  forEachArray(result, [&](const char* key, auto& array) { read(object[key], array); });
  result.regionCount = object["regionCount"].as<uint32_t>();
  result.hasWinding = !object["regionWinding"].isNull();
  if (result.hasWinding) read(object["regionWinding"], result.regionWinding);
  result.triangleCount = object["triangleCount"].as<uint32_t>();
  return result;
}

/// A cut-mesh that no function can stumble over.
CutMesh readCutMesh(const val& object, const Mesh* mesh = nullptr) {
  CutMesh result = readUnchecked(object);
  const std::optional<MeshView> view = mesh ? std::optional<MeshView>(*mesh) : std::nullopt;
  const Check check = checkArrays(result, view ? &*view : nullptr);
  if (!check.pass) throw BadArgument("The arrays of cutMesh don't fit together. " + check.message);
  return result;
}

val toObject(const CutStats& stats) {
  val result = val::object(), stages = val::array();
  for (size_t i = 0; i < stats.stages.size(); ++i) {
    val stage = val::object();
    stage.set("stage", std::string(stats.stages[i].stage));
    stage.set("ms", stats.stages[i].ms);
    stages.set(i, stage);
  }
  result.set("stages", stages);
  result.set("totalMs", stats.totalMs);
  result.set("exactFallbacks", double(stats.exactFallbacks));
  result.set("weldedVertices", stats.weldedVertices);
  result.set("zeroAreaTriangles", stats.zeroAreaTriangles);
  result.set("duplicateTriangles", stats.duplicateTriangles);
  result.set("outsideTriangles", stats.outsideTriangles);
  result.set("snappedVertices", stats.snappedVertices);
  result.set("largestSnap", stats.largestSnap);
  result.set("flushedCoordinates", stats.flushedCoordinates);
  return result;
}

val toObject(const CutMesh& mesh, const CutStats& stats, bool dense) {
  val result = val::object();
  result.set("grid", toObject(mesh.grid));
  forEachArray(mesh, [&](const char* key, const auto& array) { result.set(key, toArray(array)); });
  if (dense) result.set("gridCellRegion", toArray(mesh.gridCellRegion()));
  result.set("regionCount", mesh.regionCount);
  result.set("regionWinding", mesh.hasWinding ? toArray(mesh.regionWinding) : val::null());
  result.set("triangleCount", mesh.triangleCount);
  result.set("stats", toObject(stats));
  return result;
}

// The calls.

bool report(const val& callback, const Progress& progress) {
  val object = val::object();
  object.set("stage", std::string(progress.stage));
  object.set("stageIndex", progress.stageIndex);
  object.set("stageCount", progress.stageCount);
  object.set("done", double(progress.done));
  object.set("total", double(progress.total));
  return callback(object).as<bool>();
}

val cutWith(const Mesh& mesh, const Grid& grid, const val& options) {
  CutOptions cutOptions;
  cutOptions.snapTolerance = options["snapTolerance"].as<double>();
  const val callback = options["progress"];
  if (!callback.isUndefined()) cutOptions.progress = [&](const Progress& progress) { return report(callback, progress); };
  const CutResult result = cut(mesh, grid, cutOptions);
  if (result) return success(toObject(result.mesh, result.stats, options["gridCellRegion"].as<bool>()));
  const std::string stage = result.stats.stages.empty() ? "input" : result.stats.stages.back().stage;
  return failure(result.error, val(stage));
}

val cutMesh(const val& mesh, const val& grid, const val& options) {
  return guarded([&] {
    const Mesh input = readMeshArrays(mesh);
    return cutWith(input, readGrid(grid, input), options);
  });
}

val toObject(const Validation& validation) {
  val result = val::object(), checks = val::array();
  for (size_t i = 0; i < validation.checks.size(); ++i) {
    const Check& check = validation.checks[i];
    val object = val::object();
    object.set("name", check.name);
    object.set("pass", check.pass);
    object.set("skipped", check.skipped);
    object.set("worst", check.worst);
    object.set("tolerance", check.tolerance);
    object.set("elementKind", check.elementKind);
    object.set("element", double(check.element));
    object.set("message", check.message);
    checks.set(i, object);
  }
  result.set("pass", validation.pass);
  result.set("checks", checks);
  return result;
}

val validateCutMesh(const val& mesh, const val& cutMesh, double snapTolerance) {
  return guarded([&] { return success(toObject(validate(readMeshArrays(mesh), readUnchecked(cutMesh), {{}, snapTolerance}))); });
}

val measureCutMesh(const val& mesh, const val& object) {
  return guarded([&] {
    const Mesh input = readMeshArrays(mesh);
    const CutMesh cutMesh = readCutMesh(object, &input);
    const Measures measures = measure(input, cutMesh);
    val result = val::object();
    result.set("faceArea", toArray(measures.faceArea));
    result.set("faceNormal", toArray(measures.faceNormal));
    result.set("faceCentroid", toArray(measures.faceCentroid));
    result.set("cellVolume", toArray(measures.cellVolume));
    result.set("cellCentroid", toArray(measures.cellCentroid));
    result.set("regionVolume", toArray(regionVolumes(cutMesh, measures)));
    return success(result);
  });
}

val edgesOf(const val& mesh, const val& cutMesh) {
  return guarded([&] {
    const Mesh input = readMeshArrays(mesh);
    const CutEdges edges = cutEdges(input, readCutMesh(cutMesh, &input));
    val result = val::object();
    result.set("edgeVertices", toArray(edges.edgeVertices));
    result.set("edgeLength", toArray(edges.edgeLength));
    return success(result);
  });
}

val adjacencyOf(const val& cutMesh) {
  return guarded([&] {
    const Adjacency found = adjacency(readCutMesh(cutMesh));
    val result = val::object();
    result.set("faceCells", toArray(found.faceCells));
    result.set("faceGridCells", toArray(std::vector<double>(found.faceGridCells.begin(), found.faceGridCells.end())));
    result.set("cellCellOffsets", toArray(found.cellCellOffsets));
    result.set("cellCells", toArray(found.cellCells));
    return success(result);
  });
}

val triangulateAll(const val& cutMesh) {
  return guarded([&] {
    const FaceTriangles faces = triangulateFaces(readCutMesh(cutMesh));
    val result = val::object();
    result.set("faceTriangleOffsets", toArray(faces.faceTriangleOffsets));
    result.set("triangles", toArray(faces.triangles));
    return success(result);
  });
}

val triangulateOne(const val& object, uint32_t cell) {
  return guarded([&] {
    const CutMesh cutMesh = readCutMesh(object);
    return success(toArray(triangulateCell(cutMesh, cell)));
  });
}

val triangulateRegionOf(const val& object, uint32_t region) {
  return guarded([&] {
    const CutMesh cutMesh = readCutMesh(object);
    return success(toArray(triangulateRegion(cutMesh, region)));
  });
}

val locatePoints(const val& cutMesh, const val& points) {
  return guarded([&] {
    std::vector<double> coordinates;
    read(points, coordinates);
    const Locations locations = locate(readCutMesh(cutMesh), coordinates);
    val result = val::object();
    result.set("cell", toArray(locations.cell));
    result.set("gridCell", toArray(locations.gridCell));
    result.set("region", toArray(locations.region));
    return success(result);
  });
}

val toObject(const Slice& slice) {
  val result = val::object();
  result.set("positions", toArray(slice.positions));
  result.set("loopOffsets", toArray(slice.loopOffsets));
  result.set("loopPoints", toArray(slice.loopPoints));
  result.set("polygonLoopOffsets", toArray(slice.polygonLoopOffsets));
  result.set("polygonCell", toArray(slice.polygonCell));
  result.set("polygonGridCell", toArray(slice.polygonGridCell));
  result.set("polygonRegion", toArray(slice.polygonRegion));
  result.set("polygonTriangleOffsets", toArray(slice.polygonTriangleOffsets));
  result.set("triangles", toArray(slice.triangles));
  return result;
}

val sliceCutMesh(const val& cutMesh, const val& plane, bool untouched) {
  return guarded([&] {
    const Plane cutPlane = {readTriple<double>(plane["normal"]), plane["offset"].as<double>()};
    return success(toObject(slice(readCutMesh(cutMesh), cutPlane, {untouched})));
  });
}

val writeFile(const val& mesh, const val& object, const std::string& format) {
  return guarded([&] {
    const Mesh input = readMeshArrays(mesh);
    const CutMesh cutMesh = readCutMesh(object, &input);
    std::vector<uint8_t> bytes;
    const Sink sink = [&](std::string_view piece) { bytes.insert(bytes.end(), piece.begin(), piece.end()); };
    if (format == "json") writeJson(sink, cutMesh);
    if (format == "vtu") writeVtu(sink, input, cutMesh);
    if (format == "obj") writeObj(sink, cutMesh);
    return success(toArray(bytes));
  });
}

val readMeshFile(const val& bytes, const std::string& name) {
  return guarded([&] {
    std::vector<char> content;
    read(bytes, content);
    const Mesh mesh = readMesh(content, name);
    val result = val::object();
    result.set("positions", toArray(mesh.positions));
    result.set("triangles", toArray(mesh.triangles));
    return success(result);
  });
}

std::string version() { return MANDOLINE_VERSION; }

}  // namespace

EMSCRIPTEN_BINDINGS(mandoline) {
  emscripten::function("version", &version);
  emscripten::function("cut", &cutMesh);
  emscripten::function("validate", &validateCutMesh);
  emscripten::function("measure", &measureCutMesh);
  emscripten::function("cutEdges", &edgesOf);
  emscripten::function("adjacency", &adjacencyOf);
  emscripten::function("triangulate", &triangulateAll);
  emscripten::function("triangulateCell", &triangulateOne);
  emscripten::function("triangulateRegion", &triangulateRegionOf);
  emscripten::function("locate", &locatePoints);
  emscripten::function("slice", &sliceCutMesh);
  emscripten::function("write", &writeFile);
  emscripten::function("readMesh", &readMeshFile);
}

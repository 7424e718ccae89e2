// The calls of mandoline-wasm/physics for JavaScript, as in bindings.cpp: src/physics/api.js checks the arguments, and here nothing is
// decided. A module of its own, so that those who only cut don't load it.
#include <emscripten/bind.h>

#include <list>
#include <map>

#include "complexes.h"
#include "writing.h"

namespace {

using namespace mandoline;
using namespace mandoline::wasm;

/// As keepCutMesh(), but also that of refined cells. It has no runs, which the check asks for.
val keepAnyCutMesh(const val& given, bool isChecked) {
  return guarded([&] {
    CutMesh cutMesh = fromObject<CutMesh>(given);
    const bool isRefined = cutMesh.rowRunOffsets.empty() && !cutMesh.loopOffsets.empty();
    if (isRefined) cutMesh.rowRunOffsets.assign(size_t(cutMesh.grid.cells(1) * cutMesh.grid.cells(2)) + 1, 0);
    const Check check = isChecked ? checkArrays(cutMesh) : Check();
    if (isChecked && !check.pass) return failure("badArgument", "The arrays of cutMesh don't fit together: " + check.message);
    if (isRefined) cutMesh.rowRunOffsets = {};
    return success(val(KeptCutMesh(std::move(cutMesh))));
  });
}

val keepComplex(const val& cells) {
  return guarded([&] { return keepChecked<CellComplex>(cells, "cells"); });
}

val coarsenCutMesh(const KeptCutMesh& kept, const val& options) {
  return guarded([&, cutMesh = kept.get()] {
    CoarsenOptions coarsenOptions = readCoarsening(options);
    coarsenOptions.progress = progressOf(options);
    return success(toObject(coarsen(*cutMesh, coarsenOptions)));
  });
}

val keptWithTwin(CellComplex cells) {
  const val value = toObject(cells);
  return success(object({{"value", value}, {"twin", val(KeptComplex(std::move(cells)))}}));
}

/// `octree` is null for the untouched grid cells.
val complexOf(const val& mesh, const KeptCutMesh& kept, const val& octree, const val& options) {
  return guarded([&, cutMesh = kept.get()] {
    const Mesh input = fromObject<Mesh>(mesh);
    CoarsenOptions none;
    none.maxLevel = 0;
    CellComplex cells =
        cellComplex(input, *cutMesh, octree.isNull() ? coarsen(*cutMesh, none) : fromObject<OctreeCells>(octree), runOptions(options));
    return keptWithTwin(std::move(cells));
  });
}

/// Of a struct whose member `cells` is a cell complex.
template <class Result>
val withTwin(Result result) {
  const val value = toObject(result);
  return success(object({{"value", value}, {"twin", val(KeptComplex(std::move(result.cells)))}}));
}

val mergedOf(const KeptCutMesh& keptCutMesh, const KeptComplex& keptCells, const val& options) {
  return guarded([&, cutMesh = keptCutMesh.get(), cells = keptCells.get()] {
    MergeOptions mergeOptions;
    mergeOptions.progress = progressOf(options);
    mergeOptions.fraction = options["fraction"].as<double>();
    return withTwin(mergeSmallCells(*cutMesh, *cells, mergeOptions));
  });
}

val unitedOf(const KeptCutMesh& keptCutMesh, const KeptComplex& keptCells, const val& options) {
  return guarded([&, cutMesh = keptCutMesh.get(), cells = keptCells.get()] {
    TriangleGroups groups;
    if (!options["groups"].isUndefined()) groups = fromObject<TriangleGroups>(options["groups"]);
    WallOptions wallOptions;
    wallOptions.progress = progressOf(options);
    wallOptions.angle = options["angle"].as<double>();
    wallOptions.triangleGroup = groups.triangleGroup;
    return keptWithTwin(uniteWalls(*cutMesh, *cells, wallOptions));
  });
}

val partOf(const KeptComplex& kept, const val& cellIds) {
  return guarded([&, cells = kept.get()] {
    std::vector<uint32_t> ids;
    readArray(cellIds, ids);
    return withTwin(subComplex(*cells, ids));
  });
}

val regionOf(const KeptComplex& kept, uint32_t region) {
  return guarded([&, cells = kept.get()] { return withTwin(regionComplex(*cells, region)); });
}

val edgesOf(const KeptComplex& kept) {
  return guarded([&, cells = kept.get()] { return success(toObject(complexEdges(*cells))); });
}

/// One of the operators, by the name of its function.
SparseMatrix operatorOf(const CellComplex& cells, const std::string& name, DualPoints dualPoints) {
  if (name == "cellFaceIncidence") return cellFaceIncidence(cells);
  if (name == "faceEdgeIncidence") return faceEdgeIncidence(cells, complexEdges(cells));
  if (name == "edgeVertexIncidence") return edgeVertexIncidence(cells, complexEdges(cells));
  if (name == "gradient") return gradient(cells, dualPoints);
  if (name == "divergence") return divergence(cells);
  if (name == "laplacian") return laplacian(cells, dualPoints);
  if (name == "cellMass") return cellMass(cells);
  if (name == "faceStar") return faceStar(cells, dualPoints);
  return faceMass(cells, dualPoints);
}

val operatorsOf(const KeptComplex& kept, const val& names, int dualPoints) {
  return guarded([&, cells = kept.get()] {
    val result = val::object();
    for (const std::string& name : emscripten::vecFromJSArray<std::string>(names))
      result.set(name, toObject(operatorOf(*cells, name, DualPoints(dualPoints))));
    return success(result);
  });
}

/// `conditions`: [tag, condition, value, coefficient] for each tag that is set.
val boundaryOfCells(const KeptComplex& kept, const val& conditions) {
  return guarded([&, cells = kept.get()] {
    Boundary boundary = boundaryOf(*cells);
    for (const val& set : emscripten::vecFromJSArray<val>(conditions)) {
      const auto tag = FaceTag(set[0].as<int>());
      const auto condition = Condition(set[1].as<int>());
      const double value = set[2].as<double>();
      if (condition == Condition::robin)
        setRobin(boundary, *cells, tag, set[3].as<double>(), value);
      else
        setBoundary(boundary, *cells, tag, condition, value);
    }
    return success(toObject(boundary));
  });
}

val normalsOf(const KeptComplex& kept, const val& boundary) {
  return guarded([&, cells = kept.get()] { return success(toArray(outwardNormals(fromObject<Boundary>(boundary), *cells))); });
}

val componentsOf(const KeptComplex& kept) {
  return guarded([&, cells = kept.get()] { return success(toObject(cellComponents(*cells))); });
}

val systemOf(const KeptComplex& kept, const val& problem) {
  return guarded([&, cells = kept.get()] { return success(toObject(poissonSystem(*cells, readProblem(problem, *cells)))); });
}

val solve(const KeptComplex& kept, const val& problem, const val& options) {
  return guarded(
      [&, cells = kept.get()] { return success(toObject(solvePoisson(*cells, readProblem(problem, *cells), readSolveOptions(options)))); });
}

val flowThrough(const KeptComplex& kept, const val& wind, const val& options) {
  return guarded([&, cells = kept.get()] {
    FlowOptions flowOptions;
    flowOptions.progress = progressOf(options);
    flowOptions.tolerance = options["tolerance"].as<double>();
    flowOptions.maxIterations = options["maxIterations"].as<int>();
    flowOptions.corrections = options["corrections"].as<int>();
    flowOptions.farField = options["farField"].as<bool>();
    return success(toObject(solveFlow(*cells, readTriple<double>(wind), flowOptions)));
  });
}

/// The result of call(field, points). `given`: { mesh, flow, points }.
template <class Call>
val onField(const KeptCutMesh& keptCutMesh, const KeptComplex& keptCells, const val& given, const Call& call) {
  return guarded([&, cutMesh = keptCutMesh.get(), cells = keptCells.get()] {
    const Mesh mesh = fromObject<Mesh>(given["mesh"]);
    const Flow flow = fromObject<Flow>(given["flow"]);
    std::vector<double> points;
    readArray(given["points"], points);
    return success(call(FlowField{mesh, *cutMesh, *cells, flow}, points));
  });
}

val velocitiesAt(const KeptCutMesh& cutMesh, const KeptComplex& cells, const val& given) {
  return onField(cutMesh, cells, given,
                 [](const FlowField& field, const std::vector<double>& points) { return toArray(velocityAt(field, points)); });
}

val streamlinesFrom(const KeptCutMesh& cutMesh, const KeptComplex& cells, const val& given, const val& options) {
  return onField(cutMesh, cells, given, [&](const FlowField& field, const std::vector<double>& seeds) {
    StreamlineOptions streamlineOptions;
    streamlineOptions.progress = progressOf(options);
    streamlineOptions.upstream = options["upstream"].as<bool>();
    streamlineOptions.tolerance = options["tolerance"].as<double>();
    streamlineOptions.maxLength = options["maxLength"].as<double>();
    streamlineOptions.maxPoints = options["maxPoints"].as<uint32_t>();
    return toObject(streamlines(field, seeds, streamlineOptions));
  });
}

/// The grid is not one around a mesh.
val seedsOf(const val& grid, const val& wind, uint32_t count) {
  return guarded([&] {
    const Mesh none;
    return success(toArray(inflowSeeds(readGrid(grid, none), readTriple<double>(wind), count)));
  });
}

/// Numbers for cells or faces, and the fields that point to them.
struct WrittenFields {
  explicit WrittenFields(const val& given) {
    for (const val& field : emscripten::vecFromJSArray<val>(given)) {
      readArray(field[1], numbers.emplace_back());
      fields.push_back({field[0].as<std::string>(), numbers.back()});
    }
  }
  WrittenFields(const WrittenFields&) = delete;

  std::list<std::vector<double>> numbers;
  std::vector<Field> fields;
};

val writeCellFile(const KeptCutMesh& keptCutMesh, const KeptComplex& keptCells, int format, const val& options) {
  return guarded([&, cutMesh = keptCutMesh.get(), cells = keptCells.get()] {
    const Writing writing(options);
    const WrittenFields written(options["fields"]);
    return bytesOfFile([&](const Sink& sink) {
      if (FileFormat(format) == FileFormat::json) return writeJson(sink, *cutMesh, *cells, writing.given);
      writeVtu(sink, *cutMesh, *cells, written.fields, writing.given);
    });
  });
}

val writeFaceFile(const KeptCutMesh& keptCutMesh, const KeptComplex& keptCells, const val& options) {
  return guarded([&, cutMesh = keptCutMesh.get(), cells = keptCells.get()] {
    const Writing writing(options);
    const WrittenFields written(options["fields"]);
    return bytesOfFile([&](const Sink& sink) { writeFacesVtu(sink, *cutMesh, *cells, written.fields, writing.given); });
  });
}

val writePolyMeshFiles(const KeptCutMesh& keptCutMesh, const KeptComplex& keptCells, const val& options) {
  return guarded([&, cutMesh = keptCutMesh.get(), cells = keptCells.get()] {
    const Writing writing(options);
    std::map<std::string, FileBytes> files;
    writePolyMesh([&](const std::string& file, std::string_view piece) { files[file].add(piece); }, *cutMesh, *cells, writing.given);
    val result = val::object();
    for (const auto& [name, bytes] : files) result.set(name, bytes.joined());
    return success(result);
  });
}

std::string version() { return MANDOLINE_VERSION; }

}  // namespace

EMSCRIPTEN_BINDINGS(physics) {
  emscripten::class_<KeptCutMesh>("KeptCutMesh").function("bytes", &KeptCutMesh::bytes);
  emscripten::class_<KeptComplex>("KeptComplex").function("bytes", &KeptComplex::bytes);
  emscripten::function("version", &version);
  emscripten::function("keepCutMesh", &keepAnyCutMesh);
  emscripten::function("dataOf", &dataOf);
  emscripten::function("keepComplex", &keepComplex);
  emscripten::function("coarsen", &coarsenCutMesh);
  emscripten::function("cellComplex", &complexOf);
  emscripten::function("mergeSmallCells", &mergedOf);
  emscripten::function("uniteWalls", &unitedOf);
  emscripten::function("subComplex", &partOf);
  emscripten::function("regionComplex", &regionOf);
  emscripten::function("complexEdges", &edgesOf);
  emscripten::function("operators", &operatorsOf);
  emscripten::function("boundaryOf", &boundaryOfCells);
  emscripten::function("outwardNormals", &normalsOf);
  emscripten::function("cellComponents", &componentsOf);
  emscripten::function("poissonSystem", &systemOf);
  emscripten::function("solvePoisson", &solve);
  emscripten::function("solveFlow", &flowThrough);
  emscripten::function("velocityAt", &velocitiesAt);
  emscripten::function("streamlines", &streamlinesFrom);
  emscripten::function("inflowSeeds", &seedsOf);
  emscripten::function("writeCells", &writeCellFile);
  emscripten::function("writeFaces", &writeFaceFile);
  emscripten::function("writePolyMesh", &writePolyMeshFiles);
}

// The calls that files/calls.js has: validation, and files written and read. As in bindings.cpp nothing is decided here. A module of its
// own, which is loaded when the first of them is made.
#include <emscripten/bind.h>

#include "cut_meshes.h"
#include "mandoline/inspect.h"
#include "writing.h"

namespace {

using namespace mandoline;
using namespace mandoline::wasm;

val validateCutMesh(const val& mesh, const KeptCutMesh& kept, const val& options) {
  return guarded([&, cutMesh = kept.get()] {
    const Mesh input = fromObject<Mesh>(mesh);
    return success(toObject(validate(input, *cutMesh, runOptions(options))));
  });
}

val writeCutMeshFile(const val& mesh, const KeptCutMesh& kept, int format, const val& options) {
  return guarded([&, cutMesh = kept.get()] {
    const Writing writing(options);
    const Mesh input = fromObject<Mesh>(mesh);
    return bytesOfFile([&](const Sink& sink) { writeCutMesh(sink, FileFormat(format), input, *cutMesh, writing.given); });
  });
}

val writeMeshFile(const val& mesh, int format, const val& options) {
  return guarded([&] {
    const Writing writing(options);
    const Mesh input = fromObject<Mesh>(mesh);
    return bytesOfFile([&](const Sink& sink) { writeMesh(sink, FileFormat(format), input, writing.given, writing.given.groups); });
  });
}

val writeOutlineFile(const val& stack, int format, const val& options) {
  return guarded([&] {
    const Writing writing(options);
    OutlineStack outlines;
    outlines.normal = readTriple<double>(stack["normal"]);
    readArray(stack["offsets"], outlines.offsets);
    for (const val& layer : emscripten::vecFromJSArray<val>(stack["layers"])) outlines.layers.push_back(fromObject<Outlines>(layer));
    return bytesOfFile([&](const Sink& sink) { writeOutlines(sink, FileFormat(format), outlines, writing.given); });
  });
}

val writeDefectFile(const val& mesh, const val& info, const val& options) {
  return guarded([&] {
    const Mesh input = fromObject<Mesh>(mesh);
    const MeshInfo found = fromObject<MeshInfo>(info);
    return bytesOfFile([&](const Sink& sink) { writeDefects(sink, input, found, runOptions(options)); });
  });
}

val writeLineFile(const val& lines, const val& options) {
  return guarded([&] {
    std::vector<double> points;
    std::vector<uint32_t> offsets;
    readArray(lines["points"], points);
    readArray(lines["offsets"], offsets);
    return bytesOfFile([&](const Sink& sink) { writeLines(sink, points, offsets, runOptions(options)); });
  });
}

/// What f(content, name) gives; the bytes are unpacked.
template <class Read>
val readFile(const val& bytes, const std::string& name, const Read& read) {
  return guarded([&] {
    std::vector<char> content;
    readArray(bytes, content);
    return success(read(content, name));
  });
}

val readMeshFile(const val& bytes, const std::string& name) {
  return readFile(bytes, name, [](const auto&... file) { return toObject(readMesh(file...)); });
}

val readGroupsFile(const val& bytes, const std::string& name) {
  return readFile(bytes, name, [](const auto&... file) { return toObject(readGroups(file...)); });
}

val readCutMeshFile(const val& bytes, const std::string& name) {
  return readFile(bytes, name, [](const auto&... file) {
    CutMesh cutMesh = readCutMesh(file...);
    const val value = toObject(cutMesh);
    return object({{"value", value}, {"twin", val(KeptCutMesh(std::move(cutMesh)))}});
  });
}

std::string version() { return MANDOLINE_VERSION; }

}  // namespace

EMSCRIPTEN_BINDINGS(files) {
  emscripten::class_<KeptCutMesh>("KeptCutMesh").function("bytes", &KeptCutMesh::bytes);
  emscripten::function("version", &version);
  emscripten::function("keepCutMesh", &keepCutMesh);
  emscripten::function("dataOf", &dataOf);
  emscripten::function("validate", &validateCutMesh);
  emscripten::function("write", &writeCutMeshFile);
  emscripten::function("writeMesh", &writeMeshFile);
  emscripten::function("writeOutlines", &writeOutlineFile);
  emscripten::function("writeDefects", &writeDefectFile);
  emscripten::function("writeLines", &writeLineFile);
  emscripten::function("readMesh", &readMeshFile);
  emscripten::function("readGroups", &readGroupsFile);
  emscripten::function("readCutMesh", &readCutMeshFile);
}

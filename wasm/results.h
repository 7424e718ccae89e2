// What the calls give, as plain data.
#pragma once

#include <functional>

#include "mandoline/intersections.h"
#include "mandoline/locate.h"
#include "mandoline/measure.h"
#include "mandoline/slice.h"
#include "mandoline/triangulate.h"
#include "mandoline/validate.h"
#include "values.h"

namespace mandoline::wasm {

/// The JavaScript callback, if there is one.
std::function<bool(const Progress&)> progressOf(const val& options);
RunOptions runOptions(const val& options);

val toObject(const Mesh& mesh);
val toObject(const PairCounts& counts);
val toObject(const MeshIntersections& intersections);
val toObject(const Progress& progress);
val toObject(const Measures& measures, const std::vector<double>& regionVolume);
val toObject(const CutEdges& edges);
val toObject(const Adjacency& adjacency);
val toObject(const FaceTriangles& faces);
val toObject(const Validation& validation);
val toObject(const Locations& locations);
val toObject(const Slice& slice);
val toObject(const Outlines& outlines);

}  // namespace mandoline::wasm

#include "mesh/prepared.h"

#include <algorithm>
#include <atomic>
#include <cmath>
#include <cstring>
#include <optional>
#include <string>

#include "base/box_tree.h"
#include "base/large_array.h"
#include "base/run_tasks.h"

namespace mandoline::detail {
namespace {

[[noreturn]] void fail(Status status, int64_t element, const std::string& message) { throw Failure{{status, element, -1, message}}; }

void checkArrays(const MeshView& mesh) {
  if (mesh.positions.size() % 3 != 0) fail(Status::badArrays, -1, "The length of positions is not a multiple of 3.");
  if (mesh.triangles.size() % 3 != 0) fail(Status::badArrays, -1, "The length of triangles is not a multiple of 3.");
  if (mesh.triangles.empty()) fail(Status::emptyMesh, -1, "The mesh has no triangles.");
  if (mesh.triangleCount() >= uint64_t(1) << 31 || mesh.vertexCount() >= uint64_t(1) << 31) {
    fail(Status::meshTooLarge, -1, "The mesh has more than 2^31 triangles or vertices.");
  }
}

constexpr size_t kBlock = 1 << 14;  // vertices or triangles that are worth a thread: little is done with each

using Marks = std::vector<std::atomic<uint8_t>>;  // any thread may set any of them

/// Marks referenced tri-vertices.
Marks referencedVertices(const MeshView& mesh, Monitor& monitor) {
  Marks referenced(mesh.vertexCount());
  const auto mark = [&](size_t, size_t begin, size_t end) {
    for (size_t i = 3 * begin; i < 3 * end; ++i) {
      const uint32_t v = mesh.triangles[i];
      if (v >= referenced.size()) {
        fail(Status::badIndex, int64_t(i / 3),
             "Triangle " + std::to_string(i / 3) + " refers to vertex " + std::to_string(v) + ", but there are only " +
                 std::to_string(referenced.size()) + ".");
      }
      referenced[v].store(1, std::memory_order_relaxed);
    }
  };
  runChunks(mesh.triangleCount(), chunkCount(mesh.triangleCount(), monitor, kBlock), monitor, mark, kBlock);
  return referenced;
}

/// Fails if any triangles meet: says which first, and how many pairs do.
void refuseIntersections(const Prepared& prepared, const Contacts& contacts) {
  const uint64_t total = contacts.counts.total();
  if (total == 0) return;
  std::array<uint32_t, 2> first{~0u, ~0u};
  if (!contacts.pairs.empty()) first = contacts.pairs[0].triangles;
  if (!prepared.duplicates.empty()) first = std::min(first, {prepared.duplicates[0].original, prepared.duplicates[0].triangle});
  throw Failure{{Status::selfIntersection, first[0], first[1],
                 "Triangles " + std::to_string(first[0]) + " and " + std::to_string(first[1]) +
                     " meet other than in a shared vertex or edge, " +
                     (total == 1 ? "the only pair that does." : "the first of " + std::to_string(total) + " pairs that do.")}};
}

void findEdges(Prepared& prepared, const Arrangement* arrangement) {
  EdgeUses uses;
  prepared.edges = findMeshEdges(prepared, arrangement, &uses);
  if (!prepared.closed) prepared.parts = findParts(prepared, uses);
}

/// The edges, and the triangles that may meet: neither needs the other, and whoever is done first helps with the charts.
/// `states` are those of the search: the edges change the mesh's. `isWhole`: whether the mesh has parts of its own.
NearTriangles findEdgesAndNear(Prepared& prepared, const std::vector<TriangleState>& states, bool isWhole, Monitor& monitor) {
  std::optional<SortedMesh> sorted;
  ChartFinder charts;
  const std::function<void()> tasks[] = {[&] {
                                           if (isWhole) {
                                             findEdges(prepared, nullptr);
                                           } else {
                                             prepared.edges = findMeshEdges(prepared, nullptr, nullptr);
                                           }
                                           charts.help();
                                         },
                                         [&] {
                                           sorted.emplace(prepared, states);
                                           charts.begin(*sorted);
                                           charts.help();
                                         }};
  runTasks(tasks, monitor);
  return {*std::move(sorted), charts.take(), monitor};
}

/// Checks the coordinates of vertices that triangles have.
template <class IsReferenced>
CheckedMesh checkCoordinates(const MeshView& mesh, double largest, Monitor& monitor, const IsReferenced& isReferenced) {
  CheckedMesh checked{std::vector<uint8_t>(mesh.vertexCount()), 0};
  const auto check = [&](double& largestHere, size_t begin, size_t end) {
    for (size_t v = begin; v < end; ++v) {
      checked.referenced[v] = isReferenced(v);
      for (size_t d = 0; d < 3 && checked.referenced[v]; ++d) {
        const double x = mesh.positions[3 * v + d];
        if (!std::isfinite(x)) {
          fail(Status::nonFiniteCoordinate, int64_t(v), "Vertex " + std::to_string(v) + " has a coordinate that is not finite.");
        }
        largestHere = std::max(largestHere, std::fabs(x));
      }
    }
  };
  for (const double x : forChunks<double>(mesh.vertexCount(), monitor, check, kBlock)) largest = std::max(largest, x);
  if (largest > 0) checked.shift = Scale::kLargestExponent - std::ilogb(largest);
  return checked;
}

/// Without triangles.
std::unique_ptr<Prepared> scaled(const MeshView& mesh, CheckedMesh checked, Monitor& monitor) {
  auto prepared = std::make_unique<Prepared>();
  prepared->shift = checked.shift;
  prepared->referenced = std::move(checked.referenced);
  const std::vector<uint8_t>& referenced = prepared->referenced;
  const Scale scale(prepared->shift);
  prepared->points.resize(referenced.size());
  const auto flushed = forChunks<uint32_t>(
      referenced.size(), monitor,
      [&](uint32_t& count, size_t begin, size_t end) {
        for (size_t v = begin; v < end; ++v) {
          for (size_t d = 0; d < 3 && referenced[v]; ++d) prepared->points[v][d] = scale.scaled(mesh.positions[3 * v + d], count);
        }
      },
      kBlock);
  for (const uint32_t count : flushed) prepared->counts.flushedCoordinates += count;
  prepared->triVertices = uint32_t(prepared->points.size());
  return prepared;
}

/// With triangles, of which vertices at one position are the lowest of these.
void addTriangles(Prepared& prepared, const MeshView& mesh, const std::vector<uint32_t>& lowest, Monitor& monitor) {
  const size_t triangles = mesh.triangleCount();
  for (uint32_t v = 0; v < lowest.size(); ++v) prepared.counts.weldedVertices += lowest[v] != v;
  prepared.triangles.resize(triangles);
  prepared.states.assign(triangles, TriangleState::kept);
  runChunks(
      triangles, chunkCount(triangles, monitor, kBlock), monitor,
      [&](size_t, size_t begin, size_t end) {
        for (size_t t = begin; t < end; ++t) {
          for (size_t i = 0; i < 3; ++i) prepared.triangles[t][i] = lowest[mesh.triangles[3 * t + i]];
        }
      },
      kBlock);
}

/// Whether a mesh has the triangles of one before, no vertices of which shared a position.
bool areSameTriangles(const MeshView& mesh, const Prepared& before) {
  return before.counts.weldedVertices == 0 && mesh.vertexCount() == before.triVertices && mesh.triangleCount() == before.triangles.size() &&
         std::memcmp(mesh.triangles.data(), before.triangles.data(), mesh.triangles.size_bytes()) == 0;
}

}  // namespace

void makeRoomFor(size_t triangles, const Monitor& monitor) {
  constexpr size_t kMany = 1000;
  if (triangles < kMany) return;
  makeRoomInHeap();
  monitor.team().makeRoomInHeaps();
}

CheckedMesh checkInput(const MeshView& mesh, double largest, Monitor& monitor) {
  checkArrays(mesh);
  const Marks referenced = referencedVertices(mesh, monitor);
  return checkCoordinates(mesh, largest, monitor, [&](size_t v) { return referenced[v].load(std::memory_order_relaxed); });
}

std::unique_ptr<Prepared> weldInput(const MeshView& mesh, double largest, Monitor& monitor, const std::function<void()>& meanwhile) {
  makeRoomFor(mesh.triangleCount(), monitor);
  auto prepared = scaled(mesh, checkInput(mesh, largest, monitor), monitor);
  std::vector<uint32_t> lowest;
  const std::function<void()> tasks[] = {[&] { lowest = weld(prepared->referenced, prepared->points); }, meanwhile};
  runTasks(std::span(tasks).first(meanwhile ? 2 : 1), monitor);
  addTriangles(*prepared, mesh, lowest, monitor);
  return prepared;
}

/// Only vertices that have moved, and those between them, may share positions now.
std::unique_ptr<Prepared> weldAgain(const MeshView& mesh, double largest, const Prepared& before, Monitor& monitor) {
  checkArrays(mesh);
  if (!areSameTriangles(mesh, before)) return weldInput(mesh, largest, monitor);
  makeRoomFor(mesh.triangleCount(), monitor);
  auto prepared = scaled(mesh, checkCoordinates(mesh, largest, monitor, [&](size_t v) { return before.referenced[v]; }), monitor);
  const std::vector<Point>& points = prepared->points;
  Box moved = Box::empty();
  for (size_t v = 0; v < points.size(); ++v) {
    if (points[v] != before.points[v]) moved.include({points[v], points[v]});
  }
  std::vector<uint8_t> mayBeWelded(points.size());
  for (size_t v = 0; v < points.size(); ++v) mayBeWelded[v] = prepared->referenced[v] && moved.overlaps({points[v], points[v]});
  addTriangles(*prepared, mesh, weld(mayBeWelded, points), monitor);
  return prepared;
}

void dropFlat(Prepared& prepared, const std::vector<uint32_t>* some, Monitor& monitor, Predicates& predicates) {
  const std::vector<uint32_t> zeroArea = dropZeroArea(prepared, some, monitor, predicates);
  prepared.counts.zeroAreaTriangles = uint32_t(zeroArea.size());
  if (!zeroArea.empty()) prepared.stitches = findStitches(prepared, zeroArea);
}

void findInputEdges(Prepared& prepared) { findEdges(prepared, nullptr); }

void arrangeInput(Prepared& prepared, Contacts contacts, bool keepContacts, Monitor& monitor, Predicates& predicates) {
  auto arrangement = std::make_unique<Arrangement>(arrange(prepared, contacts, monitor, predicates));
  if (!arrangement->empty()) {
    prepared.stitches = arrangement->sides;
    for (uint32_t v = prepared.triVertices; v < arrangement->points.size(); ++v)
      prepared.points.push_back(arrangement->points.reference(v));
    findEdges(prepared, arrangement.get());
  }
  prepared.arrangement = std::move(arrangement);
  if (keepContacts) prepared.contacts = std::move(contacts.pairs);
}

void resolveInput(Prepared& prepared, const Preparation& preparation, Monitor& monitor, Predicates& predicates) {
  if (preparation.intersections == Intersections::assumeNone) return findEdges(prepared, nullptr);
  const NearTriangles near = findEdgesAndNear(prepared, std::vector<TriangleState>(prepared.states), true, monitor);
  if (preparation.intersections == Intersections::refuse) {
    return refuseIntersections(prepared, findContacts(prepared, near, monitor, predicates, 1));
  }
  arrangeInput(prepared, findContacts(prepared, near, monitor, predicates), preparation.keepContacts, monitor, predicates);
}

std::vector<TrianglePair> findPairs(const Prepared& prepared, const ShareOf& shareOf, Monitor& monitor, Predicates& predicates) {
  std::vector<TrianglePair> pairs;
  if (shareOf.index >= shareOf.count) return pairs;
  const SearchBand band(prepared, shareOf);
  const NearTriangles near = findNear(SortedMesh(prepared, band.states()), monitor);
  for (const PairContact& pair : findContacts(prepared, near, monitor, predicates).pairs) {
    if (band.has(pair.triangles)) pairs.push_back(pair.triangles);
  }
  return pairs;
}

bool findEdgesIfPlain(Prepared& prepared, const std::vector<TriangleState>& states, Intersections intersections, Monitor& monitor,
                      Predicates& predicates) {
  if (intersections == Intersections::assumeNone || prepared.triangles.empty()) {
    prepared.edges = findMeshEdges(prepared, nullptr, nullptr);
    return prepared.duplicates.empty();
  }
  const NearTriangles near = findEdgesAndNear(prepared, states, false, monitor);
  return prepared.duplicates.empty() && findContacts(prepared, near, monitor, predicates, 1).pairs.empty();
}

void resolvePairs(Prepared& prepared, const std::vector<TrianglePair>& pairs, const Preparation& preparation, Monitor& monitor,
                  Predicates& predicates) {
  Contacts contacts = contactsOfPairs(prepared, pairs, monitor, predicates);
  if (preparation.intersections == Intersections::refuse) return refuseIntersections(prepared, contacts);
  arrangeInput(prepared, std::move(contacts), preparation.keepContacts, monitor, predicates);
}

std::unique_ptr<Prepared> prepareMesh(const MeshView& mesh, const Preparation& preparation, Monitor& monitor,
                                      const std::function<void(const char*)>& beginStage) {
  Predicates predicates;
  beginStage("input");
  auto prepared = weldInput(mesh, preparation.largest, monitor, preparation.meanwhile);
  dropFlat(*prepared, nullptr, monitor, predicates);
  if (preparation.intersections != Intersections::assumeNone) beginStage("intersections");
  resolveInput(*prepared, preparation, monitor, predicates);
  prepared->counts.exactFallbacks = predicates.fallbacks;
  return prepared;
}

}  // namespace mandoline::detail

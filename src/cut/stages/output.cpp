#include "cut/stages/output.h"

#include <array>

#include "base/large_array.h"
#include "base/run_tasks.h"
#include "cut/append.h"

namespace mandoline::detail {
namespace {

/// Lays the arrays of all parts one after the other.
class Joiner {
 public:
  explicit Joiner(const std::vector<CutPart>& parts) : parts_(parts) {}

  CutMesh run() {
    out_.grid = parts_.front().cutMesh.grid;
    joinVertices();
    joinFaces();
    joinCells();
    return std::move(out_);
  }

 private:
  using Offsets = std::vector<uint32_t>;

  template <class... Items>
  void makeRoom(std::vector<Items> CutMesh::*... arrays) {
    const auto make = [&](auto array) {
      size_t count = 0;
      for (const CutPart& part : parts_) count += (part.cutMesh.*array).size();
      reserveLarge(out_.*array, count);
    };
    (make(arrays), ...);
  }

  template <class... Items>
  void append(const CutMesh& from, const IdRange& range, std::vector<Items> CutMesh::*... arrays) {
    (appendItems(from.*arrays, range, out_.*arrays), ...);
  }
  template <class Item>
  static void appendItems(const std::vector<Item>& from, const IdRange& range, std::vector<Item>& to) {
    const size_t at = to.size();
    to.resize(at + range.size());
    std::copy_n(from.begin() + ptrdiff_t(range.begin), range.size(), to.begin() + ptrdiff_t(at));
  }

  /// Appends the groups of a range. Gives the range of their items.
  IdRange appendOffsets(const CutMesh& from, const IdRange& range, Offsets CutMesh::*array) {
    const Offsets& offsets = from.*array;
    Offsets& all = out_.*array;
    if (all.empty()) all.push_back(0);
    const IdRange items{offsets[range.begin], offsets[range.end]};
    requireFewIds(uint64_t(all.back()) + items.size());
    const uint32_t shift = all.back() - offsets[range.begin];
    for (size_t i = range.begin; i < range.end; ++i) all.push_back(offsets[i + 1] + shift);
    return items;
  }

  /// Vertices of the mesh and its edges are scattered over the parts.
  void joinVertices() {
    makeRoom(&CutMesh::positions, &CutMesh::vertexCell, &CutMesh::vertexMask, &CutMesh::vertexTriVertex, &CutMesh::vertexParents);
    size_t first = 0;
    for (const CutPart& part : parts_) {
      for (const uint32_t v : part.firstVertices) first = v == Numbers::kUnused ? first : std::max(first, size_t(v) + 1);
    }
    resizeVertices(first);
    for (const CutPart& part : parts_) {
      for (size_t i = 0; i < part.firstVertices.size(); ++i) {
        if (part.firstVertices[i] != Numbers::kUnused) copyVertex(part.cutMesh, i, part.firstVertices[i]);
      }
    }
    for (const CutPart& part : parts_) {
      const size_t begin = part.firstVertices.size(), end = part.cutMesh.vertexCount();
      append(part.cutMesh, {begin, end}, &CutMesh::vertexMask, &CutMesh::vertexTriVertex);
      append(part.cutMesh, {2 * begin, 2 * end}, &CutMesh::vertexParents);
      append(part.cutMesh, {3 * begin, 3 * end}, &CutMesh::positions, &CutMesh::vertexCell);
    }
  }
  void resizeVertices(size_t count) {
    out_.vertexMask.resize(count);
    out_.vertexTriVertex.resize(count);
    out_.vertexParents.resize(2 * count);
    out_.positions.resize(3 * count);
    out_.vertexCell.resize(3 * count);
  }
  void copyVertex(const CutMesh& from, size_t v, size_t to) {
    out_.vertexMask[to] = from.vertexMask[v];
    out_.vertexTriVertex[to] = from.vertexTriVertex[v];
    std::copy_n(&from.vertexParents[2 * v], 2, &out_.vertexParents[2 * to]);
    std::copy_n(&from.positions[3 * v], 3, &out_.positions[3 * to]);
    std::copy_n(&from.vertexCell[3 * v], 3, &out_.vertexCell[3 * to]);
  }

  /// The tri-cut-faces of all parts, then the pieces of grid-faces.
  void joinFaces() {
    makeRoom(&CutMesh::loopVertices, &CutMesh::loopOffsets, &CutMesh::faceLoopOffsets, &CutMesh::faceTriangle, &CutMesh::facePlane,
             &CutMesh::faceAxis, &CutMesh::faceParentOffsets, &CutMesh::faceParents, &CutMesh::faceParentSigns);
    for (const CutPart& part : parts_) joinFacesOf(part.cutMesh, {0, part.triFaces});
    for (const CutPart& part : parts_) joinFacesOf(part.cutMesh, {part.triFaces, part.cutMesh.faceCount()});
  }
  void joinFacesOf(const CutMesh& from, const IdRange& faces) {
    append(from, faces, &CutMesh::faceTriangle, &CutMesh::facePlane, &CutMesh::faceAxis);
    const IdRange loops = appendOffsets(from, faces, &CutMesh::faceLoopOffsets);
    append(from, appendOffsets(from, loops, &CutMesh::loopOffsets), &CutMesh::loopVertices);
    append(from, appendOffsets(from, faces, &CutMesh::faceParentOffsets), &CutMesh::faceParents, &CutMesh::faceParentSigns);
  }

  void joinCells() {
    makeRoom(&CutMesh::cellHalfFaceOffsets, &CutMesh::cellHalfFaces, &CutMesh::cellGridCell, &CutMesh::cellRegion);
    for (const CutPart& part : parts_) {
      const IdRange cells{0, part.cutMesh.cellCount()};
      append(part.cutMesh, cells, &CutMesh::cellRegion);
      append(part.cutMesh, {0, 3 * cells.end}, &CutMesh::cellGridCell);
      append(part.cutMesh, appendOffsets(part.cutMesh, cells, &CutMesh::cellHalfFaceOffsets), &CutMesh::cellHalfFaces);
    }
  }

  const std::vector<CutPart>& parts_;
  CutMesh out_;
};

/// The vertices that triangles make by meeting.
void listMade(const CutState& state, CutMesh& out) {
  const Prepared& mesh = *state.surface.input.mesh;
  if (!mesh.hasIntersections()) return;
  const CutVertices& vertices = state.surface.vertices;
  const std::vector<VertexId> used = listUsed(state.used);
  for (uint32_t i = 0; i < used.size(); ++i) {
    if (!vertices.isImplicit(used[i])) continue;
    out.madeVertices.push_back(i);
    int32_t parents[4] = {-1, -1, -1, -1};
    MadeVertex kind = MadeVertex::trianglesPlane;
    if (vertices.isTriVertex(used[i])) {
      const PointKey& key = mesh.arrangement->points.key(used[i].number);
      const int count = key.kind == PointKey::Kind::edgeEdge ? 4 : 3;
      for (int k = 0; k < count; ++k) parents[k] = int32_t(key.ids[size_t(k)]);
      kind = key.kind == PointKey::Kind::edgeEdge       ? MadeVertex::edgeEdge
             : key.kind == PointKey::Kind::edgeTriangle ? MadeVertex::edgeTriangle
                                                        : MadeVertex::triangles;
    } else {
      const Line line = vertices.edges->line(vertices.triEdge(used[i]));
      parents[0] = int32_t(std::min(line.a, line.b));
      parents[1] = int32_t(std::max(line.a, line.b));
    }
    out.madeVertexKinds.push_back(uint8_t(kind));
    out.madeVertexParents.insert(out.madeVertexParents.end(), parents, parents + 4);
  }
}

/// Triangles without a face: those dropped before, and those outside of the grid.
void listDropped(const std::vector<uint8_t>& hasFace, const Input& input, CutMesh& out, CutStats& stats) {
  for (uint32_t t = 0; t < hasFace.size(); ++t) {
    if (hasFace[t]) continue;
    out.droppedTriangles.push_back(t);
    if (input.mesh->kept(t)) ++stats.outsideTriangles;
  }
}

/// Triangles of parts without winding numbers.
void listParts(const Parts& parts, CutMesh& out) {
  for (uint32_t t = 0; t < parts.kinds.size(); ++t) {
    if (parts.kinds[t] == PartKind::parity) out.parityTriangles.push_back(t);
    if (parts.kinds[t] == PartKind::open) out.openTriangles.push_back(t);
  }
}

/// What is not made in parts.
void addCommon(UntouchedRuns runs, Regions regions, const CutState& state, CutMesh& out) {
  listMade(state, out);
  out.rowRunOffsets = std::move(runs.rowOffsets);
  out.runBegin = std::move(runs.begin);
  out.runEnd = std::move(runs.end);
  out.runRegion = std::move(regions.runRegion);
  out.regionCount = regions.count;
  out.hasWinding = regions.hasWinding;
  out.regionWinding = std::move(regions.winding);
  out.regionPartWinding = std::move(regions.partWinding);
  out.regionParity = std::move(regions.parity);
  const Prepared& mesh = *state.surface.input.mesh;
  listParts(mesh.parts, out);
  out.triangleCount = uint32_t(mesh.triangles.size());
}

/// Once the faces are known.
void finish(const std::vector<uint8_t>& hasFace, const CutState& state, CutMesh& out, CutStats& stats) {
  listDropped(hasFace, state.surface.input, out, stats);
  stats.madeVertices = uint32_t(out.madeVertices.size());
}

}  // namespace

CutMesh makeOutput(std::vector<CutPart> parts, CutState& state, Run& run) {
  CutMesh out = parts.size() == 1 ? std::move(parts.front().cutMesh) : Joiner(parts).run();
  std::vector<uint8_t> hasFace;
  const std::array<std::function<void()>, 2> tasks{[&] { hasFace = trianglesWithFace(out, state.surface.input.mesh->triangles.size()); },
                                                   [&] { addCommon(std::move(state.runs), std::move(state.regions), state, out); }};
  runTasks(tasks, run.monitor);
  finish(hasFace, state, out, run.stats);
  return out;
}

CutMesh makeCommon(const std::vector<uint8_t>& hasFace, const CutState& state, Run& run) {
  CutMesh out;
  addCommon(state.runs, state.regions, state, out);
  finish(hasFace, state, out, run.stats);
  return out;
}

}  // namespace mandoline::detail

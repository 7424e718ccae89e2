#include "cut/stages/output.h"

#include "base/large_array.h"
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
    std::vector<const CutMesh*> made;
    for (const CutPart& part : parts_) made.push_back(&part.cutMesh);
    joinMade(made, out_);
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
    to.insert(to.end(), from.begin() + ptrdiff_t(range.begin), from.begin() + ptrdiff_t(range.end));
  }

  /// Appends the groups of a range. Gives the range of their items.
  IdRange appendOffsets(const CutMesh& from, const IdRange& range, Offsets CutMesh::*array) {
    const Offsets& offsets = from.*array;
    Offsets& all = out_.*array;
    if (all.empty()) all.push_back(0);
    const IdRange items{offsets[range.begin], offsets[range.end]};
    requireFewIds(uint64_t(all.back()) + items.size());
    const uint32_t shift = all.back() - offsets[range.begin];
    const size_t at = all.size();
    appendItems(offsets, {range.begin + 1, range.end + 1}, all);
    for (size_t i = at; i < all.size(); ++i) all[i] += shift;
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

/// Triangles without a face: those dropped before, and those outside of the grid.
void listDropped(const std::vector<uint8_t>& hasFace, const WholeTriangles& triangles, CutMesh& out, CutStats& stats) {
  for (uint32_t t = 0; t < hasFace.size(); ++t) {
    if (!hasFace[t]) out.droppedTriangles.push_back(t);
  }
  const auto isDropped = [&](uint32_t t) { return !hasFace[t]; };
  const auto before = std::count_if(triangles.dropped.begin(), triangles.dropped.end(), isDropped);
  stats.outsideTriangles = uint32_t(out.droppedTriangles.size() - size_t(before));
}

/// What is not made in parts.
void addCommon(UntouchedRuns runs, Regions regions, WholeTriangles triangles, CutMesh& out) {
  out.rowRunOffsets = std::move(runs.rowOffsets);
  out.runBegin = std::move(runs.begin);
  out.runEnd = std::move(runs.end);
  out.runRegion = std::move(regions.runRegion);
  out.regionCount = regions.count;
  out.hasWinding = regions.hasWinding;
  out.regionWinding = std::move(regions.winding);
  out.regionPartWinding = std::move(regions.partWinding);
  out.regionParity = std::move(regions.parity);
  out.parityTriangles = std::move(triangles.parity);
  out.openTriangles = std::move(triangles.open);
  out.triangleCount = triangles.count;
}

WholeTriangles trianglesOf(const CutState& state) {
  return state.wholeTriangles ? *state.wholeTriangles : WholeTriangles(*state.surface.input.mesh);
}

}  // namespace

CutMesh makeOutput(std::vector<CutPart> parts, CutState& state, Run& run) {
  CutMesh out = parts.size() == 1 ? std::move(parts.front().cutMesh) : Joiner(parts).run();
  WholeTriangles triangles = trianglesOf(state);
  listDropped(trianglesWithFace(out, triangles.count), triangles, out, run.stats);
  addCommon(std::move(state.runs), std::move(state.regions), std::move(triangles), out);
  run.stats.madeVertices = uint32_t(out.madeVertices.size());
  return out;
}

CutMesh makeCommon(const std::vector<uint8_t>& hasFace, const CutState& state, Run& run) {
  CutMesh out;
  WholeTriangles triangles = trianglesOf(state);
  listDropped(hasFace, triangles, out, run.stats);
  addCommon(state.runs, state.regions, std::move(triangles), out);
  return out;
}

}  // namespace mandoline::detail

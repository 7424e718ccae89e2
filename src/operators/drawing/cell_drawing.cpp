#include <bit>

#include "mandoline/drawing.h"
#include "operators/cut_input.h"
#include "operators/drawing/cell_shapes.h"
#include "operators/drawing/smooth_normals.h"

namespace mandoline {

namespace {

using drawing::PackedNormal;

/// Draws one cut-cell after the other.
class Drawer {
 public:
  /// `normals`: those of faceNormals().
  Drawer(const CutMesh& cutMesh, const FaceTriangles& faceTriangles, const std::vector<PackedNormal>& normals,
         const std::array<double, 3>& origin, CellDrawing& out)
      : cutMesh_(cutMesh), faceTriangles_(faceTriangles), normals_(normals), origin_(origin), out_(out) {}

  void run() {
    makeRoom();
    for (uint32_t cell = 0; cell < cutMesh_.cellCount(); ++cell) {
      first_ = uint32_t(vertices_.size());
      for (const uint32_t h : cutMesh_.halfFaces(cell)) addFace(cell, h / 2, h % 2);
      for (const uint32_t h : cutMesh_.halfFaces(cell)) addEdges(h / 2, h % 2);
    }
    writeVertices();
    writeEdges();
  }

 private:
  static constexpr uint32_t kNone = ~0u;

  enum EdgeKind { kTriEdge, kHybridEdge, kGridEdge };

  struct Vertex {
    uint32_t vertex;  // of the cut-mesh
    PackedNormal normal;
    uint32_t twin;  // the next one of those that the cut-vertex has in the cell, in a circle
  };

  void makeRoom() {
    uint64_t corners = 0, all = 0, surface = 0;
    for (const uint32_t h : cutMesh_.cellHalfFaces) {
      const uint32_t f = h / 2, triangles = faceTriangles_.faceTriangleOffsets[f + 1] - faceTriangles_.faceTriangleOffsets[f];
      all += triangles;
      if (cutMesh_.faceTriangle[f] >= 0) surface += triangles;
      corners += cutMesh_.loopOffsets[cutMesh_.faceLoopOffsets[f + 1]] - cutMesh_.loopOffsets[cutMesh_.faceLoopOffsets[f]];
    }
    if (corners >= kNone || all >= kNone / 3) {
      throw CallError({Status::meshTooLarge, -1, -1, "The faces of the cut-cells have more corners than can be numbered in 32 bits."});
    }
    ids_.assign(cutMesh_.vertexCount(), kNone);
    vertices_.reserve(size_t(corners / 2));
    out_.vertexCell.reserve(size_t(corners / 2));
    out_.triangles.resize(3 * size_t(all));
    out_.surfaceTriangles = uint32_t(surface);
    surfaceEnd_ = out_.triangles.data();
    gridEnd_ = surfaceEnd_ + 3 * size_t(surface);
  }

  bool hasId(uint32_t vertex) const { return ids_[vertex] != kNone && ids_[vertex] >= first_; }

  void addFace(uint32_t cell, uint32_t face, uint32_t side) {
    const uint32_t begin = cutMesh_.loopOffsets[cutMesh_.faceLoopOffsets[face]],
                   end = cutMesh_.loopOffsets[cutMesh_.faceLoopOffsets[face + 1]];
    for (uint32_t i = begin; i < end; ++i) addCorner(cell, cutMesh_.loopVertices[i], normals_[i]);
    uint32_t*& to = cutMesh_.faceTriangle[face] >= 0 ? surfaceEnd_ : gridEnd_;
    const uint32_t *from = &faceTriangles_.triangles[3 * size_t(faceTriangles_.faceTriangleOffsets[face])],
                   *past = from + 3 * size_t(faceTriangles_.faceTriangleOffsets[face + 1] - faceTriangles_.faceTriangleOffsets[face]);
    // Side 1 sees the face from behind.
    if (side == 1) {
      while (past != from) *to++ = ids_[*--past];
    } else {
      while (from != past) *to++ = ids_[*from++];
    }
  }

  /// From now on the cut-vertex has an id with this normal.
  void addCorner(uint32_t cell, uint32_t vertex, PackedNormal normal) {
    const uint32_t id = ids_[vertex];
    if (!hasId(vertex)) {
      addVertex(cell, vertex, normal);
    } else if (normal != 0 && vertices_[id].normal != normal) {
      ids_[vertex] = withNormal(cell, id, normal);
    }
  }

  uint32_t addVertex(uint32_t cell, uint32_t vertex, PackedNormal normal) {
    const uint32_t id = uint32_t(vertices_.size());
    vertices_.push_back({vertex, normal, id});
    out_.vertexCell.push_back(cell);
    return ids_[vertex] = id;
  }

  /// The one of a cut-vertex's ids in the cell that has this normal; a new one beyond a crease.
  uint32_t withNormal(uint32_t cell, uint32_t known, PackedNormal normal) {
    uint32_t id = known;
    do {
      if (vertices_[id].normal == 0) vertices_[id].normal = normal;
      if (drawing::areAlike(vertices_[id].normal, normal)) return id;
      id = vertices_[id].twin;
    } while (id != known);
    id = addVertex(cell, vertices_[known].vertex, normal);
    vertices_[id].twin = vertices_[known].twin;
    vertices_[known].twin = id;
    return id;
  }

  /// The half-faces of a cell traverse an edge equally often in both directions, so that one direction is enough to find it.
  void addEdges(uint32_t face, uint32_t side) {
    for (const auto loop : cutMesh_.loops(face)) {
      uint32_t from = loop.back();
      for (const uint32_t to : loop) {
        if ((from < to) == (side == 0)) {
          std::vector<uint32_t>& edges = edges_[kindOf(from, to)];
          edges.push_back(ids_[from]);
          edges.push_back(ids_[to]);
        }
        from = to;
      }
    }
  }

  EdgeKind kindOf(uint32_t from, uint32_t to) const {
    const int planes = std::popcount(cutMesh_.commonPlanes(from, to));
    return planes == 0 ? kTriEdge : planes == 1 ? kHybridEdge : kGridEdge;
  }

  void writeVertices() {
    out_.positions.resize(3 * vertices_.size());
    out_.normals.resize(4 * vertices_.size());
    for (size_t id = 0; id < vertices_.size(); ++id) {
      const double* position = &cutMesh_.positions[3 * size_t(vertices_[id].vertex)];
      for (size_t d = 0; d < 3; ++d) out_.positions[3 * id + d] = float(position[d] - origin_[d]);
      for (size_t i = 0; i < 4; ++i) out_.normals[4 * id + i] = int8_t(vertices_[id].normal >> (8 * i));
    }
  }

  void writeEdges() {
    out_.hybridEdges = uint32_t(edges_[kHybridEdge].size() / 2);
    out_.gridEdges = uint32_t(edges_[kGridEdge].size() / 2);
    out_.edges.reserve(edges_[kHybridEdge].size() + edges_[kGridEdge].size() + edges_[kTriEdge].size());
    for (const EdgeKind kind : {kHybridEdge, kGridEdge, kTriEdge}) {
      out_.edges.insert(out_.edges.end(), edges_[kind].begin(), edges_[kind].end());
    }
  }

  const CutMesh& cutMesh_;
  const FaceTriangles& faceTriangles_;
  const std::vector<PackedNormal>& normals_;
  const std::array<double, 3>& origin_;
  CellDrawing& out_;
  uint32_t first_ = 0;         // id of the current cell
  std::vector<uint32_t> ids_;  // per cut-vertex: its id, in the current cell if it isn't below the cell's first
  std::vector<Vertex> vertices_;
  uint32_t *surfaceEnd_ = nullptr, *gridEnd_ = nullptr;  // where the next triangles go
  std::array<std::vector<uint32_t>, 3> edges_;           // by kind
};

}  // namespace

CellDrawing cellDrawing(const MeshView& mesh, const CutMesh& cutMesh, const std::array<double, 3>& origin) {
  const operators::CutInput input(mesh, cutMesh);
  const FaceTriangles faceTriangles = triangulateFaces(cutMesh);
  CellDrawing result;
  drawing::measureCells(cutMesh, faceTriangles, origin, result);
  Drawer(cutMesh, faceTriangles, drawing::faceNormals(input.mesh(), cutMesh), origin, result).run();
  result.madeFrom = cutMesh.fingerprint;
  return result;
}

}  // namespace mandoline

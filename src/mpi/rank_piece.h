// A process's part of a cut as a piece, with the ghosts that it takes from the process below.
#pragma once

#include <optional>

#include "mandoline/distributed.h"
#include "mesh/mesh_part.h"

namespace mandoline::detail {

/// A part, and the numbers of what it has in the whole. Vertices of the mesh and its edges, tri-cut-faces and pieces of grid-faces are
/// numbered one kind after the other.
struct NumberedPart {
  const CutPart& part;
  int rank;
  uint64_t surfaceVertices, firstVertex;  ///< those of the mesh and its edges in all; the first of the part's others
  uint64_t firstTriFace, firstPiece, firstCell;

  uint64_t vertexId(size_t v) const {
    return v < part.firstVertices.size() ? part.firstVertices[v] : firstVertex + v - part.firstVertices.size();
  }
  uint64_t faceId(size_t f) const { return f < part.triFaces ? firstTriFace + f : firstPiece + f - part.triFaces; }
  /// Of an id: the face, if the part has it.
  std::optional<uint32_t> findFace(uint64_t id) const;
};

/// What lies in the plane between the layers of two processes, and belongs to the lower one.
struct PlaneFaces {
  int32_t rank = -1;
  CutMesh cutMesh;  ///< vertices and faces; loopVertices are ids
  std::vector<uint64_t> vertexIds, faceIds;
  std::vector<uint8_t> isUsed;  ///< per vertex: whether a face of the lower process has it. If not, it is left to the upper one
  std::vector<uint64_t> cells;  ///< per face: id of the cut-cell below, or kNoCell
  MeshPart surface;             ///< what measuring these takes of the mesh

  static constexpr uint64_t kNoCell = ~uint64_t(0);

  static void fields(auto& self, const auto& f) {
    f("rank", self.rank);
    f("cutMesh", self.cutMesh);
    f("vertexIds", self.vertexIds);
    f("faceIds", self.faceIds);
    f("isUsed", self.isUsed);
    f("cells", self.cells);
    f("surface", self.surface);
  }
};

/// In the plane z = `plane` of the grid, at the upper end of the part.
PlaneFaces facesInPlane(const NumberedPart& numbered, int32_t plane);

/// What there is on the other side of faces.
struct CellsAbove {
  int32_t rank = -1;
  std::vector<uint64_t> faceIds;  ///< ascending
  std::vector<uint64_t> cells;    ///< per face: the id of the cut-cell above

  static void fields(auto& self, const auto& f) {
    f("rank", self.rank);
    f("faceIds", self.faceIds);
    f("cells", self.cells);
  }
};

/// The piece, without the seam above, and what the process below has to know of it. `common` is that of the share. Throws Failure if the
/// part has faces or vertices that neither it nor `below` knows (internalError).
struct PieceFromBelow {
  RankPiece piece;
  CellsAbove forBelow;
};
PieceFromBelow makePiece(const NumberedPart& numbered, const CutMesh& common, const std::array<int64_t, 2>& layers,
                         const PlaneFaces& below);

/// Adds what all processes know alike to a piece that has its layers, vertices, faces and cut-cells. `common` is that of the share.
void takeCommon(const CutMesh& common, RankPiece& piece);

/// Adds the seam to the process above.
void addSeam(const CellsAbove& above, RankPiece& piece);

}  // namespace mandoline::detail

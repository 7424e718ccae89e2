// What the result needs of a brick, taken from the stages that cut it.
//
// In: BrickSurface, Stencil, GridEdges, CutFaces, CutCells. Out: BrickCut, its arrays in `memory`.
#pragma once

#include "cut/stages/brick_cut.h"
#include "cut/stages/vertex_places.h"

namespace mandoline::detail {

/// What a brick's arrays are gathered in, used again for the next one.
struct Gathered {
  std::vector<VertexId> lineVertices;
  IdVector<VertexId, uint32_t> places;  ///< see VertexPlaces
  std::vector<VertexId> surfaceVertices;
  std::vector<FaceId> triOrder;         ///< the tri-cut-faces as they are numbered
  IdVector<FaceId, FaceId> triNumbers;  ///< per tri-cut-face
  std::vector<InPlane> triFacesInPlane;
  std::vector<uint32_t> gridCells;
  IdVector<CellId, uint32_t> components;
  std::vector<BrickRow> rows;
  std::vector<BoundaryFace> boundaryFaces;
  std::vector<BoundaryHalf> boundaryHalves;
  std::vector<BoundaryLine> boundaryLines;
  std::vector<OpenFace> openFaces;
  std::vector<WindingStep> steps;
  std::vector<uint32_t> pastVertex;  ///< per cell of the stencil: of those that it, or one before it, has first

  void clear() {
    lineVertices.clear();
    for (const VertexId v : surfaceVertices) places[v] = VertexPlaces::kNone;
    surfaceVertices.clear();
    triOrder.clear();
    triFacesInPlane.clear();
    gridCells.clear();
    components.clear();
    rows.clear();
    boundaryFaces.clear();
    boundaryHalves.clear();
    boundaryLines.clear();
    openFaces.clear();
    steps.clear();
    pastVertex.clear();
  }
};

/// What the stages of a brick have made.
struct BrickStages {
  const BrickSurface& surface;
  const Stencil& stencil;
  const GridEdges& gridEdges;
  const CutFaces& faces;
  const CutCells& cells;
};

void harvest(const BrickStages& stages, const std::vector<Counted>& counted, Gathered& gathered, BrickMemory& memory, BrickCut& out);

}  // namespace mandoline::detail

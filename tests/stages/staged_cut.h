// A cut that ends after a stage, to look at what that stage made.
#pragma once

#include "cut/stages/input.h"
#include "cut/stages/output.h"
#include "shapes.h"

namespace stages {

using namespace mandoline;
using namespace mandoline::detail;

/// The planes 0, 1, 2, 3 on each axis.
inline Grid unitCells() { return Grid::regular({0, 0, 0}, {1, 1, 1}, {3, 3, 3}); }

enum class Stage { input, triEdges, triFaces, stencil, gridEdges, gridFaces, cutCells, regions };

struct StagedCut {
  CutOptions options;
  CutStats stats;
  Monitor monitor{options, 1};
  Run run{stats, monitor};
  CutState state;
  GridEdges gridEdges;

  StagedCut(const Mesh& mesh, Stage last, const Grid& grid = unitCells(), double snapTolerance = 0) {
    state.surface.input = prepareInput(mesh, grid, snapTolerance, run);
    if (last >= Stage::triEdges) cutTriEdges(state.surface, run);
    if (last >= Stage::triFaces) state.faces.tri = cutTriangles(state.surface, run);
    if (last >= Stage::stencil) state.stencil = makeStencil(state.surface, state.faces.tri, run);
    if (last >= Stage::gridEdges) gridEdges = cutGridEdges(state.stencil, state.faces.tri, state.surface.vertices, run);
    if (last >= Stage::gridFaces) state.faces.grid = cutGridFaces(state.surface, state.stencil, gridEdges, state.faces.tri, run);
    if (last >= Stage::cutCells) state.cells = makeCutCells(state.surface, state.stencil, state.faces, run);
    if (last >= Stage::regions) state.regions = findRegions(state.surface, state.stencil, state.faces, state.cells, run);
  }
};

}  // namespace stages

// A cut that ends after a stage, to look at what that stage made.
#pragma once

#include "cut/stages/divided_faces.h"
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
  Monitor monitor{options, 2};
  Run run{stats, monitor};
  std::unique_ptr<const Prepared> prepared;
  CutState state;
  UndividedFaces undivided;
  GridEdges gridEdges;

  StagedCut(const Mesh& mesh, Stage last, const CutOptions& options_, const Grid& grid = unitCells(), bool onlyGeneral = false)
      : options(options_) {
    run.onlyGeneral = onlyGeneral;
    prepareOne(mesh, grid);
    state.surface.input = prepareInput(*prepared, grid, run);
    if (last >= Stage::triEdges) cutTriEdges(state.surface, run);
    if (last >= Stage::triFaces) cutFaces();
    if (last >= Stage::stencil) state.stencil = makeStencil(state.surface, state.faces.tri, run);
    if (last >= Stage::gridEdges) gridEdges = cutGridEdges(state.stencil, state.faces.tri, state.surface.vertices, run);
    if (last >= Stage::gridFaces) state.faces.grid = cutGridFaces(state.surface, state.stencil, gridEdges, state.faces.tri, run);
    if (last >= Stage::cutCells) state.cells = makeCutCells(state.surface, state.stencil, state.faces, run);
    if (last >= Stage::regions) state.regions = findRegions(state.surface, state.stencil, state.faces, state.cells, run);
  }
  StagedCut(const Mesh& mesh, Stage last, const Grid& grid = unitCells()) : StagedCut(mesh, last, CutOptions(), grid) {}

 private:
  void prepareOne(const Mesh& mesh, const Grid& grid) {
    prepared = prepareMesh(mesh, {largestCoordinate(grid), options.intersections}, monitor,
                           [&](const char* stage) { monitor.beginStage(stage, 0); });
  }
  void cutFaces() {
    state.faces.tri = cutTriangles(state.surface, undivided, run);
    divideFaces(state.surface, undivided, state.faces.tri, run);
  }
};

/// Options of a cut that does not look for triangles that meet.
inline CutOptions unresolved() {
  CutOptions options;
  options.intersections = Intersections::assumeNone;
  return options;
}

}  // namespace stages

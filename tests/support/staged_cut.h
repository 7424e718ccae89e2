// A cut that ends after a stage, to look at what that stage made. The stages of a brick take the whole grid as one.
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

/// How to cut, other than mesh and grid.
struct Way {
  CutOptions options = {};
  bool onlyGeneral = false;
  int brickShift = 10;

  Way() = default;
  Way(const CutOptions& options_) : options(options_) {}
};

struct StagedCut {
  CutOptions options;
  CutStats stats;
  Monitor monitor{options, 2};
  Run run{stats, monitor};
  std::unique_ptr<const Prepared> prepared;
  CutState state;
  // Of the first brick.
  Stencil stencil;
  GridEdges gridEdges;
  GridFaces gridFaces;
  CutCells cells;

  StagedCut(const Mesh& mesh, Stage last, const Way& way, const Grid& grid = unitCells()) : options(way.options) {
    run.onlyGeneral = way.onlyGeneral;
    run.brickShift = way.brickShift;
    prepareOne(mesh, grid);
    state.surface.input = prepareInput(*prepared, grid, run);
    if (last >= Stage::triEdges) cutTriEdges(state.surface, run);
    if (last >= Stage::triFaces) cutFaces();
    if (last >= Stage::stencil) state.bricks = layOutBricks(state.surface, state.triFaces, run);
    if (last == Stage::regions) {
      findRest();
    } else if (last >= Stage::stencil && state.bricks.size() > 0) {
      cutFirstBrick(last);
    }
  }
  StagedCut(const Mesh& mesh, Stage last, const Grid& grid = unitCells()) : StagedCut(mesh, last, Way(), grid) {}

  CutFaces faces() const { return {state.triFaces, gridFaces}; }

 private:
  void prepareOne(const Mesh& mesh, const Grid& grid) {
    prepared = prepareMesh(mesh, {largestCoordinate(grid), options.intersections}, monitor,
                           [&](const char* stage) { monitor.beginStage(stage, 0); });
  }
  void cutFaces() {
    UndividedFaces undivided;
    state.triFaces = cutTriangles(state.surface, undivided, run);
    divideFaces(state.surface, undivided, state.triFaces, run);
  }
  void cutFirstBrick(Stage last) {
    const CutSurface surface = state.cutSurface();
    makeStencil(surface, {0}, stencil);
    if (last >= Stage::gridEdges) cutGridEdges(surface, {0}, stencil, state.surface.vertices, gridEdges);
    GridFaceScratch gridFaceScratch;
    gridFaceScratch.onlyGraph = run.onlyGeneral;
    if (last >= Stage::gridFaces) cutGridFaces(surface, stencil, gridEdges, gridFaceScratch, gridFaces);
    CellScratch cellScratch;
    if (last >= Stage::cutCells) makeCutCells(state.surface, stencil, faces(), cellScratch, cells);
  }
  void findRest() {
    state.runs = findUntouchedRuns(state.surface.input, state.bricks, monitor);
    state.cuts = cutBricks(state.cutSurface(), state.surface.vertices, state.runs, run);
    state.regions = findRegions(state.cutSurface(), state.runs, state.cuts, run);
  }
};

inline CutMesh cutMeshOf(const Mesh& mesh, const Grid& grid = unitCells(), const Way& way = {}) {
  StagedCut cut(mesh, Stage::regions, way, grid);
  return makeOutput(mesh, grid, cut.state, cut.run);
}

/// A cut that does not look for triangles that meet.
inline CutOptions unresolved() {
  CutOptions options;
  options.intersections = Intersections::assumeNone;
  return options;
}

}  // namespace stages

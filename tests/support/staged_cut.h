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
  std::vector<int32_t> bricksAnew = {};  ///< layers with which they begin anew

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
  BrickSurface brick{state.surface};
  Stencil stencil;
  GridEdges gridEdges;
  GridFaces gridFaces;
  CutCells cells;

  StagedCut(const Mesh& mesh, Stage last, const Way& way, const Grid& grid = unitCells()) : options(way.options) {
    run.onlyGeneral = way.onlyGeneral;
    prepareOne(mesh, grid);
    state.surface.input = prepareInput(*prepared, grid, run);
    if (last >= Stage::triEdges) cutTriEdges(state.surface, run);
    if (last >= Stage::triFaces) clip({state.surface.input, BrickGrid::same(way.brickShift), way.bricksAnew});
    if (last == Stage::regions) {
      findRest();
    } else if (last >= Stage::triFaces) {
      cutFirstBrick(last);
    }
  }
  StagedCut(const Mesh& mesh, Stage last, const Grid& grid = unitCells()) : StagedCut(mesh, last, Way(), grid) {}

  CutFaces faces() const { return {brick.triFaces, gridFaces}; }

 private:
  void prepareOne(const Mesh& mesh, const Grid& grid) {
    prepared = prepareMesh(mesh, {largestCoordinate(grid), options.intersections}, monitor,
                           [&](const char* stage) { monitor.beginStage(stage, 0); });
  }
  void clip(const BrickGrid& brickGrid) {
    state.parts.clipped = clipTriangles(state.surface, brickGrid, run);
    divideFaces(state.surface, state.parts.clipped.undivided, state.parts.divided, run);
    state.bricks = layOutBricks(state.surface, state.parts, brickGrid, monitor);
  }
  void cutFirstBrick(Stage last) {
    brick.vertices = CutVertices::ofBrick(state.surface.vertices);
    if (state.bricks.size() == 0) return;
    brick.onlySweep = run.onlyGeneral;
    cutBrickSurface(state.surface, state.parts, {0}, state.bricks, brick);
    if (last >= Stage::stencil) makeStencil(brick, state.bricks, {0}, stencil);
    if (last >= Stage::gridEdges) cutGridEdges(brick, stencil, gridEdges);
    GridFaceScratch gridFaceScratch;
    gridFaceScratch.onlyGraph = run.onlyGeneral;
    if (last >= Stage::gridFaces) cutGridFaces(brick, stencil, gridEdges, gridFaceScratch, gridFaces);
    CellScratch cellScratch;
    if (last >= Stage::cutCells) makeCutCells(brick, stencil, faces(), cellScratch, cells);
  }
  void findRest() {
    state.cuts = cutBricks(state.surface, state.parts, state.bricks, run, state.kept);
    state.used = findUsed(state.surface, state.bricks, state.cuts, run);
    state.runs = findUntouchedRuns(state.surface.input, state.bricks, {0, state.surface.input.cells(2)}, monitor);
    findSeams(state.cut(), state.kept, state.seams, run);
    state.regions = findRegions(state.cut());
  }
};

inline CutMesh cutMeshOf(const Mesh& mesh, const Grid& grid = unitCells(), const Way& way = {}) {
  StagedCut cut(mesh, Stage::regions, way, grid);
  std::vector<CutPart> whole;
  whole.push_back(makePart(mesh, grid, cut.state, cut.run));
  return makeOutput(std::move(whole), cut.state, cut.run);
}

/// A cut that does not look for triangles that meet.
inline CutOptions unresolved() {
  CutOptions options;
  options.intersections = Intersections::assumeNone;
  return options;
}

}  // namespace stages

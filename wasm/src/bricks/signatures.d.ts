// Written by wasm/signatures.mjs from bricks/calls.js: change that.
import type { BrickCutter, BrickCutterOptions, CutMeshArrays, GridInput, Mesh, PlacedGrid, Recutter, RecutterOptions } from '../index.js';
import type { RefineOptions, RefinedCells } from '../physics/index.js';
import type { CallOptions, OnWorker } from '../worker.js';

export interface Calls {
  /**
   * Cuts meshes one after the other with the same grid. If a mesh differs from the one before in positions alone, only those parts of the
   * grid are cut again in which something has moved. Whether there is such a grid, the first cut tells.
   */
  createRecutter(grid: PlacedGrid, options?: RecutterOptions): Promise<Recutter>;
  /**
   * Cuts a grid brick by brick, a box of grid cells at a time, for cuts that are larger than memory: prepares the mesh and finds the
   * triangles near each brick. Errors are those of cut(); code "badOption" unless `cells` is a power of two up to 2^24.
   */
  createBrickCutter(mesh: Mesh, grid: GridInput, options?: BrickCutterOptions): Promise<BrickCutter>;
  /**
   * Cells of several sizes, as one conforming mesh: grid cells are divided where the surface bends, or where boxes or a rule say so, and cut
   * again there alone. `mesh` is the input that `cutMesh` was made from, without a snapTolerance and not by estimateInside(). The result has
   * a cut-mesh of its own, for calls of mandoline-wasm/physics that take both. Code "badOption" for options that are out of range,
   * "gridTooLarge" if there are more than 2^24 of the smallest cells along an axis, "badGrid" if planes between those of the grid are not
   * apart, "badArgument" if the mesh and the cut-mesh don't belong together.
   */
  refineCells(mesh: Mesh, cutMesh: CutMeshArrays, options?: RefineOptions): Promise<RefinedCells>;
}

/** The same in a worker. */
export interface WorkerCalls {
  createRecutter(grid: PlacedGrid, options?: RecutterOptions & CallOptions): Promise<OnWorker<Recutter>>;
  createBrickCutter(mesh: Mesh, grid: GridInput, options?: BrickCutterOptions & CallOptions): Promise<OnWorker<BrickCutter>>;
  refineCells(mesh: Mesh, cutMesh: CutMeshArrays, options?: RefineOptions & CallOptions): Promise<RefinedCells>;
}

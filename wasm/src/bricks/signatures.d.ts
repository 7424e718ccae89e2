// Written by wasm/signatures.mjs from bricks/calls.js: change that.
import type { BrickCutter, BrickCutterOptions, GridInput, Mesh, PlacedGrid, Recutter, RecutterOptions } from '../index.js';
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
}

/** The same in a worker. */
export interface WorkerCalls {
  createRecutter(grid: PlacedGrid, options?: RecutterOptions & CallOptions): Promise<OnWorker<Recutter>>;
  createBrickCutter(mesh: Mesh, grid: GridInput, options?: BrickCutterOptions & CallOptions): Promise<OnWorker<BrickCutter>>;
}

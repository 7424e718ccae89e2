/** The same calls as promises, in a module worker: the page stays responsive. Browsers and Node. */
import type {
  Adjacency, CutEdges, CutMesh, CutOptions, FaceTriangles, GridInput, InitOptions, Location, Locations, Mandoline, Measures, Mesh, Plane,
  Slice, SliceOptions, Validation, Vector3,
} from './index.js';

export { MandolineError, describe } from './index.js';

export interface CallOptions {
  /** Aborting ends the call with a MandolineError with code "cancelled": one that waits leaves the queue, one that runs is stopped. */
  signal?: AbortSignal;
  /** Buffers of the arguments to hand over instead of copying; the caller can't use them afterwards. */
  transfer?: ArrayBuffer[];
}

/** Calls run one after another, in the order they were made. Results are transferred, not copied. */
export interface MandolineWorker {
  cut(mesh: Mesh, grid: GridInput, options?: CutOptions & CallOptions): Promise<CutMesh>;
  validate(mesh: Mesh, cutMesh: CutMesh, options?: { snapTolerance?: number } & CallOptions): Promise<Validation>;
  measure(mesh: Mesh, cutMesh: CutMesh, options?: CallOptions): Promise<Measures>;
  cutEdges(mesh: Mesh, cutMesh: CutMesh, options?: CallOptions): Promise<CutEdges>;
  adjacency(cutMesh: CutMesh, options?: CallOptions): Promise<Adjacency>;
  triangulate(cutMesh: CutMesh, of?: undefined, options?: CallOptions): Promise<FaceTriangles>;
  triangulate(cutMesh: CutMesh, of: { cell: number } | { region: number }, options?: CallOptions): Promise<Uint32Array>;
  cellAt(cutMesh: CutMesh, point: Vector3, options?: CallOptions): Promise<Location | null>;
  cellsAt(cutMesh: CutMesh, points: Parameters<Mandoline['cellsAt']>[1], options?: CallOptions): Promise<Locations>;
  slice(cutMesh: CutMesh, plane: Plane, options?: SliceOptions & CallOptions): Promise<Slice>;
  write(mesh: Mesh, cutMesh: CutMesh, format: 'json' | 'vtu' | 'obj', options?: CallOptions): Promise<Uint8Array>;
  /** Ends the worker; calls under way are rejected with code "cancelled". */
  terminate(): void;
}

/** Starts a worker that has loaded the module. */
export function createWorker(options?: InitOptions): Promise<MandolineWorker>;

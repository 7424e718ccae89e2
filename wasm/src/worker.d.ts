/** The same calls as promises, in a module worker: the page stays responsive. Browsers and Node. */
import type {
  Adjacency,
  CutEdges,
  CutMesh,
  CutOptions,
  FaceTriangles,
  GridInput,
  InitOptions,
  IntersectionOptions,
  Location,
  Locations,
  Mandoline,
  Measures,
  Mesh,
  MeshArrays,
  MeshIntersections,
  Outlines,
  Plane,
  PrepareOptions,
  ReadMeshOptions,
  ResolvedMesh,
  RunOptions,
  Slice,
  SliceOptions,
  ValidateOptions,
  Validation,
  Vector3,
  WindingRule,
  WriteOptions,
} from './index.js';

export { MandolineError, describe } from './index.js';

export interface CallOptions {
  /** Aborting ends the call with a MandolineError with code "cancelled": one that waits leaves the queue, one that runs is stopped. */
  signal?: AbortSignal;
  /** Buffers of the arguments to hand over instead of copying; the caller can't use them afterwards. */
  transfer?: ArrayBuffer[];
}

export interface ExtraCallOptions extends CallOptions {
  /** Gets what the call tells of its progress; returning false cancels the call. */
  progress?: (value: any) => boolean | void;
}

/**
 * Calls run one after another, in the order they were made. Results are transferred, not copied; the twins of those of cut() and prepare()
 * stay in the thread (see CutMesh).
 */
export interface MandolineWorker {
  prepare(mesh: Mesh, options?: PrepareOptions & CallOptions): Promise<MeshArrays>;
  cut(mesh: Mesh, grid: GridInput, options?: CutOptions & CallOptions): Promise<CutMesh>;
  findIntersections(mesh: Mesh, options?: IntersectionOptions & CallOptions): Promise<MeshIntersections>;
  resolve(mesh: Mesh, options?: RunOptions & CallOptions): Promise<ResolvedMesh>;
  boundary(mesh: ResolvedMesh | CutMesh, rule?: WindingRule, options?: CallOptions): Promise<MeshArrays>;
  validate(mesh: Mesh, cutMesh: CutMesh, options?: ValidateOptions & CallOptions): Promise<Validation>;
  measure(mesh: Mesh, cutMesh: CutMesh, options?: RunOptions & CallOptions): Promise<Measures>;
  cutEdges(mesh: Mesh, cutMesh: CutMesh, options?: CallOptions): Promise<CutEdges>;
  adjacency(cutMesh: CutMesh, options?: CallOptions): Promise<Adjacency>;
  triangulate(cutMesh: CutMesh, of?: undefined, options?: CallOptions): Promise<FaceTriangles>;
  triangulate(cutMesh: CutMesh, of: { cell: number } | { region: number }, options?: CallOptions): Promise<Uint32Array<ArrayBuffer>>;
  cellAt(cutMesh: CutMesh, point: Vector3, options?: CallOptions): Promise<Location | null>;
  cellsAt(cutMesh: CutMesh, points: Parameters<Mandoline['cellsAt']>[1], options?: CallOptions): Promise<Locations>;
  slice(cutMesh: CutMesh, plane: Plane, options?: SliceOptions & CallOptions): Promise<Slice>;
  slices(
    cutMesh: CutMesh,
    normal: Vector3,
    offsets: Parameters<Mandoline['slices']>[2],
    options?: SliceOptions & CallOptions,
  ): Promise<Slice[]>;
  outlines(cutMesh: CutMesh, normal: Vector3, offsets: Parameters<Mandoline['outlines']>[2], options?: CallOptions): Promise<Outlines[]>;
  write(
    mesh: Mesh,
    cutMesh: CutMesh,
    format: 'json' | 'vtu' | 'obj',
    options?: WriteOptions & CallOptions,
  ): Promise<Uint8Array<ArrayBuffer>>;
  readMesh(source: Parameters<Mandoline['readMesh']>[0], options?: ReadMeshOptions & CallOptions): Promise<MeshArrays>;
  /**
   * Runs a call that the thread's own script serves (see `serve` of `mandoline-wasm/worker-thread`) with a copy of the arguments, in the
   * same queue as the others. What it throws is what the promise is rejected with, as a clone.
   */
  call<Result = unknown>(name: string, args?: readonly unknown[], options?: ExtraCallOptions): Promise<Result>;
  /** Ends the worker; calls under way are rejected with code "cancelled". */
  terminate(): void;
}

/** A module worker of browsers or a worker thread of Node. */
export interface Thread {
  postMessage(message: any, transfer?: any): void;
  terminate(): unknown;
}

export interface WorkerOptions extends InitOptions {
  /**
   * Starts a worker with a script of your own, which imports `mandoline-wasm/worker-thread` and may add calls to it:
   * `() => new Worker(new URL('./mine.js', import.meta.url), { type: 'module' })`. Called again whenever the thread has to be replaced,
   * because a call that ran was cancelled or the thread died.
   */
  thread?: () => Thread;
}

/** Starts a worker that has loaded the module. Code "loadFailed", naming the script that failed, if it can't. */
export function createWorker(options?: WorkerOptions): Promise<MandolineWorker>;

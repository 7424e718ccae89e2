/** The same calls as promises, in a module worker: the page stays responsive. Browsers and Node. */
import type {
  Adjacency, CutEdges, CutMesh, CutOptions, FaceTriangles, FileMesh, GridInput, InitOptions, Location, Locations, Mandoline, Measures, Mesh,
  Outlines, Plane, ReadMeshOptions, RunOptions, Slice, SliceOptions, ValidateOptions, Validation, Vector3,
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

/** Calls run one after another, in the order they were made. Results are transferred, not copied. */
export interface MandolineWorker {
  cut(mesh: Mesh, grid: GridInput, options?: CutOptions & CallOptions): Promise<CutMesh>;
  validate(mesh: Mesh, cutMesh: CutMesh, options?: ValidateOptions & CallOptions): Promise<Validation>;
  measure(mesh: Mesh, cutMesh: CutMesh, options?: RunOptions & CallOptions): Promise<Measures>;
  cutEdges(mesh: Mesh, cutMesh: CutMesh, options?: CallOptions): Promise<CutEdges>;
  adjacency(cutMesh: CutMesh, options?: CallOptions): Promise<Adjacency>;
  triangulate(cutMesh: CutMesh, of?: undefined, options?: CallOptions): Promise<FaceTriangles>;
  triangulate(cutMesh: CutMesh, of: { cell: number } | { region: number }, options?: CallOptions): Promise<Uint32Array<ArrayBuffer>>;
  cellAt(cutMesh: CutMesh, point: Vector3, options?: CallOptions): Promise<Location | null>;
  cellsAt(cutMesh: CutMesh, points: Parameters<Mandoline['cellsAt']>[1], options?: CallOptions): Promise<Locations>;
  slice(cutMesh: CutMesh, plane: Plane, options?: SliceOptions & CallOptions): Promise<Slice>;
  slices(cutMesh: CutMesh, normal: Vector3, offsets: Parameters<Mandoline['slices']>[2], options?: SliceOptions & CallOptions): Promise<Slice[]>;
  outlines(cutMesh: CutMesh, normal: Vector3, offsets: Parameters<Mandoline['outlines']>[2], options?: CallOptions): Promise<Outlines[]>;
  write(mesh: Mesh, cutMesh: CutMesh, format: 'json' | 'vtu' | 'obj', options?: CallOptions): Promise<Uint8Array<ArrayBuffer>>;
  readMesh(source: Parameters<Mandoline['readMesh']>[0], options?: ReadMeshOptions & CallOptions): Promise<FileMesh>;
  /**
   * Runs a call that the thread's own script serves (see `serve` of `mandoline-wasm/worker-thread`) with a copy of the arguments, in the same
   * queue as the others. What it throws is what the promise is rejected with, as a clone.
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

/** Starts a worker that has loaded the module. Code "loadFailed", with the address of the script that failed, if it can't. */
export function createWorker(options?: WorkerOptions): Promise<MandolineWorker>;

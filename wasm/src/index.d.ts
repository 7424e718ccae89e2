/**
 * Mandoline: cuts a triangle mesh with a Cartesian grid into polyhedral cut-cells.
 *
 * ```js
 * import { init } from 'mandoline-wasm';
 * const { cut } = await init();
 * const cutMesh = cut({ positions, triangles }, { cells: 32 });
 * ```
 *
 * All arrays are flat, all ids count from 0, and every offsets array starts with 0 and has one more entry than there are items. Lengths are
 * in world units unless "cells" is said. Results are plain objects of typed arrays that own their memory: keep, clone or transfer them,
 * there is nothing to delete. Arrays have the names that they have in the C++ library and its JSON dump. Numbers of sections and appendices
 * are the paper's.
 */
/// <reference lib="esnext.disposable" />
import type {
  CutMeshArrays,
  CutStats,
  MeasureArrays,
  MeshArrays,
  Outlines,
  PairCounts,
  Progress,
  ResolvedMeshArrays,
  TriangleGroups,
} from './results.js';
import type { Calls as BrickCalls } from './bricks/signatures.js';
import type { Calls as FileCalls } from './files/signatures.js';
import type { Calls } from './signatures.js';

export * from './results.js';

/**
 * A triangle mesh. The normal of triangle (a, b, c) is (b - a) x (c - a). It may be open, non-manifold, inconsistently oriented, unwelded,
 * and its triangles may meet anywhere.
 */
export interface Mesh {
  /** 3 per tri-vertex: x, y, z. */
  positions: Float64Array | Float32Array | readonly number[];
  /** 3 per triangle: tri-vertex ids. */
  triangles: Uint32Array | Uint16Array | Int32Array | readonly number[];
}

/** Three numbers, in an array or a typed array. */
export type Vector3 = ArrayLike<number>;

/**
 * A grid around the mesh's bounding box and a margin all around it: cubic cells, `cells` along the longest side and as many along the
 * others as cover it, centred.
 */
export interface GridAround {
  cells: number;
  /** In longest sides of the bounding box, from 0 to 1e6. Default 0.05. */
  margin?: number;
}
/** The box from `min` to `max` in `cells[d]` cells per axis: per axis, plane c lies at min + (max - min) * c / cells. */
export interface GridBox {
  min: Vector3;
  max: Vector3;
  cells: Vector3;
}
/** Plane c lies at origin + spacing * c. */
export interface GridRegular {
  origin: Vector3;
  spacing: Vector3;
  cells: Vector3;
}
/** Any ascending plane coordinates per axis, for graded grids. */
export interface GridRectilinear {
  planes: readonly [ArrayLike<number>, ArrayLike<number>, ArrayLike<number>];
}
/** A grid that is where it is, whatever the mesh. The `grid` of a result is one, too, and means exactly its planes. */
export type PlacedGrid = GridBox | GridRegular | GridRectilinear | Grid;
/** Which grid to cut with. */
export type GridInput = GridAround | PlacedGrid;

/** The grid of a result: grid cell (i, j, k) spans planes[0][i] .. planes[0][i + 1] and so on. */
export interface Grid {
  /** The lowest corner. */
  origin: [number, number, number];
  /** Size of a cell per axis, or null if the grid is not uniform. */
  spacing: [number, number, number] | null;
  /** Number of cells per axis. */
  cells: [number, number, number];
  /** Per axis the cells + 1 plane coordinates that every decision was made with. */
  planes: [Float64Array<ArrayBuffer>, Float64Array<ArrayBuffer>, Float64Array<ArrayBuffer>];
}

/** The stages of a cut, in order; prepare() does the first two. */
export type Stage = 'input' | 'intersections' | 'grid' | 'triEdges' | 'triFaces' | 'bricks' | 'regions' | 'output';

export interface RunOptions {
  /**
   * Called now and then. If it returns false, the call throws a MandolineError with code "cancelled"; what it throws itself, the call
   * throws, too.
   */
  progress?: (progress: Progress) => boolean | void;
}

/**
 * Stands for a result and all that it was made of: the numbers of the mesh, the planes of the grid, the options; 16 hexadecimal digits, the
 * same for the same input. Calls that take two results throw "badArgument" if these were not made from each other. Arrays from elsewhere
 * have none and are trusted to belong together; who changes arrays of a copy leaves it out.
 */
export type Fingerprint = string;

export interface IntersectionHandling extends RunOptions {
  /**
   * What to do where triangles meet other than in shared vertices and edges: "resolve" (default) cuts as if their exact arrangement had
   * been given; "refuse" throws "selfIntersection", naming the first pair and the number of all; "assumeNone" does not look, which is
   * quicker, but the result may be wrong where triangles do meet so.
   */
  intersections?: 'resolve' | 'refuse' | 'assumeNone';
}

export interface PrepareOptions extends IntersectionHandling {
  /**
   * Whether triangles are first turned so that they agree: closed parts outward, or inward where they lie inside an odd number of others,
   * as orient() does it. Default false.
   */
  orient?: boolean;
}

export interface Reusing {
  /**
   * Buffers that nobody needs any more, such as those under the arrays of a former result: the arrays of this one are written into them
   * where they fit, and into slightly larger new ones where not, so that cutting a surface that moves needs no new memory from one frame
   * to the next. Former results in them are lost. For a worker, list them in `transfer`, too.
   */
  reuse?: ArrayBuffer[];
}

/** `intersections` is not looked at for a mesh that prepare() gave: what prepare() was told holds. */
export interface CutOptions extends RecutOptions, RecutterOptions {}

/** How a mesh is cut, by a Recutter every time. */
export interface RecutterOptions extends Pick<IntersectionHandling, 'intersections'> {
  /** Tri-vertices within this distance of an axial plane (in cells, below 0.5) are moved onto it before cutting. Default 0. */
  snapTolerance?: number;
}

export interface Keeping {
  /**
   * Whether the module keeps a copy of the result, its twin, so that calls on the result need not read and check its arrays. Default true.
   * See CutMesh.
   */
  keep?: boolean;
}

/** What a cut gives. */
export interface RecutOptions extends RunOptions, Keeping, Reusing {
  /** Whether the result has `gridCellRegion`, which takes 4 bytes per grid cell; the runs say the same in less. Default true. */
  gridCellRegion?: boolean;
}

/**
 * Cuts meshes one after the other: an object of createRecutter(). Its state, all that the last cut was made of, is in the module's memory
 * until free() gives that back, `using` ends, or garbage is collected.
 */
export interface Recutter {
  /**
   * As cut(mesh, grid), to the bit; `stats.exactFallbacks` counts what was cut again. Everything is cut anew the first time, after an
   * error, when triangles, or vertices that share a position, have changed, when the largest coordinate has passed a power of two, and
   * while triangles without area are among them. With `keep: false` the memory of one result is that of the next.
   */
  cut(mesh: Mesh, options?: RecutOptions): CutMesh;
  /** Of the last cut. */
  counts(): RecutCounts;
  /** Gives its memory back. */
  free(): void;
  [Symbol.dispose](): void;
}

/** The grid is cut in bricks of a few cells along each side. */
export interface RecutCounts {
  /** That the surface touches. */
  bricks: number;
  /** Of these: not cut again. */
  kept: number;
}

export interface BrickCutterOptions extends IntersectionHandling {
  /** Grid cells along each side of a brick, fewer where the grid ends: a power of two up to 2^24. Default 128. */
  cells?: number;
  /** Whether bricks come, too, in which the surface touches no grid cell. Default false. */
  untouched?: boolean;
}

/** Cuts bricks, in any order: an object of createBrickCutter(), with its state in the module's memory, as that of Recutter. */
export interface BrickCutter {
  /** How many bricks there are: those that the surface comes near to, or with `untouched` all, by z, then y, then x. */
  count(): number;
  /** The lowest grid cell of a brick. Code "badArgument" if there is no such brick (`element`). */
  first(brick: number): [number, number, number];
  /** The piece may have no cut-cells. Errors as those of first() and cut(). */
  cut(brick: number, options?: PieceOptions): CutPiece;
  /** Gives its memory back. */
  free(): void;
  [Symbol.dispose](): void;
}

export interface PieceOptions extends RunOptions, Keeping {}

/**
 * What a cut has in one brick: the same cells as in the cut of the whole grid, to the bit, as a cut-mesh by itself. `cutMesh` was made from
 * `mesh`, so all that takes both takes these. (Of validate(), the check of winding numbers is for the whole: here they are those of the whole
 * mesh, which the triangles near a brick do not tell.) Cells on two sides of a seam between bricks have the same faces there, each in its
 * own cut-mesh.
 */
export interface CutPiece {
  /** The brick's lowest grid cell. Grid cells, planes and runs of `cutMesh` count from there; its grid has the planes of the brick. */
  first: [number, number, number];
  /** Its regions are those of the brick: one of the whole cut may be several here. */
  cutMesh: CutMeshArrays;
  /** The triangles near the brick, and those that these meet; welded. Coordinates are those of the whole mesh. */
  mesh: MeshArrays;
  /** Per triangle of `mesh` that of the whole mesh, ascending. */
  triangles: Uint32Array<ArrayBuffer>;
  /** Per tri-vertex of `mesh` that of the whole mesh (the lowest at its position), ascending. */
  triVertices: Uint32Array<ArrayBuffer>;
}

/**
 * The cut-mesh. Half-face = 2 * face + side; side 0: the face's normal points out of the cell, side 1: into it.
 *
 * The module keeps a twin of what cut() and readCutMesh() give, and calls of Mandoline that are given that same object work on the twin:
 * they don't read its arrays, so they also work when these were transferred elsewhere, and take no notice of what was written into them.
 * (The functions of mandoline-wasm/three do read the arrays.) A copy (`{ ...cutMesh }`, a clone, what another worker gave) is data of its
 * own, read and checked by every call. Twins go with their results when garbage is collected; those used longest ago also when there are
 * more than 16 of them, or more than 64 MB with room for one more as large as the latest, and all when the module runs out of memory. A
 * result whose twin is gone is read once more and then has one again. `cut(..., { keep: false })` keeps none. In a worker, twins are in its
 * thread, and the arrays are sent back to it only where the twin is gone.
 */
export interface CutMesh extends CutMeshArrays {
  /** Region of each grid cell, x fastest; -1 where cut-cells replace it: what the runs say, in a dense form. Absent if the options said so. */
  gridCellRegion?: Int32Array<ArrayBuffer>;
  stats: CutStats;
}

export interface IntersectionOptions extends RunOptions {
  /** How many pairs are listed; all are counted. Default 100,000. */
  maxPairs?: number;
}

/**
 * The exact arrangement of a mesh's triangles as triangles again: two of them meet in shared vertices and edges alone, up to the rounding
 * of vertices. It is a Mesh, too.
 */
export interface ResolvedMesh extends ResolvedMeshArrays {
  /** Pairs of these triangles that meet again because vertices were rounded, found exactly. Often there are none. */
  remaining: PairCounts;
  /** Its `intersections` are the pairs of the input. */
  stats: CutStats;
}

/**
 * Which winding numbers are inside of the solid. "positive": those above 0, so that parts that overlap are one, and inverted ones are
 * nothing; "nonZero": any but 0; "odd": where two parts overlap there is a hole.
 */
export type WindingRule = 'positive' | 'nonZero' | 'odd';

export interface InsideOptions {
  /** Default "positive". */
  rule?: WindingRule;
  /** Where there are estimates: they count as the winding number n from n - 1 + threshold on. Above 0, at most 1. Default 0.5. */
  threshold?: number;
}

export interface EstimateOptions extends RunOptions {
  /** As of InsideOptions. */
  threshold?: number;
}

export interface Measures extends MeasureArrays {
  /** Per region: its cut-cells and untouched grid cells together. */
  regionVolume: Float64Array<ArrayBuffer>;
}

/** Where a point in the grid lies. */
export interface Location {
  /** The cut-cell, or -1 in an untouched grid cell. */
  cell: number;
  gridCell: [number, number, number];
  region: number;
}

/** The plane normal . x = offset. The normal may have any length. */
export interface Plane {
  normal: Vector3;
  offset: number;
}

export interface DrawingOptions extends Reusing {
  /** Subtracted from positions before they are rounded to 32 bits; the middle of the grid's box is best. Default: 0, 0, 0. */
  origin?: Vector3;
}

export interface SliceOptions {
  /** Whether untouched grid cells are cut, too. Default true. */
  untouched?: boolean;
}

export interface WriteOutlinesOptions extends RunOptions {
  /** Per region whether it is written; default: all are. Of the surface, all that bounds the regions. Not for "json" and "mcm", which have all. */
  regions?: Uint8Array | readonly boolean[];
}
export interface WriteMeshOptions extends RunOptions {
  /** The groups of the triangles of the input, for files that have some. */
  groups?: TriangleGroups;
}
export interface WriteOptions extends WriteOutlinesOptions, WriteMeshOptions {
  /** Whether untouched grid cells are written to a "vtu". Default true. */
  untouched?: boolean;
  /**
   * Whether a "vtu" of cells, or a polyMesh, lacks the faces that have the same cell at both sides, where a sheet ends in it: VTK's filters
   * fail on these. Default false.
   */
  simpleCells?: boolean;
}

/** Outlines in parallel planes, for writeOutlines(). */
export interface OutlineStack {
  /** As given to outlines(). */
  normal: Vector3;
  offsets: ArrayLike<number>;
  /** What outlines() gave. */
  layers: readonly Outlines[];
}

/** Lines of any number of points, for writeLines(). */
export interface Polylines {
  /** 3 per point. */
  points: ArrayLike<number>;
  /** Into the points, per line. */
  offsets: Uint32Array;
}

export interface ReadMeshOptions {
  /** The name of the file, for its extension and for messages. Default: that of a File. */
  name?: string;
}

/**
 * Everything that works on meshes and cut-meshes; `init()` gives it. No call changes its arguments. Errors are MandolineErrors, except what
 * a progress callback throws.
 */
export interface Mandoline extends Calls, FileCalls, BrickCalls {
  /** Version of the library. */
  readonly version: string;
}

export interface InitOptions {
  /**
   * The module: where to load it from, its bytes, or the compiled module; or what gives or promises one of these. By default it is loaded
   * from beside the package's code.
   */
  wasm?: WasmSource | (() => WasmSource | Promise<WasmSource>);
  /** The same of the module that has validate(), the writers and some readers: files.wasm, loaded when one of these is first called. */
  filesWasm?: WasmSource | (() => WasmSource | Promise<WasmSource>);
  /** The same of the module of createRecutter(), createBrickCutter() and refineCells(): bricks.wasm, loaded when one of these is first called. */
  bricksWasm?: WasmSource | (() => WasmSource | Promise<WasmSource>);
}
export type WasmSource = URL | string | ArrayBuffer | ArrayBufferView | WasmModule;

/** WebAssembly.Module, which TypeScript knows where the types of browsers are included. */
export type WasmModule = typeof globalThis extends { WebAssembly: { Module: { prototype: infer Module } } } ? Module : object;

/**
 * Loads the WebAssembly module, once: every call gives the same promise, for any options. After a failure the next call tries again.
 */
export function init(options?: InitOptions): Promise<Mandoline>;

/** The compiled module of init(), which is called if it was not, as `wasm` for createWorker() or for init() in a worker of your own. */
export function compiledModule(): Promise<WasmModule>;

export type ErrorCode =
  /** The progress callback returned false, the signal was aborted, or the worker was terminated. */
  | 'cancelled'
  /** The mesh has no triangles. */
  | 'emptyMesh'
  /** The length of an array is not a multiple of 3. */
  | 'badArrays'
  /** `element`: the triangle that names a tri-vertex that does not exist. */
  | 'badIndex'
  /** `element`: the tri-vertex. */
  | 'nonFiniteCoordinate'
  /** No cells on an axis, or planes that do not ascend or are not finite (`element`: the axis), or a margin out of range. */
  | 'badGrid'
  /** More than 2^24 cells on an axis (`element`), or more than 2^28 rows of cells. */
  | 'gridTooLarge'
  /** A number is out of range: the message names it. */
  | 'badOption'
  /** `element`, `element2`: two triangles that meet other than in shared vertices and whole shared edges. */
  | 'selfIntersection'
  /** 2^31 or more triangles, vertices or corners of faces, in the mesh or in the result. */
  | 'meshTooLarge'
  | 'outOfMemory'
  /** A fault of this library, or a worker that died. */
  | 'internalError'
  /** An argument is not what the call takes: the message names it. `element`: a cell or region that does not exist, or the like. */
  | 'badArgument'
  /** A file can't be read as a mesh: the message says why and where. */
  | 'badFile'
  /** The WebAssembly module could not be loaded. */
  | 'loadFailed';

export class MandolineError extends Error {
  name: 'MandolineError';
  code: ErrorCode;
  /** The stage of the cut that failed, or the call if it was another. */
  stage: string;
  /** The offending element, of the kind that ErrorCode tells; -1 for none. */
  element: number;
  /** The other triangle of a selfIntersection, else -1. */
  element2: number;
}

/** What went wrong, where, and what to do about it, in a few sentences for people. Takes any value that was caught. */
export function describe(error: unknown): string;

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
import type { Calls } from './signatures.js';

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
/** Which grid to cut with. The `grid` of a result is one, too, and means exactly its planes. */
export type GridInput = GridAround | GridBox | GridRegular | GridRectilinear | Grid;

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

/** A mesh that a call gives: a copy, one of a file, a new one. It is a Mesh, too. */
export interface MeshArrays {
  /** 3 per vertex: x, y, z. */
  positions: Float64Array<ArrayBuffer>;
  /** 3 per triangle: vertex ids. */
  triangles: Uint32Array<ArrayBuffer>;
}

/** The stages of a cut, in order; prepare() does the first two. */
export type Stage =
  | 'input'
  | 'intersections'
  | 'grid'
  | 'triEdges'
  | 'triFaces'
  | 'stencil'
  | 'gridEdges'
  | 'gridFaces'
  | 'cutCells'
  | 'regions'
  | 'output';

/** How far a call has come: `done` of `total` items of the stage, and the stage's place among all. */
export interface Progress {
  /** Of a cut: a Stage. */
  stage: Stage | (string & {});
  stageIndex: number;
  stageCount: number;
  done: number;
  total: number;
}

export interface RunOptions {
  /**
   * Called now and then. If it returns false, the call throws a MandolineError with code "cancelled"; what it throws itself, the call
   * throws, too.
   */
  progress?: (progress: Progress) => boolean | void;
}

export interface ValidateOptions extends RunOptions {
  /** That of the cut. */
  snapTolerance?: number;
}

export interface PrepareOptions extends RunOptions {
  /**
   * What to do where triangles meet other than in shared vertices and edges: "resolve" (default) cuts as if their exact arrangement had
   * been given; "refuse" throws "selfIntersection", naming the first pair and the number of all; "assumeNone" does not look, which is
   * quicker, but the result may be wrong where triangles do meet so.
   */
  intersections?: 'resolve' | 'refuse' | 'assumeNone';
}

/** `intersections` is not looked at for a mesh that prepare() gave: what prepare() was told holds. */
export interface CutOptions extends PrepareOptions {
  /** Tri-vertices within this distance of an axial plane (in cells, below 0.5) are moved onto it before cutting. Default 0. */
  snapTolerance?: number;
  /** Whether the result has `gridCellRegion`, which takes 4 bytes per grid cell; the runs say the same in less. Default true. */
  gridCellRegion?: boolean;
  /**
   * Whether the module keeps a copy of the result, its twin, so that calls on the result need not read and check its arrays. Default true.
   * See CutMesh.
   */
  keep?: boolean;
}

/**
 * The cut-mesh. Half-face = 2 * face + side; side 0: the face's normal points out of the cell, side 1: into it.
 *
 * The module keeps a twin of what cut() gives, and calls of Mandoline that are given that same object work on the twin: they don't read its
 * arrays, so they also work when these were transferred elsewhere, and take no notice of what was written into them. (The functions of
 * mandoline-wasm/three do read the arrays.) A copy (`{ ...cutMesh }`, a clone, what another worker gave) is data of its own, read and
 * checked by every call. Twins go with their results when garbage is collected; those used longest ago also when there are more than 16 of
 * them or more than 256 MB, and all when the module runs out of memory. A result whose twin is gone is read once more and then has one
 * again. `cut(..., { keep: false })` keeps none. In a worker, twins are in its thread, and the arrays are sent back to it only where the
 * twin is gone.
 */
export interface CutMesh {
  grid: Grid;

  /** 3 per vertex. Output only: no decision reads them. */
  positions: Float64Array<ArrayBuffer>;
  /** 3 per vertex: the slab it lies in per axis, exact: 0..n-1, or n on the last plane. */
  vertexCell: Int32Array<ArrayBuffer>;
  /** Per vertex: bit d is set when it lies exactly on plane vertexCell[d] of axis d. */
  vertexMask: Uint8Array<ArrayBuffer>;
  /** Per vertex: the tri-vertex (lowest id at its position), or -1. */
  vertexTriVertex: Int32Array<ArrayBuffer>;
  /** 2 per vertex: tri-vertex (v, v); on a tri-edge its ends (a, b); in a triangle (t, -1); grid vertex (-1, -1). */
  vertexParents: Int32Array<ArrayBuffer>;

  /**
   * Made vertices, ascending: those that only exist because triangles meet other than in shared vertices and edges. Their vertexParents are
   * (-1, -1).
   */
  madeVertices: Uint32Array<ArrayBuffer>;
  /**
   * Per made vertex what meets there. 0: a tri-edge and a triangle; 1: two tri-edges; 2: three triangles; 3: two triangles and an axial
   * plane or several.
   */
  madeVertexKinds: Uint8Array<ArrayBuffer>;
  /** 4 per made vertex: these tri-edges, by their two tri-vertices, then triangles; the rest is -1. */
  madeVertexParents: Int32Array<ArrayBuffer>;

  /** Into loopVertices. */
  loopOffsets: Uint32Array<ArrayBuffer>;
  /** Vertex ids. */
  loopVertices: Uint32Array<ArrayBuffer>;
  /** Into loops, per face: the first is the outer loop, counter-clockwise about the face's normal; the others are holes, clockwise. */
  faceLoopOffsets: Uint32Array<ArrayBuffer>;
  /** Per face: the input triangle (its normal is the face's; the lowest, if there are several), or -1 for a piece of a grid-face. */
  faceTriangle: Int32Array<ArrayBuffer>;
  /** Into faceParents, per face. */
  faceParentOffsets: Uint32Array<ArrayBuffer>;
  /** All triangles that contain the face, ascending: several where they lie on each other. */
  faceParents: Uint32Array<ArrayBuffer>;
  /** Per parent: 1 if its normal is the face's, -1 if the opposite. Behind the face the winding number is higher by the face's sum. */
  faceParentSigns: Int8Array<ArrayBuffer>;
  /** Per face: 0..2 if it lies in an axial plane, else -1. A grid-face's normal is +axis. */
  faceAxis: Int8Array<ArrayBuffer>;
  /** Per face: index of that plane, else 0. */
  facePlane: Int32Array<ArrayBuffer>;

  /** Into cellHalfFaces, per cut-cell. */
  cellHalfFaceOffsets: Uint32Array<ArrayBuffer>;
  /** Half-faces: the outer shell's and those of cavities and floating sheets. */
  cellHalfFaces: Uint32Array<ArrayBuffer>;
  /** 3 per cut-cell: the grid cell it lies in. Cut-cells are in ascending order of grid cells, x fastest. */
  cellGridCell: Int32Array<ArrayBuffer>;
  /** Per cut-cell. */
  cellRegion: Uint32Array<ArrayBuffer>;

  /** Region of each grid cell, x fastest; -1 where cut-cells replace it. Absent if the options said so. */
  gridCellRegion?: Int32Array<ArrayBuffer>;
  /** The same as runs of untouched grid cells along x. Row r = k * ny + j has runs rowRunOffsets[r] .. rowRunOffsets[r + 1] - 1. */
  rowRunOffsets: Uint32Array<ArrayBuffer>;
  /** Per run: its first grid cell along x. */
  runBegin: Int32Array<ArrayBuffer>;
  /** Per run: one past the last. */
  runEnd: Int32Array<ArrayBuffer>;
  /** Per run. */
  runRegion: Uint32Array<ArrayBuffer>;

  /** Regions: connected components of cut-cells and untouched grid cells, joined through faces that are not pieces of triangles. */
  regionCount: number;
  /** Per region: +1 inside an outward oriented closed surface; null where the input is open or inconsistently oriented. */
  regionWinding: Int32Array<ArrayBuffer> | null;

  /** Of the input. */
  triangleCount: number;
  /** Ascending ids of triangles without a face: zero area, outside the grid. */
  droppedTriangles: Uint32Array<ArrayBuffer>;

  stats: CutStats;
}

export interface CutStats {
  /** Milliseconds per stage, in order. */
  stages: { stage: Stage; ms: number }[];
  totalMs: number;
  /** Signs that needed exact arithmetic. */
  exactFallbacks: number;
  /** Tri-vertices that share their position with a lower one. */
  weldedVertices: number;
  /** Dropped. */
  zeroAreaTriangles: number;
  /** Dropped. */
  outsideTriangles: number;
  /** With the same three vertices as a lower one. */
  duplicateTriangles: number;
  /** None with "assumeNone". */
  intersections: PairCounts;
  /** Connected curves along which others meet the insides of triangles. */
  intersectionCurves: number;
  /** See CutMesh. */
  madeVertices: number;
  /** Moved onto a plane by snapTolerance. */
  snappedVertices: number;
  /** Farthest such move, in cells. */
  largestSnap: number;
  /** Coordinates below 2^-200 of the largest, taken as 0. */
  flushedCoordinates: number;
}

/** How many pairs of triangles meet other than in shared vertices and whole shared edges, by how they do. */
export interface PairCounts {
  /** Along a segment that runs through both. */
  crossing: number;
  /** In a point, or along a segment on the outline of one. */
  touching: number;
  /** They lie in one plane and have an area in common. */
  overlapping: number;
  /** Overlapping, of triangles that share an edge. */
  folded: number;
  /** They have the same three vertices. CutStats.duplicateTriangles counts such triangles rather than pairs. */
  identical: number;
}

export interface IntersectionOptions extends RunOptions {
  /** How many pairs are listed; all are counted. Default 100,000. */
  maxPairs?: number;
}

/** The pairs of triangles that meet, exactly: the lowest ones, ascending, as many as were asked for. */
export interface MeshIntersections {
  /** Of all pairs. */
  counts: PairCounts;
  /** 2 per pair: the lower triangle first. */
  pairTriangles: Uint32Array<ArrayBuffer>;
  /** Per pair. 0: crossing, 1: touching, 2: overlapping, 3: folded, 4: identical; see PairCounts. */
  pairKinds: Uint8Array<ArrayBuffer>;
  /** Into positions (counted in points), per pair. */
  pairPointOffsets: Uint32Array<ArrayBuffer>;
  /**
   * 3 per point, rounded. What the two have in common: a point, the ends of a segment, or the corners of a convex polygon,
   * counter-clockwise about the normal of the first.
   */
  positions: Float64Array<ArrayBuffer>;
}

/**
 * The exact arrangement of a mesh's triangles as triangles again: two of them meet in shared vertices and edges alone, up to the rounding
 * of vertices. It is a Mesh, too.
 */
export interface ResolvedMesh extends MeshArrays {
  /**
   * Per vertex: the tri-vertex of the input (lowest id at its position), which is not moved; or -1 for a made one, which is rounded once.
   */
  vertexTriVertex: Int32Array<ArrayBuffer>;
  /** Into parents, per triangle. */
  parentOffsets: Uint32Array<ArrayBuffer>;
  /**
   * The triangles of the input that contain the triangle, ascending: several where they lie on each other. Its normal is that of the first.
   */
  parents: Uint32Array<ArrayBuffer>;
  /** Per parent: 1 if its normal is the triangle's, -1 if it is the opposite. */
  parentSigns: Int8Array<ArrayBuffer>;
  /** Per triangle: the winding number on the side of its normal; null where the input is open or inconsistently oriented. */
  frontWinding: Int32Array<ArrayBuffer> | null;
  /** The same behind it. */
  backWinding: Int32Array<ArrayBuffer> | null;
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

export interface Measures {
  /** Per face. */
  faceArea: Float64Array<ArrayBuffer>;
  /** 3 per face, unit. */
  faceNormal: Float64Array<ArrayBuffer>;
  /** 3 per face. */
  faceCentroid: Float64Array<ArrayBuffer>;
  /** Per cut-cell. */
  cellVolume: Float64Array<ArrayBuffer>;
  /** 3 per cut-cell. */
  cellCentroid: Float64Array<ArrayBuffer>;
  /** Per region: its cut-cells and untouched grid cells together. */
  regionVolume: Float64Array<ArrayBuffer>;
}

/** Unique undirected cut-edges, lower vertex id first, ascending. */
export interface CutEdges {
  /** 2 per edge. */
  edgeVertices: Uint32Array<ArrayBuffer>;
  /** Per edge. */
  edgeLength: Float64Array<ArrayBuffer>;
}

export interface Adjacency {
  /** 2 per face: the cut-cell of side 0 and of side 1, or -1. */
  faceCells: Int32Array<ArrayBuffer>;
  /** 2 per face, the same: the untouched grid cell i + nx (j + ny k); -1 for a cut-cell and where the grid ends. */
  faceGridCells: Float64Array<ArrayBuffer>;
  /** Into cellCells, per cut-cell. */
  cellCellOffsets: Uint32Array<ArrayBuffer>;
  /** Neighbouring cut-cells of each cut-cell across any face, ascending, without repeats. */
  cellCells: Uint32Array<ArrayBuffer>;
}

/** Triangles of every face. No vertices are added, and both cells of a face use the same triangles, so neighbours match. */
export interface FaceTriangles {
  /** Into triangles (counted in triangles), per face. */
  faceTriangleOffsets: Uint32Array<ArrayBuffer>;
  /** 3 vertex ids per triangle, counter-clockwise about the face's normal. */
  triangles: Uint32Array<ArrayBuffer>;
}

export interface Check {
  /** For example "surfaceArea". */
  name: string;
  /** True also if skipped. */
  pass: boolean;
  /** Whether it does not apply to this input, as winding numbers do not to an open mesh. */
  skipped: boolean;
  /**
   * The number of violations; or, where `tolerance` is above 0, the largest deviation in roundings (half units in the last place of the
   * largest coordinate), NaN if it can't be computed.
   */
  worst: number;
  /** The largest `worst` that passes. */
  tolerance: number;
  /** What the worst deviation was found at: "cell", "face", "triangle", ...; empty if nothing. */
  elementKind: string;
  /** Its id, or -1. */
  element: number;
  /** What is wrong, why it was skipped, or what was left out; may be empty. */
  message: string;
}

export interface Validation {
  pass: boolean;
  checks: Check[];
}

/** Where points lie. One that is not finite lies outside the grid. */
export interface Locations {
  /** Per point: the cut-cell that holds it, or -1 in an untouched grid cell, or outside the grid. */
  cell: Int32Array<ArrayBuffer>;
  /** 3 per point: the grid cell, or -1, -1, -1 outside the grid. */
  gridCell: Int32Array<ArrayBuffer>;
  /** Per point: the region, or -1 outside the grid. */
  region: Int32Array<ArrayBuffer>;
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

/**
 * A filled cross-section of the cut-mesh: the polygons in which a plane cuts the cells, those of the cut-cells first. A cell may have
 * several. Where a sheet ends within a cell, a loop runs along it, there and back. Points are shared by the polygons of neighbouring
 * cut-cells.
 */
export interface Slice {
  /** 3 per point, on the plane. */
  positions: Float64Array<ArrayBuffer>;
  /** Into loopPoints. */
  loopOffsets: Uint32Array<ArrayBuffer>;
  /** Points of the loops. */
  loopPoints: Uint32Array<ArrayBuffer>;
  /** Into loops, per polygon: the first is the outer loop, counter-clockwise about the plane's normal; the others are holes, clockwise. */
  polygonLoopOffsets: Uint32Array<ArrayBuffer>;
  /** Per polygon: the cut-cell that it is a cut of, or -1 for an untouched grid cell. */
  polygonCell: Int32Array<ArrayBuffer>;
  /** 3 per polygon: the grid cell. */
  polygonGridCell: Int32Array<ArrayBuffer>;
  /** Per polygon. */
  polygonRegion: Uint32Array<ArrayBuffer>;
  /** Into triangles (counted in triangles), per polygon. */
  polygonTriangleOffsets: Uint32Array<ArrayBuffer>;
  /** 3 points per triangle, counter-clockwise about the plane's normal. */
  triangles: Uint32Array<ArrayBuffer>;
}

/**
 * The outlines of regions in a plane: each region's polygons of a slice as one, without the seams between cells. Where the surface has one
 * region on both sides (an open sheet), it is a slit: a polyline, with the triangles' normals to its right, that ends in its first point if
 * it is closed. Points are shared by the outlines of neighbouring regions.
 */
export interface Outlines {
  /** 3 per point, on the plane. */
  positions: Float64Array<ArrayBuffer>;
  /** Into loopPoints. */
  loopOffsets: Uint32Array<ArrayBuffer>;
  /** Points of the loops. */
  loopPoints: Uint32Array<ArrayBuffer>;
  /** Into loops, per polygon: the first is the outer loop, counter-clockwise about the plane's normal; the others are holes, clockwise. */
  polygonLoopOffsets: Uint32Array<ArrayBuffer>;
  /** Per polygon, ascending. */
  polygonRegion: Uint32Array<ArrayBuffer>;
  /** Into slitPoints. */
  slitOffsets: Uint32Array<ArrayBuffer>;
  /** Points of the slits. */
  slitPoints: Uint32Array<ArrayBuffer>;
  /** Per slit: the region around it, ascending. */
  slitRegion: Uint32Array<ArrayBuffer>;
}

export interface SliceOptions {
  /** Whether untouched grid cells are cut, too. Default true. */
  untouched?: boolean;
}

export interface WriteOptions extends RunOptions {
  /** Whether untouched grid cells are written to a "vtu". Default true. */
  untouched?: boolean;
  /** Per region whether it is written to a "vtu" or "obj"; default: all are. An "obj" then has all that bounds the regions. */
  regions?: Uint8Array | readonly boolean[];
}

export interface ReadMeshOptions {
  /** The name of the file, for its extension and for messages. Default: that of a File. */
  name?: string;
}

/**
 * Everything that works on meshes and cut-meshes; `init()` gives it. No call changes its arguments. Errors are MandolineErrors, except what
 * a progress callback throws.
 */
export interface Mandoline extends Calls {
  /** Version of the library. */
  readonly version: string;
}

export interface InitOptions {
  /**
   * The module: where to load it from, its bytes, or the compiled module; or what gives or promises one of these. By default it is loaded
   * from beside the package's code.
   */
  wasm?: WasmSource | (() => WasmSource | Promise<WasmSource>);
}
export type WasmSource = URL | string | ArrayBuffer | ArrayBufferView | WasmModule;

/** WebAssembly.Module, which TypeScript knows where the types of browsers are included. */
export type WasmModule = typeof globalThis extends { WebAssembly: { Module: { prototype: infer Module } } } ? Module : object;

/**
 * Loads the WebAssembly module, once: every call gives the same promise, whatever its options. After a failure the next call tries again.
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

/** What went wrong, where, and what to do about it, in a few sentences for people. Takes whatever was caught. */
export function describe(error: unknown): string;

/**
 * Mandoline: cuts a triangle mesh with a Cartesian grid into polyhedral cut-cells.
 *
 * ```js
 * import { init } from 'mandoline-wasm';
 * const { cut } = await init();
 * const cutMesh = cut({ positions, triangles }, { cells: 32 });
 * ```
 *
 * All arrays are flat, all ids count from 0, and every offsets array starts with 0 and has one more entry than there are items. Lengths are in
 * world units unless "cells" is said. Results are plain objects of typed arrays that own their memory: keep, clone or transfer them, there is
 * nothing to delete. The names are those of the C++ library and of its JSON dump.
 */

/** A triangle mesh. The normal of triangle (a, b, c) is (b - a) x (c - a). It may be open, non-manifold, inconsistently oriented, unwelded. */
export interface Mesh {
  /** 3 per tri-vertex: x, y, z. */
  positions: Float64Array | Float32Array | readonly number[];
  /** 3 per triangle: tri-vertex ids. */
  triangles: Uint32Array | Uint16Array | Int32Array | readonly number[];
}

export type Vector3 = readonly [number, number, number];

/** A grid around the mesh: cubic cells of size 1.1 x longest side of its bounding box / `cells`, as many per axis as cover the box with that margin, centred. */
export interface GridAround {
  cells: number;
}
/** The box from `min` to `max` in `cells[d]` cells per axis: plane c lies at min + (max - min) * c / n. */
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
  origin: [number, number, number];
  /** Size of a cell per axis, or null if the grid is not uniform. */
  spacing: [number, number, number] | null;
  /** Number of cells per axis. */
  cells: [number, number, number];
  /** Per axis the cells + 1 plane coordinates that every decision was made with. */
  planes: [Float64Array<ArrayBuffer>, Float64Array<ArrayBuffer>, Float64Array<ArrayBuffer>];
}

export type Stage = 'input' | 'triEdges' | 'triFaces' | 'stencil' | 'gridEdges' | 'gridFaces' | 'cutCells' | 'regions' | 'output';

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
  /** Called now and then; returning false cancels the call, which then throws a MandolineError with code "cancelled". */
  progress?: (progress: Progress) => boolean | void;
}

export interface ValidateOptions extends RunOptions {
  /** That of the cut. */
  snapTolerance?: number;
}

export interface CutOptions extends RunOptions {
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
 * The module keeps a twin of what cut() gives, and calls that are given that same object work on the twin: they don't read its arrays, so
 * they also work when these were transferred elsewhere, and take no notice of what was written into them. A copy (`{ ...cutMesh }`, a clone,
 * what another worker gave) is data of its own, read and checked by every call. Twins go with their results when garbage is collected;
 * those used longest ago also when there are more than 16 of them or more than 256 MB, and all when the module runs out of memory. A
 * result whose twin is gone is read once more and then has one again. `cut(..., { keep: false })` keeps none.
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

  /** Into loopVertices. */
  loopOffsets: Uint32Array<ArrayBuffer>;
  /** Vertex ids. */
  loopVertices: Uint32Array<ArrayBuffer>;
  /** Into loops, per face: the first is the outer loop, counter-clockwise about the face's normal; the others are holes, clockwise. */
  faceLoopOffsets: Uint32Array<ArrayBuffer>;
  /** Per face: the input triangle (its normal is the face's), or -1 for a piece of a grid-face. */
  faceTriangle: Int32Array<ArrayBuffer>;
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
  /** Ascending ids of triangles without a face: zero area, duplicate, outside the grid. */
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
  zeroAreaTriangles: number;
  duplicateTriangles: number;
  outsideTriangles: number;
  /** Moved onto a plane by snapTolerance. */
  snappedVertices: number;
  /** Farthest such move, in cells. */
  largestSnap: number;
  /** Coordinates below 2^-200 of the largest, taken as 0. */
  flushedCoordinates: number;
}

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
  /** 2 per face: where faceCells is -1, the untouched grid cell i + nx (j + ny k), or -1 where the grid ends. */
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
  pass: boolean;
  /** Does not apply to this input, as winding numbers to an open mesh. */
  skipped: boolean;
  /** Largest deviation found: in roundings (half units in the last place of the largest coordinate), or a number of violations. */
  worst: number;
  /** What it may be. */
  tolerance: number;
  /** "cell", "face", "triangle", ... of the worst deviation; empty if none. */
  elementKind: string;
  element: number;
  /** Why it fails, or what was left out; may be empty. */
  message: string;
}

export interface Validation {
  pass: boolean;
  checks: Check[];
}

/** Where points lie, per point. */
export interface Locations {
  /** The cut-cell that holds the point, or -1 in an untouched grid cell, or outside the grid. */
  cell: Int32Array<ArrayBuffer>;
  /** 3 per point: the grid cell, or -1, -1, -1 outside the grid. */
  gridCell: Int32Array<ArrayBuffer>;
  /** The region, or -1 outside the grid. */
  region: Int32Array<ArrayBuffer>;
}

export interface Location {
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
 * A filled cross-section of the cut-mesh: the polygons in which a plane cuts the cells, those of the cut-cells first. A cell may have several.
 * Where a sheet ends within a cell, a loop runs along it forth and back. Points are shared by the polygons of neighbouring cut-cells.
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

export interface ReadMeshOptions {
  /** The name of the file, for its extension and for messages. Default: that of a File. */
  name?: string;
}

/** A mesh as it was in a file. */
export interface FileMesh {
  positions: Float64Array<ArrayBuffer>;
  triangles: Uint32Array<ArrayBuffer>;
}

/** Everything that works on meshes and cut-meshes; `init()` gives it. No call keeps or changes its arguments; errors are MandolineErrors. */
export interface Mandoline {
  /** Version of the library. */
  readonly version: string;
  /** Cuts the mesh with the grid (the paper's Algorithm 1). */
  cut(mesh: Mesh, grid: GridInput, options?: CutOptions): CutMesh;
  /** The paper's four checks (5.6) and the invariants of a cut-mesh, worked out from its arrays alone. `mesh` is the input, `snapTolerance` that of the cut. */
  validate(mesh: Mesh, cutMesh: CutMesh, options?: ValidateOptions): Validation;
  /** Areas, normals, centroids and volumes. `mesh` is the input of the cut. */
  measure(mesh: Mesh, cutMesh: CutMesh, options?: RunOptions): Measures;
  /** The cut-edges with their lengths. */
  cutEdges(mesh: Mesh, cutMesh: CutMesh): CutEdges;
  /** Who lies beside whom. */
  adjacency(cutMesh: CutMesh): Adjacency;
  /** Triangles of all faces. */
  triangulate(cutMesh: CutMesh): FaceTriangles;
  /**
   * The closed surface of one cut-cell, oriented outward; or the pieces of triangles that bound a region, oriented out of it, both
   * sides of those where a sheet ends within the region. 3 vertex ids per triangle.
   */
  triangulate(cutMesh: CutMesh, of: { cell: number } | { region: number }): Uint32Array<ArrayBuffer>;
  /** Which cell holds this point; null outside the grid. A point on a face counts to one of the cells beside it. */
  cellAt(cutMesh: CutMesh, point: Vector3): Location | null;
  /** Which cell holds each point (3 coordinates per point): one call for many points is far faster than many calls. */
  cellsAt(cutMesh: CutMesh, points: Float64Array | Float32Array | readonly number[]): Locations;
  /** The polygons in which a plane cuts the cells. */
  slice(cutMesh: CutMesh, plane: Plane, options?: SliceOptions): Slice;
  /** The slices of the planes normal . x = offset, in the order of the offsets, for less than many calls of slice() cost. */
  slices(cutMesh: CutMesh, normal: Vector3, offsets: Float64Array | Float32Array | readonly number[], options?: SliceOptions): Slice[];
  /** The outlines of the regions in such planes, as slicers need them. */
  outlines(cutMesh: CutMesh, normal: Vector3, offsets: Float64Array | Float32Array | readonly number[]): Outlines[];
  /** A file: "json" is the dump of all arrays, "vtu" polyhedra for VTK and ParaView, "obj" the cut surface by region. */
  write(mesh: Mesh, cutMesh: CutMesh, format: 'json' | 'vtu' | 'obj'): Uint8Array<ArrayBuffer>;
  /**
   * The mesh in a file: OBJ, STL, PLY or OFF (STL and PLY in text or binary), each also gzipped, told by content and then by the extension of
   * the name. Polygons are fanned from their first vertex; triangles are in the order of the file. Code "badFile" if it can't be read; the
   * message names the file and the line.
   */
  readMesh(source: Blob | ArrayBuffer | ArrayBufferView, options?: ReadMeshOptions): Promise<FileMesh>;
}

export interface InitOptions {
  /**
   * The module: where to load it from, its bytes, or the compiled module; or what gives or promises one of these. By default it is loaded from
   * beside the package's code.
   */
  wasm?: WasmSource | (() => WasmSource | Promise<WasmSource>);
}
export type WasmSource = URL | string | ArrayBuffer | ArrayBufferView | WasmModule;

/** WebAssembly.Module, which TypeScript knows where the types of browsers are included. */
export type WasmModule = typeof globalThis extends { WebAssembly: { Module: { prototype: infer Module } } } ? Module : object;

/** Loads the WebAssembly module, once: every call gives the same promise, whatever its options. After a failure the next call tries again. */
export function init(options?: InitOptions): Promise<Mandoline>;

/** The compiled module that init() used, to hand to init() in a worker of your own, or to createWorker(). */
export function compiledModule(): Promise<WasmModule>;

export type ErrorCode =
  | 'cancelled'
  | 'emptyMesh'
  | 'badArrays'
  | 'badIndex'
  | 'nonFiniteCoordinate'
  | 'badGrid'
  | 'gridTooLarge'
  | 'badOption'
  | 'selfIntersection'
  | 'meshTooLarge'
  | 'outOfMemory'
  | 'internalError'
  /** An argument is not of the kind that the call takes: the message names it. */
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
  /** The offending element; what it is depends on the code: a triangle, a tri-vertex, an axis. -1 for none. */
  element: number;
  /** The other triangle of a selfIntersection, else -1. */
  element2: number;
}

/** What went wrong, where, and what to do about it, in a few sentences for people. Takes whatever was caught. */
export function describe(error: unknown): string;

/**
 * Computing on the cells: octree cells away from the surface, all cells as one conforming mesh, discrete operators, Poisson's equation,
 * potential flow and its streamlines (paper, 5.3 and appendix B). A WebAssembly module of its own, loaded by initPhysics().
 *
 * ```js
 * import { init } from 'mandoline-wasm';
 * import { initPhysics } from 'mandoline-wasm/physics';
 * const [{ cut }, { boundaryOf, cellComplex, solvePoisson }] = await Promise.all([init(), initPhysics()]);
 * const cells = cellComplex(mesh, cut(mesh, { cells: 32 }));
 * const { phi } = solvePoisson(cells, { boundary: boundaryOf(cells, { xMin: { dirichlet: 0 }, xMax: { dirichlet: 1 } }) });
 * ```
 *
 * Arrays and calls have the names that they have in the C++ library, and like in index.d.ts all arrays are flat, all ids count from 0, and
 * every offsets array starts with 0 and has one more entry than there are items.
 *
 * The module keeps a twin of what cellComplex(), mergeSmallCells(), uniteWalls(), subComplex() and regionComplex() give, and of cut-meshes
 * that cut() gave, as is told at CutMesh: calls that are given that same object neither copy nor check its arrays, and take no notice of
 * what was written into them.
 */
import type { CutMesh, Mesh, RunOptions, TriangleGroups, WasmSource, WriteOptions } from '../index.js';
import type { Boundary, CellComplex, FaceTag, Flow } from './results.js';
import type { Calls } from './signatures.js';

export { type Fingerprint, MandolineError, type TriangleGroups, describe } from '../index.js';
export * from './results.js';

/** What a face is part of, by its `faceTag`: faceTags[cells.faceTag[f]]. */
export const faceTags: readonly ['xMin', 'xMax', 'yMin', 'yMax', 'zMin', 'zMax', 'inner', 'surface'];

export interface CoarsenOptions extends RunOptions {
  /** Octree cells have at most 2^maxLevel grid cells on a side; 0 merges nothing. Default 24. */
  maxLevel?: number;
  /** How many layers of grid cells around each cut one, diagonally too, are not merged. Default 0. */
  fineLayers?: number;
  /** How many layers of cells of each level above 0 lie at least, diagonally too, between smaller and larger ones. Default 0. */
  layersPerLevel?: number;
  /** Whether cells that share only an edge also differ by at most one level. Default false. */
  balanceEdges?: boolean;
}

export interface MergeOptions extends RunOptions {
  /** Of its grid cell's volume: cells below it are small. 0 to 0.5; at 0 none is. Default 0.2. */
  fraction?: number;
}

export interface WallOptions extends RunOptions {
  /** In degrees: how far normals may be from that of the first piece. Default 30. */
  angle?: number;
  /** Pieces of different groups stay apart. */
  groups?: TriangleGroups | null;
}

/** A sparse matrix by rows (CSR): row r has entries rowOffsets[r] .. rowOffsets[r + 1] - 1. */
export interface SparseMatrix {
  /** Number of rows. */
  rows: number;
  /** Number of columns. */
  columns: number;
  /** Into the entries, per row. */
  rowOffsets: Uint32Array<ArrayBuffer>;
  /** Per entry: its column, ascending in each row. */
  entryColumns: Uint32Array<ArrayBuffer>;
  /** Per entry. */
  entryValues: Float64Array<ArrayBuffer>;
}

/**
 * Where a cell's value lies. "centres": at cellCentre (Azevedo et al. 2016; appendix B); the line between two such points is normal to the
 * face that the cells share, so fluxes of linear fields are exact. "centroids": at cellCentroid; beside cut-cells the line is slanted,
 * which leaves an error of first order.
 */
export type DualPoints = 'centres' | 'centroids';

/**
 * Discrete operators; rows and columns are the ids of cells, faces, edges and vertices. A field u on faces has a value per face, its mean
 * component along the face's normal, which points from the cell on side 0 to that on side 1; phi on cells has a value per cell, that at its
 * dual point. Fluxes pass only through faces of tag inner that have two cells: the two sides of a sheet never meet in a row.
 */
export interface Operators {
  /** Cells x faces: 1 if the face's normal points out of the cell, -1 if into it; none for a face with the cell on both sides. */
  cellFaceIncidence: SparseMatrix;
  /**
   * Faces x edges: 1 if the face is on the left of the edge that runs from its lower to its higher vertex, seen against the face's normal;
   * -1 if on the right; none for an edge with the face on both sides.
   */
  faceEdgeIncidence: SparseMatrix;
  /** Edges x vertices: -1 for the lower vertex, 1 for the higher. The product of one incidence with the next is zero to the bit. */
  edgeVertexIncidence: SparseMatrix;
  /**
   * Faces x cells: phi to its derivative along the face's normal. Where one cell meets smaller ones, the other value is the mean of theirs
   * by area, for each of these faces, so that linear fields are exact there, too. Rows of other faces, the boundary's, are empty.
   */
  gradient: SparseMatrix;
  /** Cells x faces: u to what flows out of the cell, the integral of its divergence: incidence times area. */
  divergence: SparseMatrix;
  /** Cells x cells: divergence * gradient; symmetric, rows have the sum zero, negative semidefinite. */
  laplacian: SparseMatrix;
  /** Cells x cells, diagonal: volumes. */
  cellMass: SparseMatrix;
  /** Faces x faces, diagonal: area over distance of the dual points, the Hodge star; 0 for faces without a dual edge. */
  faceStar: SparseMatrix;
  /** Faces x faces, diagonal: area times distance of the dual points, the mass matrix of u; 0 for faces without a dual edge. */
  faceMass: SparseMatrix;
}

export type OperatorNames = readonly (keyof Operators)[];

export interface OperatorOptions<Names extends OperatorNames | undefined = OperatorNames> {
  /** Which operators to give. Default: all. */
  only?: Names;
  /** Of gradient, laplacian, faceStar and faceMass. Default "centres". */
  dualPoints?: DualPoints;
}

/** Those that `only` names: of an array that is not written out as a literal, any may be left out. */
export type ChosenOperators<Names extends OperatorNames | undefined> = Names extends OperatorNames
  ? number extends Names['length']
    ? Partial<Operators>
    : Pick<Operators, Names[number]>
  : Operators;

/** What holds on all faces of a tag: one of the two. */
export type Condition = { readonly dirichlet: number; readonly neumann?: never } | { readonly neumann: number; readonly dirichlet?: never };
export type Conditions = { readonly [Tag in FaceTag]?: Condition };

/** Poisson's equation div grad phi = s. */
export interface PoissonProblem {
  /** Default: that of boundaryOf(cells), where nothing passes. */
  boundary?: Boundary;
  /** Per cell: the mean of s in it, e.g. s at its centroid. Default: 0. */
  source?: ArrayLike<number>;
  /** Default "centres". */
  dualPoints?: DualPoints;
}

export interface FlowOptions extends RunOptions {
  /** Of the residual, relative to the right side, both in the Euclidean norm. Default 1e-10. */
  tolerance?: number;
  /** Default 500. */
  maxIterations?: number;
}

export interface SolveOptions extends FlowOptions {
  /**
   * What makes phi unique in a component without a Dirichlet condition. "zeroMean" (default): it has the mean zero by volume; "pinned": it
   * is zero in the component's first cell.
   */
  freeConstant?: 'zeroMean' | 'pinned';
  /**
   * In a component without a Dirichlet condition sources and what flows in have to cancel. False (default): they have to cancel up to
   * rounding; otherwise the data are incompatible. True: the excess is subtracted, evenly by volume.
   */
  balance?: boolean;
}

/** A flow and what it was solved on. */
export interface FlowField {
  /** That the cut-mesh was made from. */
  mesh: Mesh;
  cutMesh: CutMesh;
  /** All of the cut-mesh's: what cellComplex() gives. */
  cells: CellComplex;
  /** What solveFlow() gives for these cells; its wind, cellVelocity and cellGradient are read. */
  flow: Pick<Flow, 'wind' | 'cellVelocity' | 'cellGradient'>;
}

export interface StreamlineOptions extends RunOptions {
  /** Against the flow. Default false. */
  upstream?: boolean;
  /** Of a step and of its chord, relative to the size of its cell. Default 1e-3. */
  tolerance?: number;
  /** Of a line, world units. Default: any. */
  maxLength?: number;
  /** Of a line. Default 10,000. */
  maxPoints?: number;
}

/** Where a streamline ends, by its `ends`: streamlineEnds[lines.ends[l]]. */
export const streamlineEnds: readonly ['side', 'surface', 'rest', 'maxLength', 'maxPoints', 'outside'];

/** Which cells are written to a polyMesh or a "vtu", and the groups of the triangles. */
export type WritePolyMeshOptions = WriteOptions;
export interface WriteCellsOptions extends WritePolyMeshOptions {
  /** Per name 1 or 3 numbers for each cell, or for each face. Names have neither control characters nor < > & ". */
  fields?: { readonly [name: string]: ArrayLike<number> };
}

/** The files of a polyMesh by their names. */
export interface PolyMeshFiles {
  points: Uint8Array<ArrayBuffer>;
  faces: Uint8Array<ArrayBuffer>;
  owner: Uint8Array<ArrayBuffer>;
  neighbour: Uint8Array<ArrayBuffer>;
  boundary: Uint8Array<ArrayBuffer>;
  /** If there are cells of several regions. */
  cellZones?: Uint8Array<ArrayBuffer>;
}

/** What `initPhysics()` gives. No call changes its arguments. Errors are MandolineErrors, except what a progress callback throws. */
export interface Physics extends Calls {
  /** Version of the library. */
  readonly version: string;
}

export interface PhysicsOptions {
  /** The module, as in InitOptions. By default it is loaded from beside the package's code. */
  physicsWasm?: WasmSource | (() => WasmSource | Promise<WasmSource>);
}

/**
 * Loads the WebAssembly module, once: every call gives the same promise, for any options. After a failure the next call tries again.
 */
export function initPhysics(options?: PhysicsOptions): Promise<Physics>;

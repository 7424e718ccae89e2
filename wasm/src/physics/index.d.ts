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
 */
import type { CutMesh, Mesh, RunOptions, WasmSource } from '../index.js';
import type { Calls } from './signatures.js';

export { MandolineError, describe } from '../index.js';

/** What a face is part of, by its `faceTag`: faceTags[cells.faceTag[f]]. */
export const faceTags: readonly ['xMin', 'xMax', 'yMin', 'yMax', 'zMin', 'zMax', 'inner', 'surface'];
export type FaceTag = (typeof faceTags)[number];

export interface CoarsenOptions extends RunOptions {
  /** Octree cells have at most 2^maxLevel grid cells on a side; 0 merges nothing. Default 24. */
  maxLevel?: number;
  /** How many layers of grid cells around each cut one, diagonally too, are not merged. Default 0. */
  fineLayers?: number;
  /** Whether cells that share only an edge also differ by at most one level. Default false. */
  balanceEdges?: boolean;
}

/**
 * The cells that replace the untouched grid cells. One of level L is a block of 2^L grid cells on a side that begins at multiples of 2^L,
 * or the part of it inside the grid. Cells that share a part of a face differ by at most one level, a cut grid cell counting as one of
 * level 0. In Morton order: x changes fastest, then y, then z, at each level.
 */
export interface OctreeCells {
  /** Number of grid cells per axis. */
  gridCells: [number, number, number];
  /** 3 per octree cell: its lowest grid cell. */
  cellCorner: Int32Array<ArrayBuffer>;
  /** Per octree cell. */
  cellLevel: Uint8Array<ArrayBuffer>;
  /** Per octree cell: region of the cut-mesh. */
  cellRegion: Uint32Array<ArrayBuffer>;
}

/**
 * All cells, with every face between two of them or on the boundary once. Where a large cell meets smaller ones, its side is divided like
 * theirs, and the edges of a face have all vertices that lie on them. The cut-mesh's vertices, faces and cells come first and keep their
 * ids; then come those of the octree cells: cell cutCells + c is octree cell c. Half-face = 2 * face + side; side 0: the face's normal
 * points out of the cell, side 1: into it.
 *
 * The module keeps a twin of what cellComplex(), subComplex() and regionComplex() give, and of cut-meshes that cut() gave, as is told at
 * CutMesh: calls that are given that same object neither copy nor check its arrays, and take no notice of what was written into them.
 */
export interface CellComplex {
  /** How many of the vertices are the cut-mesh's. */
  cutVertices: number;
  /** How many of the faces. */
  cutFaces: number;
  /** How many of the cells. */
  cutCells: number;

  /** 3 per vertex, world units. */
  positions: Float64Array<ArrayBuffer>;

  /** Into loopVertices. */
  loopOffsets: Uint32Array<ArrayBuffer>;
  /** Vertex ids. */
  loopVertices: Uint32Array<ArrayBuffer>;
  /** Into loops, per face: the first is the outer loop, counter-clockwise about the face's normal; the others are holes, clockwise. */
  faceLoopOffsets: Uint32Array<ArrayBuffer>;

  /** 2 per face: the cell on side 0 and that on side 1; -1 outside the grid. */
  faceCells: Int32Array<ArrayBuffer>;
  /**
   * Per face: its number in `faceTags`. 0 to 5: a side of the grid; 6: inner, a face between two cells, or one that a sub-mesh was cut off
   * at; 7: a triangle of the input, which separates two cells or two sides of one, also where it lies in a side of the grid.
   */
  faceTag: Uint8Array<ArrayBuffer>;
  /** Per face. */
  faceArea: Float64Array<ArrayBuffer>;
  /** 3 per face, unit. */
  faceNormal: Float64Array<ArrayBuffer>;
  /** 3 per face. */
  faceCentroid: Float64Array<ArrayBuffer>;

  /** Into cellHalfFaces, per cell. */
  cellHalfFaceOffsets: Uint32Array<ArrayBuffer>;
  /** Half-faces, ascending. */
  cellHalfFaces: Uint32Array<ArrayBuffer>;
  /** 3 per cell: its grid cell, the lowest one of an octree cell. */
  cellCorner: Int32Array<ArrayBuffer>;
  /** Per cell: as in OctreeCells, 0 for a cut-cell. */
  cellLevel: Uint8Array<ArrayBuffer>;
  /** 3 per cell: the middle of its grid cell or octree cell, which may lie outside a cut-cell. */
  cellCentre: Float64Array<ArrayBuffer>;
  /** Per cell: region of the cut-mesh. */
  cellRegion: Uint32Array<ArrayBuffer>;
  /** Per cell. */
  cellVolume: Float64Array<ArrayBuffer>;
  /** 3 per cell. */
  cellCentroid: Float64Array<ArrayBuffer>;
}

/**
 * Some cells of a cell complex, their faces and vertices, in the whole's order. Where the other cell of a face is left out there is -1, as
 * there is outside the grid.
 */
export interface SubComplex {
  cells: CellComplex;
  /** Per vertex: its id in the whole. */
  wholeVertex: Uint32Array<ArrayBuffer>;
  /** Per face. */
  wholeFace: Uint32Array<ArrayBuffer>;
  /** Per cell. */
  wholeCell: Uint32Array<ArrayBuffer>;
}

/** The edges of all faces. */
export interface ComplexEdges {
  /** 2 per edge, the lower id first; edges ascend by the first, then by the second. */
  vertices: Uint32Array<ArrayBuffer>;
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

/**
 * The boundary of all cells: each half-face of a cell through which no flux passes to another one, that is, of a face of tag surface or of
 * one with a single cell. A face of a sheet has two, also where both belong to one cell, so that each side has a value of its own. Values
 * may be set; they are read by each call.
 */
export interface Boundary {
  /** Ascending. */
  halfFaces: Uint32Array<ArrayBuffer>;
  /** Per half-face. 0: neumann, the derivative of phi along the normal that points out of the cell is given; 1: dirichlet, phi is given. */
  condition: Uint8Array<ArrayBuffer>;
  /** Per half-face: the mean of what its condition gives on the face. */
  value: Float64Array<ArrayBuffer>;
}

/** What holds on all faces of a tag: one of the two. */
export type Condition = { readonly dirichlet: number; readonly neumann?: never } | { readonly neumann: number; readonly dirichlet?: never };
export type Conditions = { readonly [Tag in FaceTag]?: Condition };

/** Which cells are connected through inner faces. For whole regions these are the regions. */
export interface CellComponents {
  /** Per cell; components are in the order of their first cells. */
  cellComponent: Uint32Array<ArrayBuffer>;
  count: number;
}

/** Poisson's equation div grad phi = s. */
export interface PoissonProblem {
  /** Default: that of boundaryOf(cells), where nothing passes. */
  boundary?: Boundary;
  /** Per cell: the integral of s over it, e.g. s at its centroid times its volume. Default: 0. */
  source?: ArrayLike<number>;
  /** Default "centres". */
  dualPoints?: DualPoints;
}

/** matrix * phi = rhs; both are those of -div grad phi = -s, integrated over cells. */
export interface PoissonSystem {
  /** Cells x cells, symmetric, positive semidefinite: the negative Laplacian, and more on the diagonal of Dirichlet cells. */
  matrix: SparseMatrix;
  /** Per cell. */
  rhs: Float64Array<ArrayBuffer>;
  /** Cells x components without a Dirichlet condition: 1 for each cell of the component. */
  nullSpace: SparseMatrix;
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
   * rounding; otherwise the data are incompatible. True: whatever is in excess is taken away, evenly by volume.
   */
  balance?: boolean;
}

/**
 * "iterationLimit": the residual is above the tolerance after maxIterations; "incompatible": sources and fluxes of `component` do not
 * cancel, so nothing solves the system, and phi is 0; "breakdown": numbers, or the differences between them, are too large or too small for
 * doubles, and phi is what was found.
 */
export type SolveStatus = 'converged' | 'iterationLimit' | 'incompatible' | 'breakdown';

export interface Solution {
  status: SolveStatus;
  /** Per cell, at its dual point. */
  phi: Float64Array<ArrayBuffer>;
  /** Before each iteration and after the last, relative as in SolveOptions; the last one is that of phi. */
  residuals: Float64Array<ArrayBuffer>;
  /** Of cellComponents(), if incompatible; else -1. */
  component: number;
  /** In that component: what flows in, less the integral of s. */
  excess: number;
}

/** A flow without rotation or sources: its velocity is the gradient of phi. Velocities are in the unit of the wind. */
export interface Flow {
  status: SolveStatus;
  /** As in Solution. */
  residuals: Float64Array<ArrayBuffer>;
  wind: [number, number, number];
  /** Per cell, at its centre; in each component of cellComponents() with the mean zero by volume. */
  phi: Float64Array<ArrayBuffer>;
  /** Per face: the mean component along its normal; times faceArea what flows through. */
  faceVelocity: Float64Array<ArrayBuffer>;
  /** 3 per cell, at its centroid. */
  cellVelocity: Float64Array<ArrayBuffer>;
  /** 6 per cell: how the velocity changes in it, as the symmetric matrix xx, yy, zz, xy, yz, xz, whose trace is zero. */
  cellGradient: Float64Array<ArrayBuffer>;
  /** Per cell, at its centroid: the pressure coefficient 1 - |velocity|^2 / |wind|^2. */
  cellPressure: Float64Array<ArrayBuffer>;
  /** Components where the wind would bring more into the box than it takes out, or less; ascending. See solveFlow(). */
  throttled: Uint32Array<ArrayBuffer>;
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

/**
 * Where a streamline ends, by its `ends`: streamlineEnds[lines.ends[l]]. "side": on a side of the box, exactly; "surface": at the surface,
 * its last point is before it, by rounding; "rest": where nothing flows, or faster than doubles can express, or where it goes to and fro,
 * as it may beside the surface; "maxLength": it has reached that length; "maxPoints": it has that many points; "outside": its seed is not
 * in the grid, it has no points.
 */
export const streamlineEnds: readonly ['side', 'surface', 'rest', 'maxLength', 'maxPoints', 'outside'];
export type StreamlineEnd = (typeof streamlineEnds)[number];

/** One line per seed. */
export interface Streamlines {
  /** 3 per point, world units. */
  points: Float64Array<ArrayBuffer>;
  /** Per point. */
  speeds: Float64Array<ArrayBuffer>;
  /** Into the points, per line. */
  offsets: Uint32Array<ArrayBuffer>;
  /** Per line: the number of its end in `streamlineEnds`. */
  ends: Uint8Array<ArrayBuffer>;
}

/** What `initPhysics()` gives. No call changes its arguments. Errors are MandolineErrors, except what a progress callback throws. */
export interface Physics extends Calls {
  /** Version of the library. */
  readonly version: string;
}

/** What files call groups, materials or solids: names for the triangles of a mesh. */
export interface TriangleGroups {
  /** Per group, in the order of first triangles: each differs, and has a triangle. */
  names: string[];
  /** Per triangle: its group; empty if there are no groups. That of a face of a triangle is triangleGroup[cutMesh.faceTriangle[f]]. */
  triangleGroup: Uint32Array<ArrayBuffer>;
}

export interface PhysicsOptions {
  /** The module, as in InitOptions. By default it is loaded from beside the package's code. */
  physicsWasm?: WasmSource | (() => WasmSource | Promise<WasmSource>);
}

/**
 * Loads the WebAssembly module, once: every call gives the same promise, whatever its options. After a failure the next call tries again.
 */
export function initPhysics(options?: PhysicsOptions): Promise<Physics>;

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
 * The module keeps a twin of the cells that cellComplex(), mergeSmallCells(), uniteWalls(), subComplex() and regionComplex() give, and of
 * those that refineCells() and cut-meshes that cut() gave, as is told at CutMesh: calls that are given that same object neither copy nor
 * check its arrays, and take no notice of what was written into them.
 */
/// <reference lib="esnext.disposable" />
import type { CutMesh, IntersectionHandling, Mesh, RunOptions, TriangleGroups, Vector3, WasmSource, WriteOptions } from '../index.js';
import type { Boundary, CellComplex, FaceTag, Flow, FlowStep, Solution, SolveStatus, SurfaceForce, UnsteadyFlow } from './results.js';
import type { Calls } from './signatures.js';

export { type Fingerprint, MandolineError, type TriangleGroups, describe } from '../index.js';
export * from './results.js';

/** What a face is part of, by its `faceTag`: faceTags[cells.faceTag[f]]. */
export const faceTags: readonly ['xMin', 'xMax', 'yMin', 'yMax', 'zMin', 'zMax', 'inner', 'surface'];

export interface CoarsenOptions extends RunOptions {
  /** Octree cells have at most 2^maxLevel grid cells on a side; 0 merges nothing. Default 24. */
  maxLevel?: number;
  /** How many layers of grid cells around each cut one, diagonally too, are not merged. Default 1. */
  fineLayers?: number;
  /**
   * How many layers of cells of each level above 0 lie at least, diagonally too, between smaller and larger ones; of level 1, which are
   * the most cells, a quarter as many do, but two where there are so many. -1 (default): a twelfth of the grid cells along the longest
   * side, but at least one, so that all cells shrink as those of the grid do.
   */
  layersPerLevel?: number;
  /** Whether cells that share only an edge also differ by at most one level. Default false. */
  balanceEdges?: boolean;
}

/** Grid cells that meet the inside of a box are divided `levels` times, 0 to 24. */
export interface RefinementBox {
  min: Vector3;
  max: Vector3;
  levels: number;
}

/** Grid cells are divided where a function says so. Not in a worker, to which functions can't be sent: "badArgument". */
export interface RefinementRule {
  /**
   * Whether a cell with these corners is divided, which is the outcome of `depth` divisions of a grid cell: asked of all grid cells, by z,
   * then y, then x, and of those that it divided them into. What it throws is thrown by the call.
   */
  divides: (min: [number, number, number], max: [number, number, number], depth: number) => boolean;
  /** How often it divides a grid cell at most, 1 to 24. */
  levels: number;
}

/** `intersections` is what the cut was made with. */
export interface RefineOptions extends IntersectionHandling {
  /**
   * How often grid cells are divided at most where the surface bends: as long as normals of triangles in the cell are farther from each
   * other than `angle`. Triangles have to be consistently oriented. 0 to 24, default 0.
   */
  levels?: number;
  /** In degrees, 0 to 180; at 0 all cells with triangles are divided. Default 30. */
  angle?: number;
  /** For solvers, these should hold parts of the surface as a whole, or end where it is flat. */
  boxes?: readonly RefinementBox[];
  /** As for boxes. */
  rule?: RefinementRule;
  /** Least layers of cells of each size, diagonally too, around where the surface bends and smaller ones. At least 1, the default. */
  layers?: number;
  /** Of untouched grid cells that are not divided, as in coarsen(), but with 0 for maxLevel by default. */
  coarsening?: Omit<CoarsenOptions, 'progress'>;
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

/**
 * What holds on all faces of a tag: phi, its derivative along the normal that points out of the cell, or (`robin`) that derivative plus
 * `coefficient`, at least 0, times phi.
 */
export type Condition =
  | { readonly dirichlet: number; readonly neumann?: never; readonly robin?: never; readonly coefficient?: never }
  | { readonly neumann: number; readonly dirichlet?: never; readonly robin?: never; readonly coefficient?: never }
  | { readonly robin: number; readonly coefficient: number; readonly dirichlet?: never; readonly neumann?: never };
export type Conditions = { readonly [Tag in FaceTag]?: Condition };

/** Poisson's equation div k grad phi - m phi = s. */
export interface PoissonProblem {
  /** Default: that of boundaryOf(cells), where nothing passes. */
  boundary?: Boundary;
  /** Per cell: the mean of s in it, e.g. s at its centroid. Default: 0. */
  source?: ArrayLike<number>;
  /** Default "centres". Where phi is held on the surface, or with a mass, "centroids" need fewer corrections. */
  dualPoints?: DualPoints;
  /**
   * Per face: k there, above 0, also on the boundary. It may jump from cell to cell: then a face has what lies between, e.g. the harmonic
   * mean. Where it differs by more than a half on the faces of a cell, derivatives are of first order. Default: 1.
   */
  faceCoefficient?: ArrayLike<number>;
  /** Per cell: the mean of m in it, at least 0. Default: 0. */
  mass?: ArrayLike<number>;
}

export interface FlowOptions extends RunOptions {
  /** Of the residual, relative to the right side, both in the Euclidean norm. Default 1e-10. */
  tolerance?: number;
  /** With `farField`, of each pass. Default 500. */
  maxIterations?: number;
  /**
   * How often at most to solve again with derivatives of second order at cut-cells, at sides of octree cells that meet smaller ones, and
   * where phi is held, until less than a 30,000th of what they lacked is missing: three to six times. 0: phi solves the system of
   * poissonSystem(). Default 8.
   */
  corrections?: number;
  /**
   * False (default): a wind tunnel, through whose sides the wind blows as if nothing were inside. True: unbounded space. Through the sides
   * passes what would pass there without them: the wind, and what the surface adds to it at a distance. It may not reach the sides.
   */
  farField?: boolean;
}

export interface SolveOptions extends Omit<FlowOptions, 'farField'> {
  /**
   * What makes phi unique in a component where it is held nowhere. "zeroMean" (default): it has the mean zero by volume; "pinned": it
   * is zero in the component's first cell.
   */
  freeConstant?: 'zeroMean' | 'pinned';
  /**
   * In a component where phi is held nowhere sources and what flows in have to cancel. False (default): they have to cancel up to
   * rounding; otherwise the data are incompatible. True: the excess is subtracted, evenly by volume.
   */
  balance?: boolean;
}

/** What a PoissonSolver solves for. */
export interface PoissonData {
  /** As in PoissonProblem. Default: 0. */
  source?: ArrayLike<number>;
  /** Per half-face of the boundary, as in Boundary. Default: 0. */
  boundaryValue?: ArrayLike<number>;
  /** Per cell: a phi that is near the solution, such as that of the last time step. Default: none. */
  start?: ArrayLike<number>;
}

/** An object whose state is in the module's memory, as that of FlowStepper. */
export interface PoissonSolver {
  /** Without `start` the same as solvePoisson(), to the bit. */
  solve(data?: PoissonData, options?: SolveOptions): Solution;
  /** Gives its memory back. */
  free(): void;
  [Symbol.dispose](): void;
}

/** What a HeatStepper starts from. */
export interface HeatProblem {
  /** Conditions, coefficients, and a mass where heat is lost in proportion to phi. */
  problem?: PoissonProblem;
  /** Per cell: at time 0, at its dual point. */
  phi: ArrayLike<number>;
  timeStep: number;
}

/** An object whose state is in the module's memory, as that of FlowStepper. */
export interface HeatStepper {
  /** Takes a step, and tells how it ended: unless it is "converged", phi stays that of the step before. */
  step(options?: SolveOptions): SolveStatus;
  /** From now on; at first it is the problem's. */
  setSource(source: ArrayLike<number>): void;
  /** Per half-face of the boundary, from now on. */
  setBoundaryValue(boundaryValue: ArrayLike<number>): void;
  /** Per cell, as it is now. */
  phi(): Float64Array<ArrayBuffer>;
  time(): number;
  /** Gives its memory back. */
  free(): void;
  [Symbol.dispose](): void;
}

/** How createFlowStepper() steps. */
export interface FlowStepperOptions {
  /** Kinematic. At 0 (default) the flow slips along the surface, otherwise it sticks to it. */
  viscosity?: number;
  /** Of all steps. Default 0: it follows from the Courant number. */
  timeStep?: number;
  /** In a step, at most this part of what a cell holds flows out of it. Larger numbers than 0.5 (default) need not be stable. */
  courant?: number;
  /**
   * Of the divergence: of what flows into a cell and not out of it, relative to the largest speed of wind and start times the area of a
   * side of a grid cell. Default 1e-10.
   */
  tolerance?: number;
  /** Of each solution. Default 500. */
  maxIterations?: number;
  /** As in FlowOptions, but they begin with what the flow before lacks: default 1. With 0 steps are quicker, and less exact at the surface. */
  corrections?: number;
}

export interface ForceOptions {
  /** Per face: its group, as faceGroups() gives it. Default: one group. */
  faceGroup?: Uint32Array;
  /** What moments are about. Default: the origin. */
  centre?: Vector3;
}

/**
 * A flow in time, of a fluid of density 1. Its state is in the module's memory until free() is called, `using` ends its scope, or garbage
 * is collected that it is part of. If a call of the module runs out of memory, its state is lost. Methods throw code "badArgument" once it
 * is gone.
 */
export interface FlowStepper {
  /**
   * Starts again at time 0, from velocities at the cells' centroids, 3 per cell, less what makes them diverge. Code "badArgument" for
   * another length or a number that is not finite (element: the cell).
   */
  start(cellVelocity: ArrayLike<number>): void;
  /**
   * Takes a step. If its status is not "converged", the flow is still that before. It is "breakdown" where nothing moves and the step would
   * have no length, or where steps were too long for a flow to stay finite.
   */
  step(): FlowStep;
  /** The flow as it is now, at first that at time 0. */
  flow(): UnsteadyFlow;
  /** Per group: what the flow did to the surface in the last step. */
  forces(options?: ForceOptions): SurfaceForce[];
  /** Gives its memory back. */
  free(): void;
  [Symbol.dispose](): void;
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
export type WriteFacesOptions = Omit<WriteCellsOptions, 'simpleCells'>;

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

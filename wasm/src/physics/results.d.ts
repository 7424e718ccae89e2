// Written by wasm/results.mjs from the headers in src/include/mandoline: change those.
import type { CutMeshArrays } from '../index.js';
import type { Fingerprint, SparseMatrix } from './index.js';

/**
 * All cells, with every face between two of them or on the boundary once. Where a large cell meets smaller ones, its side is divided like
 * theirs, and the edges of a face have all vertices that lie on them. The cut-mesh's vertices, faces and cells come first and keep their
 * ids; then come those of the octree cells: cell cutCells + c is octree cell c. Half-face = 2 * face + side; side 0: the face's normal
 * points out of the cell, side 1: into it.
 *
 * refineCells() makes those of cells of several sizes, also at the surface. mergeSmallCells() and uniteWalls() make others of any, whose
 * cells and faces have these as members.
 */
export interface CellComplex {
  /** How many of the vertices are the cut-mesh's. */
  cutVertices: number;
  /** How many of the faces are the cut-mesh's, or have one of those as their first member. */
  cutFaces: number;
  /** How many of the cells, the same. */
  cutCells: number;

  /** 3 per vertex, world units. */
  positions: Float64Array<ArrayBuffer>;

  // As in CutMesh.
  /** Into loopVertices. */
  loopOffsets: Uint32Array<ArrayBuffer>;
  /** Vertex ids. */
  loopVertices: Uint32Array<ArrayBuffer>;
  /** Into loops. */
  faceLoopOffsets: Uint32Array<ArrayBuffer>;

  /** 2 per face: the cell on side 0 and that on side 1; -1 outside the grid. */
  faceCells: Int32Array<ArrayBuffer>;
  /** Per face: FaceTag as a number (0: xMin, 1: xMax, 2: yMin, 3: yMax, 4: zMin, 5: zMax, 6: inner, 7: surface). */
  faceTag: Uint8Array<ArrayBuffer>;
  /** Per face. */
  faceArea: Float64Array<ArrayBuffer>;
  /** 3 per face, unit. */
  faceNormal: Float64Array<ArrayBuffer>;
  /** 3 per face. */
  faceCentroid: Float64Array<ArrayBuffer>;

  /** Into cellHalfFaces. */
  cellHalfFaceOffsets: Uint32Array<ArrayBuffer>;
  /** Half-faces, ascending. */
  cellHalfFaces: Uint32Array<ArrayBuffer>;
  /** 3 per cell: its grid cell, the lowest one of larger cells. */
  cellCorner: Int32Array<ArrayBuffer>;
  /** Per cell: as in OctreeCells; 0 for a cut-cell, but see refineCells(). */
  cellLevel: Uint8Array<ArrayBuffer>;
  /** 3 per cell: middle of its grid cell or octree cell, which may lie outside a cut-cell. */
  cellCentre: Float64Array<ArrayBuffer>;
  /** Per cell: region of the cut-mesh. */
  cellRegion: Uint32Array<ArrayBuffer>;
  /** Per cell. */
  cellVolume: Float64Array<ArrayBuffer>;
  /** 3 per cell. */
  cellCentroid: Float64Array<ArrayBuffer>;

  // Members: of which cells and faces, before any were merged or united, each one is made. Empty where each is its own only member.
  /** Into cellMembers. */
  cellMemberOffsets: Uint32Array<ArrayBuffer>;
  /** Cells, ascending for each cell; each belongs to one. */
  cellMembers: Uint32Array<ArrayBuffer>;
  /** Into faceMembers. */
  faceMemberOffsets: Uint32Array<ArrayBuffer>;
  /** Faces, ascending for each face; none belongs to two. */
  faceMembers: Uint32Array<ArrayBuffer>;

  /** The fingerprint of the cut-mesh; of the whole, if it is a part of another cell complex. */
  madeFrom?: Fingerprint;
  /** That of the cell complex. */
  fingerprint?: Fingerprint;
}

/**
 * Some cells of a cell complex, their faces and vertices, in the whole's order. Where the other cell of a face is left out there is -1, as
 * there is outside the grid. Members keep the ids that they have in the whole.
 */
export interface SubComplex {
  cells: CellComplex;
  /** Per vertex: its id in the whole. */
  wholeVertex: Uint32Array<ArrayBuffer>;
  /** Per face, the same. */
  wholeFace: Uint32Array<ArrayBuffer>;
  /** Per cell, the same. */
  wholeCell: Uint32Array<ArrayBuffer>;
}

/**
 * The cells that replace the untouched grid cells. One of level L is a block of 2^L grid cells on a side that begins at multiples of 2^L,
 * or the part of it inside the grid. Cells that share a part of a face differ by at most one level, a cut grid cell counting as one of
 * level 0; there are as few cells as that allows. In Morton order: x changes fastest, then y, then z, at each level.
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
  /** The fingerprint of the cut-mesh. */
  madeFrom?: Fingerprint;
  /** That of the octree cells. */
  fingerprint?: Fingerprint;
}

/** A flow without rotation or sources: its velocity is the gradient of phi. Velocities are in the unit of the wind. */
export interface Flow {
  status: SolveStatus;
  /** As in Solution; with farField, those of all passes one after the other. */
  residuals: Float64Array<ArrayBuffer>;
  wind: [number, number, number];
  /** Per cell, at its centre; its mean by volume is zero in each component of cellComponents(). */
  phi: Float64Array<ArrayBuffer>;
  /** Per face: the mean component along its normal; times faceArea it is the flow through it. */
  faceVelocity: Float64Array<ArrayBuffer>;
  /** 3 per cell, at its centroid. */
  cellVelocity: Float64Array<ArrayBuffer>;
  /** 6 per cell: how the velocity changes in it, as the symmetric matrix xx, yy, zz, xy, yz, xz, whose trace is zero. */
  cellGradient: Float64Array<ArrayBuffer>;
  /** Per cell, at its centroid: the pressure coefficient 1 - |velocity|^2 / |wind|^2. */
  cellPressure: Float64Array<ArrayBuffer>;
  /** Components into which the wind would blow more than it takes out, or less; ascending. See solveFlow(). */
  throttled: Uint32Array<ArrayBuffer>;
  /** The fingerprint of the cell complex. */
  madeFrom?: Fingerprint;
}

/** Streamlines, one per seed. */
export interface Streamlines {
  /** 3 per point. */
  points: Float64Array<ArrayBuffer>;
  /** Per point. */
  speeds: Float64Array<ArrayBuffer>;
  /** Into the points, per line. */
  offsets: Uint32Array<ArrayBuffer>;
  /** Per line: StreamlineEnd as a number (0: side, 1: surface, 2: rest, 3: maxLength, 4: maxPoints, 5: outside). */
  ends: Uint8Array<ArrayBuffer>;
}

/** What mergeSmallCells() made. */
export interface MergedCells {
  /** The merged ones. */
  cells: CellComplex;
  /** Per cell before: the cell that it is a member of. */
  mergedCell: Uint32Array<ArrayBuffer>;
  /** Cells that are still small, ascending. */
  pockets: Uint32Array<ArrayBuffer>;
}

/** The edges of all faces. */
export interface ComplexEdges {
  /** 2 per edge, the lower id first; edges ascend by the first, then by the second. */
  vertices: Uint32Array<ArrayBuffer>;
  /** The fingerprint of the cell complex. */
  madeFrom?: Fingerprint;
}

/**
 * The boundary of all cells: each half-face of a cell through which no flux passes to another one, that is, of a face of tag surface or of
 * one with a single cell. A face of a sheet has two, also where both belong to one cell, so that each side has a value of its own. Values
 * may be set; they are read by each call.
 */
export interface Boundary {
  /** Ascending. */
  halfFaces: Uint32Array<ArrayBuffer>;
  /** Per half-face: ConditionKind as a number (0: neumann, 1: dirichlet, 2: robin). */
  condition: Uint8Array<ArrayBuffer>;
  /** Per half-face: the mean of what its condition gives on the face. */
  value: Float64Array<ArrayBuffer>;
  /** Per half-face: that of phi in a Robin condition, at least 0; not read elsewhere. */
  coefficient: Float64Array<ArrayBuffer>;
  /** The fingerprint of the cell complex. */
  madeFrom?: Fingerprint;
}

/** Which cells are connected through inner faces. For whole regions these are the regions. */
export interface CellComponents {
  /** Per cell; components are in the order of their first cells. */
  cellComponent: Uint32Array<ArrayBuffer>;
  /** Of components. */
  count: number;
}

/**
 * The system matrix * phi = rhs; both are those of m phi - div k grad phi = -s, integrated over cells. No cell is left out: what holds phi
 * is on the diagonal and in rhs.
 */
export interface PoissonSystem {
  /**
   * Cells x cells, symmetric, positive semidefinite: -laplacian(), and more on the diagonal where phi is held. With a coefficient, the
   * other value where one cell meets smaller ones is the mean of theirs by area times coefficient.
   */
  matrix: SparseMatrix;
  /** Per cell. */
  rhs: Float64Array<ArrayBuffer>;
  /** Cells x components where phi is held nowhere: 1 for each cell of the component. */
  nullSpace: SparseMatrix;
}

/** What solvePoisson() found. */
export interface Solution {
  status: SolveStatus;
  /** Per cell, at its dual point. */
  phi: Float64Array<ArrayBuffer>;
  /** Before each iteration and after the last, relative as in SolveOptions; the last one is that of phi. */
  residuals: Float64Array<ArrayBuffer>;
  /**
   * Per face of tag inner between two cells: the mean derivative of phi along its normal; 0 for others. With those on the boundary, their
   * products with areas and coefficients are the fluxes that sources and mass balance in each cell, within the tolerance.
   */
  faceDerivative: Float64Array<ArrayBuffer>;
  /** Per half-face of the boundary: the same along the normal that points out of the cell. */
  boundaryDerivative: Float64Array<ArrayBuffer>;
  /**
   * Components of cellComponents(), ascending, in which sources and fluxes do not cancel: phi is 0 there, and the residuals leave them out.
   */
  incompatible: Uint32Array<ArrayBuffer>;
  /** Per incompatible component: the inflow minus the integral of s. */
  excess: Float64Array<ArrayBuffer>;
  /**
   * Cells, ascending, in which phi may be wrong by more than a millionth of its range: much flows into them through their faces on the
   * boundary and out again, and they exchange so little with others that rounding of the difference decides. Thin slivers between triangles
   * are such, where fluxes through the surface are given that do not vanish; mergeSmallCells() leaves fewer.
   */
  unresolved: Uint32Array<ArrayBuffer>;
}

/** What refineCells() made. */
export interface RefinedCells {
  /**
   * All cells, as of one cut with cells of several sizes. cellLevel is 0 for the smallest cells; one of level L is 2^L of those on a side,
   * also if it is a cut-cell. cellCorner counts the smallest ones.
   */
  cells: CellComplex;
  /**
   * The cut-vertices, cut-faces and cut-cells of `cells`, for functions that take a cut-mesh together with its cells: writers,
   * mergeSmallCells(), uniteWalls(), faceGroups(), streamlines(). Its grid has the planes of the smallest cells. It has no runs and no made
   * vertices, and so is no cut of that grid: functions that need one, such as measure(), coarsen() and cellsAt(), refuse it. Of a vertex of
   * a larger cell, planes that only smaller cells have are left out of vertexMask, and vertexCell is a rounded one along axes without a
   * plane.
   */
  cutMesh: CutMeshArrays;
  /** How often grid cells were divided at most; those of the grid have this level. */
  levels: number;
}

/** A flow at one time, of a fluid of density 1. */
export interface UnsteadyFlow {
  time: number;
  /** Per face: the mean component along its normal; times faceArea it is the flow through it. */
  faceVelocity: Float64Array<ArrayBuffer>;
  /** 3 per cell, at its centroid. */
  cellVelocity: Float64Array<ArrayBuffer>;
  /** Per cell, at its centroid: that of fluid of density 1; 0 where the flow leaves the box. */
  cellPressure: Float64Array<ArrayBuffer>;
  /** The fingerprint of the cell complex. */
  madeFrom?: Fingerprint;
}

/** What a step took. */
export interface FlowStep {
  /** If it is another one, the flow is still that before the step. */
  status: SolveStatus;
  timeStep: number;
  /** The largest number of a cell. */
  courant: number;
  /** After the step: the largest of a cell, relative as in FlowStepperOptions. */
  divergence: number;
  /** Of all solutions. */
  iterations: number;
}

/** What the flow does to a part of the surface. */
export interface SurfaceForce {
  /** The force of the pressure. */
  pressure: [number, number, number];
  /** That of the viscosity. */
  viscous: [number, number, number];
  /** Of both, about a point. */
  moment: [number, number, number];
}

/** What a face of a cell complex is part of: a side of the grid, or another thing. */
export type FaceTag =
  | 'xMin'
  | 'xMax'
  | 'yMin'
  | 'yMax'
  | 'zMin'
  | 'zMax'
  /** None of these: a face between two cells, or one that a sub-mesh was cut off at. */
  | 'inner'
  /** A triangle of the input, which separates two cells or two sides of one; also where it lies in a side of the grid. */
  | 'surface';

/** Where a streamline ends. */
export type StreamlineEnd =
  /** On a side of the box, exactly. */
  | 'side'
  /** At the surface: its last point is before it, by rounding. */
  | 'surface'
  /** Where nothing flows, or faster than doubles can express; or where it goes to and fro, as it may beside the surface. */
  | 'rest'
  /** It has reached that length. */
  | 'maxLength'
  /** It has that many points. */
  | 'maxPoints'
  /** Its seed is not in the grid; it has no points. */
  | 'outside';

/** What is given on a half-face of the boundary. */
export type ConditionKind =
  /** The derivative of phi along the normal that points out of the cell is given. */
  | 'neumann'
  /** Phi is given. */
  | 'dirichlet'
  /** The same derivative plus a coefficient times phi is given. */
  | 'robin';

/** How solving ended. Flows and steps are not unresolved: what passes through faces is known also where phi is not. */
export type SolveStatus =
  | 'converged'
  /** The residual is above the tolerance after maxIterations. */
  | 'iterationLimit'
  /** In some components sources and fluxes do not cancel, so nothing solves the system there; elsewhere it is solved. */
  | 'incompatible'
  /** Solved, but rounding errors of what is given may make more than a millionth of the range of phi in some cells. */
  | 'unresolved'
  /** Numbers, or the differences between them, are too large or too small for doubles; phi is the last that was found. */
  | 'breakdown';

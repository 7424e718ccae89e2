// The table of the calls of mandoline-wasm: api.js makes those of init() from it, worker-calls.js those of a worker, wasm/signatures.mjs
// their types, of which the last lines of each comment are the signatures. wasm/README.md has the same names.
//
// takes: the arguments by their names, in order. Each is a reader (see arguments.js); or { kind }, what may have a twin; or both of its
//   members. A value that is not a result is read by `otherwise`, if that is given, unless `fits` says that it is of the kind.
// options: their readers.
// run(bindings, ...arguments, options): calls C++, with handles for arguments that may have twins; by default the binding of that name.
// keeps: the kind of the call's result, which gets a twin (only its `member`, if that is given); run() then returns { value, twin }, or
//   { value } where calls of other modules take the result, which keep one of their own.
// gives: what object its result is, whose state stays in the module (see objects.js); run() then returns its handle.
// isCut: it goes through the stages of a cut, and errors name the stage.
// isFile: its only argument is a file, whose bytes and name C++ gets; its reader is given the options.
// orIn: of a file, the module whose binding of the same name is called where this one gives null.
import {
  bad,
  expectNumber,
  flag,
  numbered,
  readBuffers,
  readFlags,
  readFunction,
  readGrid,
  readMaxPairs,
  readMesh,
  readNumbers,
  readOrigin,
  readPart,
  readPlane,
  readPoints,
  readResolved,
  readSnapTolerance,
  readVector,
} from './arguments.js';
import { Intersections, WindingRule } from './fields.js';
import { readFile, readName } from './files.js';

const cutMesh = { kind: 'cutMesh' };

const progress = readFunction;
const reuse = readBuffers;
const intersections = numbered(Intersections);
const rule = numbered(WindingRule);
const threshold = (value = 0.5, name) => expectNumber(value, name);

/** A rule as its number, or flags of regions. */
const readInside = (value, name) => (typeof value === 'object' && value !== null ? readFlags(value, name) : rule(value, name));

/**
 * An outcome, where what is too large is told.
 *
 * @returns {{ value?: any, error?: any }}
 */
function withSize({ value, error }, { kind, cells, planes }) {
  if (error?.code !== 'gridTooLarge') return { value, error };
  const counts = kind === 'planes' ? planes.map(({ length }) => length - 1) : cells;
  const size = kind === 'around' ? `${cells} cells along the longest side of the mesh` : `${counts.join(' x ')} cells`;
  return { error: { ...error, message: `${error.message} Asked for were ${size}.` } };
}

/** Calls a binding that takes null for a prepared mesh, whose handle it gets among the options. */
export function callWithMesh(bindings, name, mesh, grid, options) {
  const isPrepared = mesh instanceof bindings.KeptMesh;
  return isPrepared ? bindings[name](null, grid, { ...options, prepared: mesh }) : bindings[name](mesh, grid, options);
}

/** @param {{ value?: any, error?: any }} outcome */
const mapped = ({ value, error }, f) => (error ? { error } : { value: f(value) });

export const cutCalls = {
  /**
   * A copy of the mesh, checked, welded and resolved once (A, Bad input meshes), which cut() takes with any number of grids; with
   * `orient` the mesh that orient() gives, which then goes with the cut-meshes wherever a call takes both. The module keeps the prepared
   * mesh as the twin of this very object, like those of cut-meshes (see CutMesh). If the twin is gone, the next cut prepares the mesh once
   * more; a cut with a snapTolerance always does.
   *
   * prepare(mesh: Mesh, options?: PrepareOptions): MeshArrays
   */
  prepare: { takes: { mesh: readMesh }, options: { intersections, orient: flag(false), progress }, keeps: 'prepared', isCut: true },
  /**
   * Cuts the mesh with the grid (the paper's Algorithm 1).
   *
   * cut(mesh: Mesh, grid: GridInput, options?: CutOptions): CutMesh
   */
  cut: {
    takes: { mesh: { kind: 'prepared', otherwise: readMesh }, grid: readGrid },
    options: { snapTolerance: readSnapTolerance, intersections, gridCellRegion: flag(true), keep: flag(true), reuse, progress },
    keeps: 'cutMesh',
    isCut: true,
    run: (bindings, mesh, grid, options) => {
      return withSize(callWithMesh(bindings, 'cut', mesh, grid, options), grid);
    },
  },
  /**
   * Which triangles meet other than in shared vertices and whole shared edges, and where; what cut() resolves (A, Bad input meshes).
   *
   * findIntersections(mesh: Mesh, options?: IntersectionOptions): MeshIntersections
   */
  findIntersections: { takes: { mesh: readMesh }, options: { maxPairs: readMaxPairs, progress } },
  /**
   * What kind of mesh one is: closed, oriented, manifold; and where it is not: its open, non-manifold and inconsistent edges.
   *
   * inspect(mesh: Mesh): MeshInfo
   */
  inspect: { takes: { mesh: readMesh } },
  /**
   * The mesh with its triangles turned so that they agree: closed parts outward, or inward where they lie inside an odd number of others,
   * all of it exactly.
   *
   * orient(mesh: Mesh, options?: RunOptions): OrientedMesh
   */
  orient: { takes: { mesh: readMesh }, options: { progress } },
  /**
   * The mesh without self-intersections, for those who want it without a grid.
   *
   * resolve(mesh: Mesh, options?: RunOptions): ResolvedMesh
   */
  resolve: { takes: { mesh: readMesh }, options: { progress }, isCut: true },
  /**
   * The surface of the solid, oriented outwards: of what resolve() gave, or of a cut-mesh, in pieces cut by the grid. Every edge has an
   * even number of triangles: where the solid reaches the grid's sides, sides of its cut-cells and of the cells of coarsen() close the part
   * inside. Inside is what insideRegions() says by a rule (default "positive"): open parts are left out unless estimateInside() made
   * the cut-mesh. Or it is these regions of a cut-mesh, one flag for each. Code "badArgument" for a mesh that has open parts alone and
   * no estimates, since it bounds no solid, and for another number of flags than there are regions.
   *
   * boundary(mesh: ResolvedMeshArrays | CutMeshArrays, inside?: WindingRule): MeshArrays
   * boundary(mesh: CutMeshArrays, inside: Uint8Array | readonly boolean[]): MeshArrays
   */
  boundary: {
    takes: {
      mesh: { kind: 'cutMesh', fits: (value) => value?.grid !== undefined, otherwise: readResolved },
      inside: readInside,
    },
    run: (bindings, mesh, inside) => {
      const isKept = mesh instanceof bindings.KeptCutMesh;
      if (typeof inside === 'number') return isKept ? bindings.boundary(mesh, inside) : bindings.boundaryOfResolved(mesh, inside);
      if (!isKept) throw bad('inside must be a rule: only a cut-mesh has regions.');
      return bindings.boundaryOfRegions(mesh, inside);
    },
  },
  /**
   * Which regions are inside of the solid, by the best that there is: a region's winding number by the rule, or the sum over the parts
   * that have one, or its estimate; or it is inside of an odd number of parts that have parity alone. Code "badArgument" if the
   * cut-mesh has open parts alone and no estimates; "badOption" unless the threshold is above 0 and at most 1.
   *
   * insideRegions(cutMesh: CutMeshArrays, options?: InsideOptions): InsideRegions
   */
  insideRegions: { takes: { cutMesh }, options: { rule, threshold } },
  /**
   * The cut-mesh with estimates where parts are open: `regionInsideness`, from generalized winding numbers (Jacobson et al. 2013).
   * Inside and outside of an open surface are one region, which meet through its holes: such regions are divided at grid-faces into
   * connected sets of cut-cells and of cells of coarsen() on one side of the threshold, so that all that goes by regions closes the holes
   * there. All else is as it was. Without open parts, the result is a copy. `mesh` is the input of the cut. Code "badArgument" if it
   * is not, or if there are estimates already; "badOption" unless the threshold is above 0 and at most 1.
   *
   * estimateInside(mesh: Mesh, cutMesh: CutMeshArrays, options?: EstimateOptions): CutMeshArrays
   */
  estimateInside: { takes: { mesh: readMesh, cutMesh }, options: { threshold, progress }, keeps: 'cutMesh' },
  /**
   * Per point (3 coordinates each) the sum of the signed solid angles of all triangles, in whole spheres: inside of a closed surface that
   * is oriented outwards 1, outside 0, about open ones between. Right to some 1e-12. Triangles with the point on them count as 0.
   *
   * generalizedWindingNumbers(mesh: Mesh, points: ArrayLike<number>, options?: RunOptions): Float64Array<ArrayBuffer>
   */
  generalizedWindingNumbers: { takes: { mesh: readMesh, points: readPoints }, options: { progress } },
  /**
   * Areas, normals, centroids and volumes. `mesh` is the input of the cut.
   *
   * measure(mesh: Mesh, cutMesh: CutMeshArrays, options?: RunOptions): Measures
   */
  measure: { takes: { mesh: readMesh, cutMesh }, options: { progress } },
  /**
   * The cut-edges with their lengths.
   *
   * cutEdges(mesh: Mesh, cutMesh: CutMeshArrays): CutEdges
   */
  cutEdges: { takes: { mesh: readMesh, cutMesh } },
  /**
   * What lies on the two sides of each face, and which cut-cells are neighbours.
   *
   * adjacency(cutMesh: CutMeshArrays): Adjacency
   */
  adjacency: { takes: { cutMesh } },
  /**
   * Triangles of all faces; or, with `of`, 3 vertex ids per triangle: the closed surface of one cut-cell, oriented outward, or the pieces
   * of triangles that bound a region, oriented out of it, both sides of those where a sheet ends within the region.
   *
   * triangulate(cutMesh: CutMeshArrays, of?: undefined): FaceTriangles
   * triangulate(cutMesh: CutMeshArrays, of: { cell: number } | { region: number }): Uint32Array<ArrayBuffer>
   */
  triangulate: {
    takes: { cutMesh, of: readPart },
    run: (bindings, handle, { cell = undefined, region = undefined } = {}) => {
      if (cell !== undefined) return bindings.triangulateCell(handle, cell);
      return region === undefined ? bindings.triangulate(handle) : bindings.triangulateRegion(handle, region);
    },
  },
  /**
   * Buffers to draw all cut-cells with: indexed triangles with smooth normals, and edges by kind. `mesh` is the input of the cut.
   *
   * cellDrawing(mesh: Mesh, cutMesh: CutMeshArrays, options?: DrawingOptions): CellDrawing
   */
  cellDrawing: { takes: { mesh: readMesh, cutMesh }, options: { origin: readOrigin, reuse } },
  /**
   * Which cell holds this point; null outside the grid. A point on a face counts to one of the cells beside it.
   *
   * cellAt(cutMesh: CutMeshArrays, point: Vector3): Location | null
   */
  cellAt: {
    takes: { cutMesh, point: readVector },
    run: (bindings, ...given) =>
      mapped(bindings.cellsAt(...given), ({ cell, gridCell, region }) =>
        region[0] < 0 ? null : { cell: cell[0], gridCell: [...gridCell], region: region[0] },
      ),
  },
  /**
   * Which cell holds each point (3 coordinates per point): one call for many points is far faster than many calls.
   *
   * cellsAt(cutMesh: CutMeshArrays, points: ArrayLike<number>): Locations
   */
  cellsAt: { takes: { cutMesh, points: readPoints } },
  /**
   * The polygons in which a plane cuts the cells.
   *
   * slice(cutMesh: CutMeshArrays, plane: Plane, options?: SliceOptions): Slice
   */
  slice: {
    takes: { cutMesh, plane: readPlane },
    options: { untouched: flag(true) },
    run: (bindings, handle, plane, { untouched }) => bindings.slice(handle, plane, untouched),
  },
  /**
   * The slices of the planes normal . x = offset, in the order of the offsets, for less than many calls of slice() cost.
   *
   * slices(cutMesh: CutMeshArrays, normal: Vector3, offsets: ArrayLike<number>, options?: SliceOptions): Slice[]
   */
  slices: {
    takes: { cutMesh, normal: readVector, offsets: readNumbers },
    options: { untouched: flag(true) },
    run: (bindings, handle, normal, offsets, { untouched }) => bindings.slices(handle, normal, offsets, untouched),
  },
  /**
   * The outlines of the regions in such planes, as slicers need them.
   *
   * outlines(cutMesh: CutMeshArrays, normal: Vector3, offsets: ArrayLike<number>): Outlines[]
   */
  outlines: { takes: { cutMesh, normal: readVector, offsets: readNumbers } },
  /**
   * The mesh in a file: OBJ, STL, PLY or OFF (STL and PLY in text or binary), each also gzipped, told by content and then by the extension
   * of the name. Polygons are fanned from their first vertex; triangles are in the order of the file. Code "badFile" if it can't be read;
   * the message names the file and the line. The first PLY or OFF file loads the module that also writes files.
   *
   * readMesh(source: Blob | ArrayBuffer | ArrayBufferView, options?: ReadMeshOptions): Promise<MeshArrays>
   */
  readMesh: { takes: { source: readFile }, options: { name: readName }, isFile: true, orIn: 'files' },
};

// Written by wasm/signatures.mjs from calls.js: change that.
import type {
  Adjacency,
  CellDrawing,
  CutEdges,
  CutMesh,
  CutMeshArrays,
  CutOptions,
  DrawingOptions,
  EstimateOptions,
  FaceTriangles,
  GridInput,
  InsideOptions,
  InsideRegions,
  IntersectionOptions,
  Location,
  Locations,
  Measures,
  Mesh,
  MeshArrays,
  MeshInfo,
  MeshIntersections,
  OrientedMesh,
  Outlines,
  Plane,
  PrepareOptions,
  ReadMeshOptions,
  ResolvedMesh,
  ResolvedMeshArrays,
  RunOptions,
  Slice,
  SliceOptions,
  Vector3,
  WindingRule,
} from './index.js';
import type { CallOptions } from './worker.js';

export interface Calls {
  /**
   * A copy of the mesh, checked, welded and resolved once (A, Bad input meshes), which cut() takes with any number of grids; with
   * `orient` the mesh that orient() gives, which then goes with the cut-meshes wherever a call takes both. The module keeps the prepared
   * mesh as the twin of this very object, like those of cut-meshes (see CutMesh). If the twin is gone, the next cut prepares the mesh once
   * more; a cut with a snapTolerance always does.
   */
  prepare(mesh: Mesh, options?: PrepareOptions): MeshArrays;
  /** Cuts the mesh with the grid (the paper's Algorithm 1). */
  cut(mesh: Mesh, grid: GridInput, options?: CutOptions): CutMesh;
  /** Which triangles meet other than in shared vertices and whole shared edges, and where; what cut() resolves (A, Bad input meshes). */
  findIntersections(mesh: Mesh, options?: IntersectionOptions): MeshIntersections;
  /** What kind of mesh one is: closed, oriented, manifold; and where it is not: its open, non-manifold and inconsistent edges. */
  inspect(mesh: Mesh): MeshInfo;
  /**
   * The mesh with its triangles turned so that they agree: closed parts outward, or inward where they lie inside an odd number of others,
   * all of it exactly.
   */
  orient(mesh: Mesh, options?: RunOptions): OrientedMesh;
  /** The mesh without self-intersections, for those who want it without a grid. */
  resolve(mesh: Mesh, options?: RunOptions): ResolvedMesh;
  /**
   * The surface of the solid, oriented outwards: of what resolve() gave, or of a cut-mesh, in pieces cut by the grid. Every edge has an
   * even number of triangles: where the solid reaches the grid's sides, sides of its cut-cells and of the cells of coarsen() close the part
   * inside. Inside is what insideRegions() says by a rule (default "positive"): open parts are left out unless estimateInside() made
   * the cut-mesh. Or it is these regions of a cut-mesh, one flag for each. Code "badArgument" for a mesh that has open parts alone and
   * no estimates, since it bounds no solid, and for another number of flags than there are regions.
   */
  boundary(mesh: ResolvedMeshArrays | CutMeshArrays, inside?: WindingRule): MeshArrays;
  boundary(mesh: CutMeshArrays, inside: Uint8Array | readonly boolean[]): MeshArrays;
  /**
   * Which regions are inside of the solid, by the best that there is: a region's winding number by the rule, or the sum over the parts
   * that have one, or its estimate; or it is inside of an odd number of parts that have parity alone. Code "badArgument" if the
   * cut-mesh has open parts alone and no estimates; "badOption" unless the threshold is above 0 and at most 1.
   */
  insideRegions(cutMesh: CutMeshArrays, options?: InsideOptions): InsideRegions;
  /**
   * The cut-mesh with estimates where parts are open: `regionInsideness`, from generalized winding numbers (Jacobson et al. 2013).
   * Inside and outside of an open surface are one region, which meet through its holes: such regions are divided at grid-faces into
   * connected sets of cut-cells and of cells of coarsen() on one side of the threshold, so that all that goes by regions closes the holes
   * there. All else is as it was. Without open parts, the result is a copy. `mesh` is the input of the cut. Code "badArgument" if it
   * is not, or if there are estimates already; "badOption" unless the threshold is above 0 and at most 1.
   */
  estimateInside(mesh: Mesh, cutMesh: CutMeshArrays, options?: EstimateOptions): CutMeshArrays;
  /**
   * Per point (3 coordinates each) the sum of the signed solid angles of all triangles, in whole spheres: inside of a closed surface that
   * is oriented outwards 1, outside 0, about open ones between. Right to some 1e-12. Triangles with the point on them count as 0.
   */
  generalizedWindingNumbers(mesh: Mesh, points: ArrayLike<number>, options?: RunOptions): Float64Array<ArrayBuffer>;
  /** Areas, normals, centroids and volumes. `mesh` is the input of the cut. */
  measure(mesh: Mesh, cutMesh: CutMeshArrays, options?: RunOptions): Measures;
  /** The cut-edges with their lengths. */
  cutEdges(mesh: Mesh, cutMesh: CutMeshArrays): CutEdges;
  /** What lies on the two sides of each face, and which cut-cells are neighbours. */
  adjacency(cutMesh: CutMeshArrays): Adjacency;
  /**
   * Triangles of all faces; or, with `of`, 3 vertex ids per triangle: the closed surface of one cut-cell, oriented outward, or the pieces
   * of triangles that bound a region, oriented out of it, both sides of those where a sheet ends within the region.
   */
  triangulate(cutMesh: CutMeshArrays, of?: undefined): FaceTriangles;
  triangulate(cutMesh: CutMeshArrays, of: { cell: number } | { region: number }): Uint32Array<ArrayBuffer>;
  /** Buffers to draw all cut-cells with: indexed triangles with smooth normals, and edges by kind. `mesh` is the input of the cut. */
  cellDrawing(mesh: Mesh, cutMesh: CutMeshArrays, options?: DrawingOptions): CellDrawing;
  /** Which cell holds this point; null outside the grid. A point on a face counts to one of the cells beside it. */
  cellAt(cutMesh: CutMeshArrays, point: Vector3): Location | null;
  /** Which cell holds each point (3 coordinates per point): one call for many points is far faster than many calls. */
  cellsAt(cutMesh: CutMeshArrays, points: ArrayLike<number>): Locations;
  /** The polygons in which a plane cuts the cells. */
  slice(cutMesh: CutMeshArrays, plane: Plane, options?: SliceOptions): Slice;
  /** The slices of the planes normal . x = offset, in the order of the offsets, for less than many calls of slice() cost. */
  slices(cutMesh: CutMeshArrays, normal: Vector3, offsets: ArrayLike<number>, options?: SliceOptions): Slice[];
  /** The outlines of the regions in such planes, as slicers need them. */
  outlines(cutMesh: CutMeshArrays, normal: Vector3, offsets: ArrayLike<number>): Outlines[];
  /**
   * The mesh in a file: OBJ, STL, PLY or OFF (STL and PLY in text or binary), each also gzipped, told by content and then by the extension
   * of the name. Polygons are fanned from their first vertex; triangles are in the order of the file. Code "badFile" if it can't be read;
   * the message names the file and the line. The first PLY or OFF file loads the module that also writes files.
   */
  readMesh(source: Blob | ArrayBuffer | ArrayBufferView, options?: ReadMeshOptions): Promise<MeshArrays>;
}

/** The same in a worker. */
export interface WorkerCalls {
  prepare(mesh: Mesh, options?: PrepareOptions & CallOptions): Promise<MeshArrays>;
  cut(mesh: Mesh, grid: GridInput, options?: CutOptions & CallOptions): Promise<CutMesh>;
  findIntersections(mesh: Mesh, options?: IntersectionOptions & CallOptions): Promise<MeshIntersections>;
  inspect(mesh: Mesh, options?: CallOptions): Promise<MeshInfo>;
  orient(mesh: Mesh, options?: RunOptions & CallOptions): Promise<OrientedMesh>;
  resolve(mesh: Mesh, options?: RunOptions & CallOptions): Promise<ResolvedMesh>;
  boundary(mesh: ResolvedMeshArrays | CutMeshArrays, inside?: WindingRule, options?: CallOptions): Promise<MeshArrays>;
  boundary(mesh: CutMeshArrays, inside: Uint8Array | readonly boolean[], options?: CallOptions): Promise<MeshArrays>;
  insideRegions(cutMesh: CutMeshArrays, options?: InsideOptions & CallOptions): Promise<InsideRegions>;
  estimateInside(mesh: Mesh, cutMesh: CutMeshArrays, options?: EstimateOptions & CallOptions): Promise<CutMeshArrays>;
  generalizedWindingNumbers(mesh: Mesh, points: ArrayLike<number>, options?: RunOptions & CallOptions): Promise<Float64Array<ArrayBuffer>>;
  measure(mesh: Mesh, cutMesh: CutMeshArrays, options?: RunOptions & CallOptions): Promise<Measures>;
  cutEdges(mesh: Mesh, cutMesh: CutMeshArrays, options?: CallOptions): Promise<CutEdges>;
  adjacency(cutMesh: CutMeshArrays, options?: CallOptions): Promise<Adjacency>;
  triangulate(cutMesh: CutMeshArrays, of?: undefined, options?: CallOptions): Promise<FaceTriangles>;
  triangulate(cutMesh: CutMeshArrays, of: { cell: number } | { region: number }, options?: CallOptions): Promise<Uint32Array<ArrayBuffer>>;
  cellDrawing(mesh: Mesh, cutMesh: CutMeshArrays, options?: DrawingOptions & CallOptions): Promise<CellDrawing>;
  cellAt(cutMesh: CutMeshArrays, point: Vector3, options?: CallOptions): Promise<Location | null>;
  cellsAt(cutMesh: CutMeshArrays, points: ArrayLike<number>, options?: CallOptions): Promise<Locations>;
  slice(cutMesh: CutMeshArrays, plane: Plane, options?: SliceOptions & CallOptions): Promise<Slice>;
  slices(cutMesh: CutMeshArrays, normal: Vector3, offsets: ArrayLike<number>, options?: SliceOptions & CallOptions): Promise<Slice[]>;
  outlines(cutMesh: CutMeshArrays, normal: Vector3, offsets: ArrayLike<number>, options?: CallOptions): Promise<Outlines[]>;
  readMesh(source: Blob | ArrayBuffer | ArrayBufferView, options?: ReadMeshOptions & CallOptions): Promise<MeshArrays>;
}

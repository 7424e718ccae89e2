// Written by wasm/signatures.mjs from calls.js: change that.
import type {
  Adjacency,
  CutEdges,
  CutMesh,
  CutMeshArrays,
  CutOptions,
  FaceTriangles,
  GridInput,
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
   * A copy of the mesh, checked, welded and resolved once (A, Bad input meshes), which cut() takes with any number of grids. The module
   * keeps the prepared mesh as the twin of this very object, like those of cut-meshes (see CutMesh). If the twin is gone, the next cut
   * prepares the mesh once more; a cut with a snapTolerance always does.
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
   * inside. Inside is by winding numbers, else by parity (see CutMesh); open components are left out. Code "badArgument" for a mesh that
   * has no others, and so bounds no solid. Default rule: "positive".
   */
  boundary(mesh: ResolvedMeshArrays | CutMeshArrays, rule?: WindingRule): MeshArrays;
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
   * the message names the file and the line.
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
  boundary(mesh: ResolvedMeshArrays | CutMeshArrays, rule?: WindingRule, options?: CallOptions): Promise<MeshArrays>;
  measure(mesh: Mesh, cutMesh: CutMeshArrays, options?: RunOptions & CallOptions): Promise<Measures>;
  cutEdges(mesh: Mesh, cutMesh: CutMeshArrays, options?: CallOptions): Promise<CutEdges>;
  adjacency(cutMesh: CutMeshArrays, options?: CallOptions): Promise<Adjacency>;
  triangulate(cutMesh: CutMeshArrays, of?: undefined, options?: CallOptions): Promise<FaceTriangles>;
  triangulate(cutMesh: CutMeshArrays, of: { cell: number } | { region: number }, options?: CallOptions): Promise<Uint32Array<ArrayBuffer>>;
  cellAt(cutMesh: CutMeshArrays, point: Vector3, options?: CallOptions): Promise<Location | null>;
  cellsAt(cutMesh: CutMeshArrays, points: ArrayLike<number>, options?: CallOptions): Promise<Locations>;
  slice(cutMesh: CutMeshArrays, plane: Plane, options?: SliceOptions & CallOptions): Promise<Slice>;
  slices(cutMesh: CutMeshArrays, normal: Vector3, offsets: ArrayLike<number>, options?: SliceOptions & CallOptions): Promise<Slice[]>;
  outlines(cutMesh: CutMeshArrays, normal: Vector3, offsets: ArrayLike<number>, options?: CallOptions): Promise<Outlines[]>;
  readMesh(source: Blob | ArrayBuffer | ArrayBufferView, options?: ReadMeshOptions & CallOptions): Promise<MeshArrays>;
}

/**
 * From three.js to Mandoline and back. Importing this needs three, an optional peer dependency. cellArrays, cellEdgeArrays, untouchedCells,
 * cellColors, meshFromGeometry and meshFromObject handle plain data and also run in a worker, where bundlers then leave three out.
 *
 * Wrong arguments throw a MandolineError with code "badArgument" and the name of the function as its stage.
 */
import type { BufferGeometry, Matrix4, Object3D } from 'three';
import type { CutEdges, CutMesh, FaceTriangles, Measures, Slice, Vector3 } from './index.js';

/**
 * The triangles of an indexed or unindexed BufferGeometry (its draw range and groups aside), moved by the matrix if there is one; with one
 * that mirrors, outward stays outward. A seam whose two sides differ by a rounding, such as that of SphereGeometry, leaves the mesh open:
 * merge its vertices first.
 */
export function meshFromGeometry(
  geometry: BufferGeometry,
  matrix?: Matrix4,
): { positions: Float64Array<ArrayBuffer>; triangles: Uint32Array<ArrayBuffer> };

/**
 * The triangles of all meshes of an object, such as the scene that one of three's loaders makes (GLTFLoader, ThreeMFLoader, VTKLoader ...),
 * merged into one mesh, in the order in which traverse() visits them: each at its place in the world (matrices are updated first), each
 * instance of an InstancedMesh, and skinned or morphed ones as they stand. Mirrored ones stay outward. The object itself is taken whether
 * it is visible or not; of what is in it, only what is visible. What is no mesh, such as points and lines, is left out.
 *
 * Throws a MandolineError that names the mesh: "badIndex" (element: the triangle), "nonFiniteCoordinate" (element: the vertex), and
 * "badArgument" for a BatchedMesh or what is no Object3D.
 */
export function meshFromObject(object: Object3D): { positions: Float64Array<ArrayBuffer>; triangles: Uint32Array<ArrayBuffer> };

/** Of the functions below. One object serves all of them: each uses what concerns it, which its type names. */
export interface DrawOptions {
  /** Cut-cells to take, in this order; those of other regions than `regions` are left out. Default: all. */
  cells?: ArrayLike<number>;
  /** Regions whose cells are taken. Default: all. */
  regions?: ArrayLike<number>;
  /** Faces to take: pieces of triangles, pieces of grid-faces, or both. Default: "all". */
  faces?: 'all' | 'surface' | 'grid';
  /** Subtracted from all positions before they are rounded to 32 bits. Default: 0, 0, 0. */
  origin?: Vector3;
  /** Geometries: moves every cell away from the centre of the grid, by this times the way from there to its centroid. Default 0. */
  explode?: number;
  /** What vertex colours tell. Default: "region". */
  colorBy?: ColorBy;
  /** Needed for colours by volume and to explode cut-cells. */
  measures?: Measures;
}

/**
 * Triangles of cut-cells with flat normals; shared vertices are split, and a face between two cut-cells appears once for each, seen from
 * outside of it.
 */
export interface CellArrays {
  /** 3 per vertex, 3 vertices per triangle. */
  position: Float32Array<ArrayBuffer>;
  /** 3 per vertex: out of the cell. */
  normal: Float32Array<ArrayBuffer>;
  /** Per vertex: the cut-cell. */
  cell: Uint32Array<ArrayBuffer>;
  /** Per vertex: the face. */
  face: Uint32Array<ArrayBuffer>;
}
export function cellArrays(
  cutMesh: CutMesh,
  faceTriangles: FaceTriangles,
  options?: Pick<DrawOptions, 'cells' | 'regions' | 'faces' | 'origin'>,
): CellArrays;

/** Edges of cut-cells, cell by cell: an edge appears once for each of its cells. */
export interface CellEdgeArrays {
  /** 3 per vertex, 2 vertices per edge. */
  position: Float32Array<ArrayBuffer>;
  /** Per vertex: the cut-cell. */
  cell: Uint32Array<ArrayBuffer>;
  /** Per vertex: that of the cut-mesh. */
  vertex: Uint32Array<ArrayBuffer>;
}
export function cellEdgeArrays(cutMesh: CutMesh, options?: Pick<DrawOptions, 'cells' | 'regions' | 'origin'>): CellEdgeArrays;

/** Untouched grid cells in the order of the grid, x fastest. */
export interface UntouchedCells {
  /** 3 per untouched cell: the grid cell (i, j, k). */
  gridCell: Int32Array<ArrayBuffer>;
  /** Per untouched cell. */
  region: Uint32Array<ArrayBuffer>;
}
export function untouchedCells(cutMesh: CutMesh, options?: Pick<DrawOptions, 'regions'>): UntouchedCells;

export type ColorBy = 'region' | 'winding' | 'cell' | 'volume';

/** A geometry for Mesh with the attributes of CellArrays and color. */
export function cellGeometry(cutMesh: CutMesh, faceTriangles: FaceTriangles, options?: DrawOptions): BufferGeometry;

/** A geometry for LineSegments with the attributes of CellEdgeArrays: the edges of what cellGeometry gives with the same options. */
export function cellEdgeGeometry(
  cutMesh: CutMesh,
  options?: Pick<DrawOptions, 'cells' | 'regions' | 'origin' | 'explode' | 'measures'>,
): BufferGeometry;

/**
 * Untouched grid cells as boxes, in the order of untouchedCells: an indexed geometry for Mesh with attributes position, normal and color,
 * 24 vertices and 12 triangles per box.
 */
export function untouchedGeometry(
  cutMesh: CutMesh,
  options?: Pick<DrawOptions, 'regions' | 'origin' | 'colorBy' | 'explode' | 'measures'>,
): BufferGeometry;

/** Their edges: an indexed geometry for LineSegments with the attribute position, 8 vertices and 12 edges per box. */
export function untouchedEdgeGeometry(
  cutMesh: CutMesh,
  options?: Pick<DrawOptions, 'regions' | 'origin' | 'explode' | 'measures'>,
): BufferGeometry;

/** 3 per cut-cell: linear RGB, 0 to 1. Volumes are told on a logarithmic scale over at most three decades below the largest. */
export function cellColors(cutMesh: CutMesh, colorBy: ColorBy, measures?: Measures): Float32Array<ArrayBuffer>;

/** Linear RGB, 0 to 1. */
export type LinearColor = [number, number, number];
/** The colours that cellColors gives, one by one: for a legend, or for what else belongs to a region or cell. */
export function regionColor(region: number): LinearColor;
/** Null for no winding number. */
export function windingColor(winding: number | null): LinearColor;
export function idColor(id: number): LinearColor;
/** From 0 for the smallest volume to 1 for the largest. */
export function volumeColor(fraction: number): LinearColor;
/** For faces by what they are pieces of, for the inside of cut-cells where they are cut open, and for untouched grid cells. */
export const kindColors: Readonly<Record<'surface' | 'grid' | 'inside' | 'untouched', LinearColor>>;
/** For regions outside the surface, where they are told from the others. */
export const outsideColor: LinearColor;

/** The edges of all cells in their places, each once, as an indexed geometry for LineSegments. */
export function edgeGeometry(cutMesh: CutMesh, cutEdges: CutEdges, origin?: Vector3): BufferGeometry;

/** A filled slice with attributes position, normal, color, cell (-1 for untouched grid cells). */
export function sliceGeometry(
  cutMesh: CutMesh,
  slice: Slice,
  options?: Pick<DrawOptions, 'colorBy' | 'measures' | 'origin'>,
): BufferGeometry;

/**
 * From three.js to Mandoline and back. Importing this needs three, an optional peer dependency. cellArrays, cellColors and meshFromGeometry
 * handle plain data and also run in a worker, from whose bundle three then drops out.
 */
import type { BufferGeometry, Matrix4 } from 'three';
import type { CutEdges, CutMesh, FaceTriangles, Measures, Slice, Vector3 } from './index.js';

/**
 * The triangles of an indexed or unindexed BufferGeometry (its draw range and groups aside), moved by the matrix if there is one; with one
 * that mirrors, outward stays outward. Seams that miss themselves by a rounding, as that of SphereGeometry, leave the mesh open: merge
 * their vertices first.
 */
export function meshFromGeometry(geometry: BufferGeometry, matrix?: Matrix4): { positions: Float64Array<ArrayBuffer>; triangles: Uint32Array<ArrayBuffer> };

export interface CellArraysOptions {
  /** Cut-cells to take. Default: all. */
  cells?: ArrayLike<number>;
  /** Faces to take: pieces of triangles, pieces of grid-faces, or both. Default: "all". */
  faces?: 'all' | 'surface' | 'grid';
  /** Subtracted from all positions before they are rounded to 32 bits. Default: 0, 0, 0. */
  origin?: Vector3;
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
export function cellArrays(cutMesh: CutMesh, faceTriangles: FaceTriangles, options?: CellArraysOptions): CellArrays;

export type ColorBy = 'region' | 'winding' | 'cell' | 'volume';

export interface CellGeometryOptions extends CellArraysOptions {
  /** What vertex colours tell. Default: "region". */
  colorBy?: ColorBy;
  /** Needed for colours by volume and to explode. */
  measures?: Measures;
  /** Moves every cell away from the centre of the grid: by this times the way from there to the cell's centroid. Default 0. */
  explode?: number;
}
/** A geometry with attributes position, normal, color, cell and face. */
export function cellGeometry(cutMesh: CutMesh, faceTriangles: FaceTriangles, options?: CellGeometryOptions): BufferGeometry;

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

/** Cut-edges as a geometry for LineSegments. */
export function edgeGeometry(cutMesh: CutMesh, cutEdges: CutEdges, origin?: Vector3): BufferGeometry;

/** A filled slice with attributes position, normal, color, cell (-1 for untouched grid cells). */
export function sliceGeometry(
  cutMesh: CutMesh, slice: Slice, options?: { colorBy?: ColorBy; measures?: Measures; origin?: Vector3 },
): BufferGeometry;

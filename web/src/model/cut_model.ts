// A cut-mesh as it is drawn.
import type { CutStats, Grid, InsideBy, PairCounts, Slice } from 'mandoline-wasm';
import type { ViewPlane } from './slices';
import type { Up } from './up';
import type { Vector3 } from './vector';

export interface RegionInfo {
  id: number;
  isInside: boolean;
  /** Null unless the whole mesh has winding numbers. */
  winding: number | null;
  /** An estimate of the winding number where parts of the mesh are open, else null. */
  insideness: number | null;
  volume: number;
  cutCells: number;
  untouchedCells: number;
}

/** Per cut-cell. */
export interface CellInfo {
  region: Uint32Array;
  volume: Float64Array;
  /** 3 per cell, less the model's origin. */
  centroid: Float32Array;
  gridCell: Int32Array;
}

/** What fills flat cuts, one for each plane. */
export interface Caps {
  planes: readonly ViewPlane[];
  slices: readonly Slice[];
}

/** A cut-mesh, ready to be drawn. Positions in Float32Arrays are less `origin`, the centre of the grid's box. */
export interface Model {
  /** Counts up with every cut. */
  id: number;
  /** Whether it is a moment of a motion. Then `triangles` and `edges` are written over once another model is drawn. */
  isMoving: boolean;
  name: string;
  grid: Grid;
  origin: Vector3;
  /** Of the grid's box. */
  diagonal: number;
  /** Bounding box of the mesh. */
  meshMin: Vector3;
  meshMax: Vector3;
  /** The axis that seems to point upwards. */
  up: Up;
  /** Whether the mesh comes from a file of a format that the package doesn't read. */
  isReadHere: boolean;
  triangleCount: number;
  droppedTriangles: number;
  counts: { cutCells: number; untouchedCells: number; faces: number; vertices: number; regions: number };
  stats: CutStats;
  /** How many pairs of triangles of the mesh, unsnapped, meet other than in shared vertices and edges. */
  crossings: PairCounts;
  /** Time of the estimate of what is inside, or null if there was none to make. */
  estimateMs: number | null;
  regions: RegionInfo[];
  /** What tells which of them are inside. */
  insideBy: InsideBy;
  /** The first outside, or null if all are inside. */
  outsideRegion: number | null;
  cells: CellInfo;
  /** Triangles of all cut-cells, both sides of every face: a face between two cut-cells appears once for each, seen from outside it. */
  triangles: {
    /** 3 per vertex. A vertex belongs to one cut-cell, and to one side of a crease; its position may appear many times. */
    position: Float32Array;
    /** 4 bytes per vertex: the smoothed unit normal of the surface, times 127, on the side of its triangles' normals, and 1; 0 off the surface. */
    normal: Int8Array;
    /** Per vertex: the cut-cell. */
    cell: Uint32Array;
    /** 3 vertices per triangle: first those of pieces of triangles, then those of pieces of grid-faces. */
    index: Uint32Array;
    /** Where the latter begin in `index`. */
    surfaceEnd: number;
  };
  /**
   * Edges of all cut-cells, once for each of their cells: 2 vertices of `triangles` per edge. First hybrid edges, then grid-edges from
   * `hybridEnd`, then pieces of tri-edges from `gridEnd`.
   */
  edges: { index: Uint32Array; hybridEnd: number; gridEnd: number };
  gridCellRegion: Int32Array;
  /** Of the planes with which it was cut; null if none cuts flat. */
  caps: Caps | null;
}

/** What the card of a pinned cell shows. `neighbours` are cut-cells; `cavities` counts shells beyond the outer one. */
export interface CellCard {
  cell: number;
  gridCell: Vector3;
  region: number;
  volume: number;
  centroid: Vector3;
  faces: number;
  surfaceFaces: number;
  vertices: number;
  neighbours: number[];
  untouchedNeighbours: number;
  cavities: number;
  /** The cell alone, less the model's origin. */
  triangles: { position: Float32Array; normal: Float32Array; surface: Uint8Array };
  edges: Float32Array;
}

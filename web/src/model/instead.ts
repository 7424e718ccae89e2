// What can be drawn instead of the model: the steps of the algorithm, and where the surface meets itself.
import type { Bounds } from './grid_around';
import type { Vector3 } from './vector';

/** The steps of the algorithm, shown on the current mesh. */
export type StepKind = 'triEdges' | 'hybridEdges' | 'triangleFaces' | 'axialPlane' | 'gridCell';

/** Which item of a step: a triangle, a plane of an axis, a grid cell. */
export interface StepRequest {
  kind: StepKind;
  triangle?: number;
  axis?: 0 | 1 | 2;
  plane?: number;
  gridCell?: Vector3;
}

/** A picture of a step, less the model's origin; colours are linear RGB per vertex. `text` says what is seen, with counts. */
export interface StepPicture {
  kind: StepKind;
  text: string;
  /** 2 points per line. */
  lines: { position: Float32Array; color: Float32Array };
  /** 3 points per triangle. */
  faces: { position: Float32Array; color: Float32Array };
  points: { position: Float32Array; color: Float32Array };
  /** What to look at. */
  center: Vector3;
  radius: number;
  /** The grid cells that hold the triangle, plane or grid cell, as a box; null for a picture of the whole mesh. */
  frame: Bounds | null;
  /** What a request may ask for: how many items there are and which one this is. */
  choices: { triangles: number; planes: Vector3; request: StepRequest };
}

/** Where the triangles of the input meet other than in shared vertices and edges. */
export interface Crossings {
  kind: 'crossings';
  /** How many pairs of triangles are drawn: all, up to a limit. */
  pairs: number;
  /** 2 points per segment, less the model's origin; a point is a segment of no length. */
  segments: Float32Array;
  /** What to look at: the longest connected curve, with some of its surroundings. */
  center: Vector3;
  radius: number;
}

/** What can be drawn instead of the model, in front of its faint surface. */
export type Instead = StepPicture | Crossings;

import type { Vector3 } from './vector';

/** A place on what is drawn. */
export interface MeasuredPlace {
  /** In world units, before anything is pulled apart. */
  point: Vector3;
  /** Middle of its cell, less the model's origin, and the region: they take it along when cells are pulled apart. */
  middle: Vector3;
  region: number | null;
}

/** A distance while it is measured: the places that are known. */
export interface Measurement {
  from: MeasuredPlace | null;
  to: MeasuredPlace | null;
}

/** From one point to the other. */
export function distance(from: Vector3, to: Vector3): { length: number; along: Vector3 } {
  const along = to.map((x, d) => x - from[d]);
  return { length: Math.hypot(...along), along };
}

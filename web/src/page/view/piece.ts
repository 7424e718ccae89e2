import type { Rgb } from './colors';

/** A drawn triangle, for files: where it is before it is moved, and what moves it. */
export interface Piece {
  /** Its corners at rest: 9 numbers. */
  corners: readonly number[];
  /** The cut-cell; -1 for an untouched grid cell. */
  cell: number;
  /** Centre and region of its cell. */
  middle: ArrayLike<number>;
  region: number;
  color: Rgb;
  /** The plane whose cut it fills, which therefore does not cut it; -1 for none. */
  ownPlane: number;
}

/** Grid-faces are paler than the surface, as the shader draws them. */
export function paler(color: Rgb): Rgb {
  return [0, 1, 2].map((c) => 0.78 * color[c] + 0.22 * 224) as unknown as Rgb;
}

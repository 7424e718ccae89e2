// The corners of a box are numbered by bits: bit d is set on the far side of axis d.

export const boxCorners: readonly number[] = [0, 1, 2, 3, 4, 5, 6, 7];

/** 2 corners per edge: they differ in one bit. */
export const boxEdges: readonly number[] = boxCorners.flatMap((from) => [1, 2, 4].flatMap((bit) => (from & bit ? [] : [from, from | bit])));

/** The corners of this box with such numbers, 3 coordinates each. */
export function boxPoints(corners: readonly number[], min: readonly number[], max: readonly number[]): number[] {
  return corners.flatMap((corner) => [0, 1, 2].map((d) => (corner & (1 << d) ? max[d] : min[d])));
}

// What other ways than cut-cells are given, and what they make.

/** A surface in world units. */
export interface Surface {
  positions: Float64Array;
  triangles: Uint32Array;
}

/** Per point, 3 numbers each: whether it is inside; not outside the grid. */
export type InsideAt = (points: Float64Array) => Uint8Array;

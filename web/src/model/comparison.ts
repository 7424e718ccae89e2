/** What a mesh becomes with the same grid elsewhere: grid cells that are inside or not, or what marching cubes make of their corners. */
export const otherWays = ['voxels', 'cubes'] as const;
export type OtherWay = (typeof otherWays)[number];

export interface Extent {
  volume: number;
  area: number;
}

export interface Comparison {
  way: OtherWay;
  /** The surface that the other way makes: 3 numbers per vertex, less the model's origin; 3 vertices per triangle, seen from outside. */
  position: Float32Array;
  index: Uint32Array;
  /** Of that surface. */
  other: Extent;
  /** Of what is inside the mesh, by the cut-mesh. */
  exact: Extent;
}

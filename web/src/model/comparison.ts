import type { Vector3 } from './vector';

/** What a mesh becomes with the same grid elsewhere: grid cells that are inside or not, or what marching cubes make of their corners. */
export const otherWays = ['voxels', 'cubes'] as const;
export type OtherWay = (typeof otherWays)[number];

/** What stands beside the cut-cells, and where it begins: 0 to 1 of the picture's width. */
export interface CompareSettings {
  way: OtherWay | 'none';
  divider: number;
}

export interface Extent {
  volume: number;
  area: number;
}

/** A closed surface, and its numbers. */
export interface OtherSurface extends Extent {
  /** 3 numbers per vertex, less the comparison's origin. */
  position: Float32Array;
  /** 3 vertices per triangle, counter-clockwise seen from outside. */
  index: Uint32Array;
}

export interface Comparison {
  origin: Vector3;
  ways: Record<OtherWay, OtherSurface>;
  /** Of what is inside the mesh, by the cut-cells. */
  exact: Extent;
}

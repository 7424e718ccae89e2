import type { GridSettings } from './grid_around';
import type { Vector3 } from './vector';

/** What a mesh becomes with the same grid elsewhere: grid cells that are inside or not, or what marching cubes make of their corners. */
export const sameGridWays = ['voxels', 'cubes'] as const;
/** Cut-cells, too, but half or twice as many along each axis. */
export const otherGridWays = ['coarser', 'finer'] as const;
export const otherWays = [...sameGridWays, ...otherGridWays] as const;
export type OtherGridWay = (typeof otherGridWays)[number];
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

/** What is inside, in numbers. */
export interface Inside extends Extent {
  /** Null where there are no cells. */
  cells: { cut: number; untouched: number } | null;
}

/** Evenly spaced planes: the first of each axis, less the comparison's origin, and the distance of the others. */
export interface GridPlanes {
  low: Vector3;
  step: Vector3;
  cells: Vector3;
}

/** A closed surface, and its numbers. */
export interface OtherSurface extends Inside {
  /** 3 numbers per vertex, less the comparison's origin. */
  position: Float32Array;
  /** 3 vertices per triangle, counter-clockwise seen from outside. */
  index: Uint32Array;
  /** What divides it; null if no lines are to show that. */
  grid: GridPlanes | null;
}

export interface Comparison {
  origin: Vector3;
  /** Those with the same grid, and the one with another grid that was asked for. */
  ways: Partial<Record<OtherWay, OtherSurface>>;
  /** Of what is inside the mesh, by the cut-cells. */
  exact: Inside;
}

export function otherGridWay(way: CompareSettings['way']): OtherGridWay | null {
  return otherGridWays.find((known) => known === way) ?? null;
}

export function otherGrid(grid: GridSettings, way: OtherGridWay): GridSettings {
  const change = (cells: number) => (way === 'finer' ? 2 * cells : Math.ceil(cells / 2));
  return 'min' in grid ? { ...grid, cells: grid.cells.map(change) } : { cells: change(grid.cells) };
}

// What is cut and how it is shown, as plain data: all that a link restores.
import type { CompareSettings } from './comparison';
import type { GridSettings } from './grid_around';
import type { Pose } from './motion';
import type { SliceName, SliceSettings } from './slices';
import type { Up } from './up';
import { direction, type Vector3 } from './vector';
import { allVolumes, type VolumeRange } from './volumes';
import { defaultWindCells, type WindSettings } from './wind';

export const colorings: readonly ColorBy[] = ['region', 'winding', 'cell', 'volume', 'kind'];
export const layers = ['surface', 'gridFaces', 'edges', 'untouched', 'cutCells', 'outside'] as const;
export const ups: readonly Settings['up'][] = ['auto', 'x', 'y', 'z'];
export const defaultSource: Source = { kind: 'gallery', name: 'bunny' };

/** Where a mesh comes from. A file's bytes are kept by the worker; a link can't restore it. */
export type Source = { kind: 'gallery'; name: string } | { kind: 'url'; url: string } | { kind: 'file'; name: string };

export type ColorBy = 'region' | 'winding' | 'cell' | 'volume' | 'kind';

/** How a mesh is cut. */
export interface Cutting {
  grid: GridSettings;
  snapTolerance: number;
  /** The moment of a motion at which it is cut; a grid without a box then has room for all of the motion. Null for the mesh as it is. */
  pose: Pose | null;
}

/** How a cut is sliced at once: its caps come with it. */
export type Slicing = Pick<LookSettings, 'slices' | 'sliceMode'>;

/** What is cut, and how. */
export interface CutSettings extends Cutting {
  source: Source;
}

/** How it is shown. */
export interface LookSettings {
  slices: Record<SliceName, SliceSettings>;
  /** Cells are shown whole or cut flat with filled caps. */
  sliceMode: 'whole' | 'flat';
  /** 0 to 1. */
  explode: { cells: number; regions: number };
  colorBy: ColorBy;
  show: {
    /** Pieces of triangles. */
    surface: boolean;
    /** Pieces of grid-faces. */
    gridFaces: boolean;
    edges: boolean;
    untouched: boolean;
    cutCells: boolean;
    /** Cells of regions outside the surface. */
    outside: boolean;
    /** Only this region, or null for all. */
    region: number | null;
  };
  /** Cut-cells of other volumes are faint. */
  volumes: VolumeRange;
  /** "auto" takes the mesh's guess. */
  up: Up | 'auto';
  camera: { position: Vector3; target: Vector3 } | null;
  wind: WindSettings;
  compare: CompareSettings;
}

/** All that a link restores. Plain data. */
export type Settings = CutSettings & LookSettings;

export function defaultSettings(): Settings {
  return {
    source: defaultSource,
    grid: { cells: 16 },
    snapTolerance: 0,
    pose: null,
    slices: {
      x: { on: false, position: 0.5, normal: [1, 0, 0] },
      y: { on: false, position: 0.5, normal: [0, 1, 0] },
      z: { on: false, position: 0.5, normal: [0, 0, 1] },
      free: { on: false, position: 0.52, normal: direction([0.75, 0.1, 0.65]) },
    },
    sliceMode: 'whole',
    explode: { cells: 0.06, regions: 0 },
    colorBy: 'kind',
    show: { surface: true, gridFaces: true, edges: true, untouched: true, cutCells: true, outside: false, region: null },
    volumes: allVolumes,
    up: 'auto',
    camera: null,
    wind: { on: false, smoke: false, direction: [1, 0, 0], show: 'none', cells: defaultWindCells },
    compare: { way: 'none', divider: 0.5 },
  };
}

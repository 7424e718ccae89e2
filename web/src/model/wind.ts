// The wind tunnel: what is asked for and what is drawn of it.
import type { Pose } from './motion';
import type { Vector3 } from './vector';

export const windColorings = ['none', 'speed', 'pressure'] as const;
/** What colours the surface, and the section if the model is sliced. */
export type WindColoring = (typeof windColorings)[number];

export interface WindSettings {
  on: boolean;
  /** Whether smoke shows a flow in time, instead of lines the one that has a potential. */
  smoke: boolean;
  /** Unit: where it blows to. */
  direction: Vector3;
  show: WindColoring;
  /** Grid cells along the longest side of the tunnel, which is a mesh with a margin around it. */
  cells: number;
}

/** The margin on every side, in longest sides of the mesh: that of the command line. */
export const windMargin = 0.5;
export const defaultWindCells = 48;
export const mostWindCells = 128;

/** A flow to draw, of a wind of length 1. Speeds are those of the wind = 1. */
export interface WindRequest {
  /** Id of the mesh. */
  mesh: number;
  pose: Pose | null;
  cells: number;
  direction: Vector3;
  /** Whether the speed at the surface is wanted. */
  surface: boolean;
  /** The tunnel whose surface is there already. */
  known: string;
  /** Of sections, in world units. */
  planes: readonly { normal: Vector3; offset: number }[];
}

/** Triangles. */
export interface Shape {
  position: Float32Array;
  index: Uint32Array;
}

/** Its positions are less `origin`, the middle of the tunnel. */
export interface Wind {
  /** The same for every flow through the same cells. */
  tunnel: string;
  direction: Vector3;
  origin: Vector3;
  /** Half the extent of the tunnel. */
  half: Vector3;
  /** Longest side of the mesh. */
  size: number;
  lines: {
    position: Float32Array;
    speed: Float32Array;
    /** When what enters the tunnel at 0 arrives at a point: distances over speeds, world units. */
    arrival: Float32Array;
    /** Into the points, per line. */
    offsets: Uint32Array;
  };
  /** The sides of the surface that wind can reach, with the speed at each point. */
  surface: { shape: Shape | null; speed: Float32Array } | null;
  /** Per plane: the cells in it, with the speed at each point (-1 where nothing can flow) and their outlines, 2 points per line. */
  sections: { plane: WindRequest['planes'][number]; shape: Shape; speed: Float32Array; edges: Float32Array }[];
  stats: WindStats;
}

export type SmokeRequest = Pick<WindRequest, 'mesh' | 'pose' | 'direction'>;

/** A flow in time of a wind of length 1, about a mesh in a box that reaches far behind it. */
export interface Smoke {
  direction: Vector3;
  /** The middle of the mesh. */
  origin: Vector3;
  /** Longest side of the mesh. */
  size: number;
  /** Half the extent of the mesh. */
  half: Vector3;
  /** The velocities' grid: its lower corner less `origin`, the side of a cell, and how many there are along each axis. */
  corner: Vector3;
  side: number;
  counts: Vector3;
  cells: number;
  begin: SmokeState;
}

/** The flow between two of its states. */
export interface SmokeMoment {
  from: SmokeState;
  to: SmokeState;
  /** 0 at `from`, 1 at `to`. */
  share: number;
  time: number;
}

/** A flow that goes on while it is drawn. */
export interface SmokeSource {
  readonly smoke: Smoke;
  /** What is drawn this many seconds later. */
  advance(seconds: number): SmokeMoment;
}

/** What the page says of it. */
export interface SmokeNumbers extends Pick<SmokeState, 'time' | 'drag' | 'lift'> {
  /** In longest sides of the mesh. */
  time: number;
  cells: number;
  counts: Vector3;
  /** 0 before there were any. */
  stepsPerSecond: number;
}

/** The flow at one time. */
export interface SmokeState {
  /** The wind covers this distance in it: world units. */
  time: number;
  /** 3 per cell of the grid, x first; 0 in bodies. */
  velocity: Float32Array;
  /** What the flow does to the mesh, along the wind and across it, relative to half its density, its square speed and the mesh's square size. */
  drag: number;
  lift: number;
}

export interface WindStats {
  /** Number of grid cells along each axis. */
  grid: Vector3;
  cells: number;
  cutCells: number;
  /** Of all cells, at their centroids. */
  largestSpeed: number;
  smallestPressure: number;
  /** Whether the surface divides the tunnel, so that the wind is held back in parts of it. */
  isThrottled: boolean;
  /** In ms: of making the cells, of the flow and of the lines and colours; 0 for what was there already. */
  times: { cells: number; flow: number; picture: number };
}

export const windFormats = ['csv', 'vtu', 'obj'] as const;
/** CSV and VTU of the cells, OBJ of the streamlines. */
export type WindFormat = (typeof windFormats)[number];

// What the page asks its worker thread, beside the package's own calls.
import type { Slice } from 'mandoline-wasm';
import type { Vector3 } from './vector';
import type { Checks } from './checks';
import type { Comparison, OtherGridWay } from './comparison';
import type { Bounds } from './grid_around';
import type { CellCard, Model } from './cut_model';
import type { Crossings, StepPicture, StepRequest } from './instead';
import type { Cutting, Slicing, Source } from './settings';
import type { Up } from './up';
import type { Smoke, SmokeRequest, SmokeState, Wind, WindFormat, WindRequest } from './wind';

/** A mesh as both sides keep it. */
export interface LoadedMesh {
  /** Counts up with every mesh. */
  id: number;
  name: string;
  positions: Float64Array;
  triangles: Uint32Array;
  bounds: Bounds;
  /** The axis that seems to point upwards. */
  up: Up;
  /** Whether it comes from a file of a format that the package doesn't read. */
  isReadHere: boolean;
}

/** How a cut is made. Cutting again gives the same ids, bit by bit. */
export interface Recipe extends Cutting {
  /** The Model's: counts up with every cut. */
  id: number;
  /** Id of the mesh. */
  mesh: number;
}

/** What is asked, and what comes. */
export interface Calls {
  load: { ask: { id: number; source: Source; bytes?: ArrayBuffer }; answer: LoadedMesh };
  /** Loads the readers of files that the thread would else load when it first needs them. */
  loadAhead: { ask: null; answer: void };
  /** Gives a mesh to a thread that took the place of another. */
  keep: { ask: LoadedMesh; answer: void };
  /** Gives back the buffers of a model, for the next one of a surface that moves. */
  reuse: { ask: ArrayBuffer[]; answer: void };
  cut: { ask: AboutCut<{ slicing: Slicing }>; answer: Model };
  slice: { ask: AboutCut<{ planes: readonly { normal: Vector3; offset: number }[]; untouched: boolean }>; answer: Slice[] };
  validate: { ask: AboutCut; answer: Checks };
  /** The number of cut-edges. */
  edges: { ask: AboutCut; answer: number };
  card: { ask: AboutCut<{ cell: number }>; answer: CellCard };
  crossings: { ask: AboutCut; answer: Crossings };
  compare: { ask: AboutCut<{ way: OtherGridWay | null }>; answer: Comparison };
  step: { ask: AboutCut<{ request: StepRequest }>; answer: StepPicture };
  /** The mesh that was cut, as OBJ. */
  writeMesh: { ask: AboutCut; answer: Uint8Array };
  write: { ask: AboutCut<{ format: 'json' | 'vtu' | 'obj' }>; answer: Uint8Array };
  /** Answered after all that was asked before. */
  end: { ask: null; answer: void };
}
export type CallName = keyof Calls;

/** What is asked of the thread of the wind tunnel. */
export interface WindCalls {
  keep: { ask: LoadedMesh; answer: void };
  wind: { ask: WindRequest; answer: Wind };
  /** Loads the modules that compute and write. */
  loadWind: { ask: null; answer: void };
  /** Makes a picture that may be asked for next, and keeps what takes long. */
  windAhead: { ask: WindRequest; answer: void };
  /** Solves for another wind, so that it can be turned at once; whether there may be more to do. */
  turnAhead: { ask: null; answer: boolean };
  /** Begins a flow in time, which takes the place of another one. */
  smoke: { ask: SmokeRequest; answer: Smoke };
  /** Its next state. */
  smokeStep: { ask: null; answer: SmokeState };
  /** Answered after all that was asked before. */
  end: { ask: null; answer: void };
  writeWind: { ask: { request: Omit<WindRequest, 'known'>; format: WindFormat }; answer: Uint8Array };
}
export type WindCallName = keyof WindCalls;

/** About the cut-mesh of this recipe, which the thread holds or makes again. */
export type AboutCut<More = unknown> = { recipe: Recipe } & More;

/** How far a call has come, 0 to 1. */
export interface CallProgress {
  stage: string;
  fraction: number;
}

/** Thrown by a thread that lacks the mesh which a call is about: the answer is to give it that and to ask again. */
export interface Lack {
  lacksMesh: number;
}

/** Thrown by a thread that already holds a newer cut. */
export interface Outdated {
  outdated: true;
}

export function isLack(error: unknown): error is Lack {
  return typeof error === 'object' && error !== null && 'lacksMesh' in error;
}

export function isOutdated(error: unknown): error is Outdated {
  return typeof error === 'object' && error !== null && 'outdated' in error;
}

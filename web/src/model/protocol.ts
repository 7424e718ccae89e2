// What the engine and its worker say to each other.
import type { Slice, Validation, Vector3 } from 'mandoline-wasm';
import type { CellCard, GridSettings, Model, PageError, Source, StepPicture, StepRequest } from './types';

export interface EngineMesh {
  name: string;
  positions: Float64Array;
  triangles: Uint32Array;
}

/** How a cut is made. Cutting again gives the same ids, bit by bit. */
export interface CutRecipe {
  model: number;
  mesh: EngineMesh;
  grid: GridSettings;
  snapTolerance: number;
}

/** What a call asks and gets. All but `load` and `cut` are about the cut-mesh of the newest Model. */
export interface Calls {
  load: { ask: { source: Source; bytes?: ArrayBuffer }; answer: EngineMesh };
  cut: { ask: { model: number; grid: GridSettings; snapTolerance: number }; answer: Model };
  slice: { ask: { planes: { normal: Vector3; offset: number }[]; untouched: boolean }; answer: Slice[] };
  validate: { ask: null; answer: Validation };
  card: { ask: { cell: number }; answer: CellCard };
  step: { ask: StepRequest; answer: StepPicture };
  write: { ask: 'json' | 'vtu' | 'obj'; answer: Uint8Array };
}
export type CallName = keyof Calls;

export type Call = { [K in CallName]: { kind: 'call'; id: number; name: K; ask: Calls[K]['ask'] } }[CallName];

/** The first message. A worker that takes the place of a stopped one gets what that one knew. */
export interface Start {
  kind: 'start';
  wasm: WebAssembly.Module | null;
  mesh: EngineMesh | null;
  shown: CutRecipe | null;
}

export type ToWorker = Start | Call;

export type FromWorker =
  | { kind: 'ready'; wasm: WebAssembly.Module }
  | { kind: 'progress'; stage: string; fraction: number }
  | { kind: 'answer'; id: number; answer: unknown }
  | { kind: 'error'; id: number; error: PageError };

/** An answer and the buffers to hand over with it. */
export interface Answered<T> {
  answer: T;
  transfer: ArrayBuffer[];
}

/** The buffers of all typed arrays among the values. */
export function buffersOf(...values: unknown[]): ArrayBuffer[] {
  return values.filter((value) => ArrayBuffer.isView(value)).map((view) => view.buffer as ArrayBuffer);
}

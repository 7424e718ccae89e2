// What the page asks of its workers.
import type { Slice } from 'mandoline-wasm';
import type { Checks } from './checks';
import type { Comparison, OtherGridWay } from './comparison';
import type { CellCard, Model } from './cut_model';
import type { Bounds } from './grid_around';
import type { Crossings, StepPicture, StepRequest } from './instead';
import type { Cutting, Slicing, Source } from './settings';
import type { Vector3 } from './vector';
import type { Smoke, SmokeRequest, SmokeState, Wind, WindFormat, WindRequest } from './wind';

/** What the page knows of a mesh. */
export interface MeshInfo {
  name: string;
  triangles: number;
  bounds: Bounds;
}

/** About the mesh that is shown. */
type AboutShown<Request> = Omit<Request, 'mesh' | 'known'>;

/** The worker's side of the page. Of several cuts under way the newest wins: the others reject with an AbortError. */
export interface Engine {
  /** Loads the mesh of a source (bytes with a file) and keeps it. Rejects with a PageError. */
  load(source: Source, bytes?: ArrayBuffer): Promise<MeshInfo>;
  /** Loads the readers of files before a file is opened. */
  loadAhead(): Promise<void>;
  cut(cutting: Cutting, slicing: Slicing): Promise<Model>;
  /** Takes back a model that is not needed any more, to write later ones over it. */
  reuse(model: Model): void;
  /** Ends the load or cut under way: they reject with an AbortError. */
  cancel(): void;
  onProgress: (progress: { stage: string; fraction: number } | null) => void;
  /** Caps of the planes through the current cut-mesh; planes in world units. */
  slice(planes: { normal: Vector3; offset: number }[], untouched: boolean): Promise<Slice[]>;
  validate(): Promise<Checks>;
  /** The number of cut-edges, which few ask for. */
  countEdges(): Promise<number>;
  card(cell: number): Promise<CellCard>;
  step(request: StepRequest): Promise<StepPicture>;
  crossings(): Promise<Crossings>;
  /** What is inside in other ways than cut-cells with the same grid, and by cut-cells with another one. */
  compare(way: OtherGridWay | null): Promise<Comparison>;
  write(format: 'json' | 'vtu' | 'obj'): Promise<Uint8Array>;
  /** The mesh as it was cut, as OBJ. */
  writeMesh(): Promise<Uint8Array>;
  /**
   * The flow about the mesh that is shown. Of several under way the newest wins: those before it reject with an AbortError. By default it may
   * be turned next, which is prepared.
   */
  wind(request: AboutShown<WindRequest>, isTurned?: boolean): Promise<Wind>;
  /** Prepares that: keeps what takes long of a flow that may be asked for next. */
  windAhead(request: AboutShown<WindRequest>): Promise<void>;
  /** Ends the flow under way. */
  cancelWind(): void;
  /** Begins a flow in time about the mesh of the shown model. Of several that are asked for the newest wins, as with wind(). */
  smoke(request: Pick<SmokeRequest, 'pose' | 'direction'>): Promise<Smoke>;
  /** Its next state. */
  smokeStep(): Promise<SmokeState>;
  /** Ends what is under way of it, and gives back its memory. */
  endSmoke(): void;
  writeWind(request: AboutShown<WindRequest>, format: WindFormat): Promise<Uint8Array>;
}

// What the parts of the page say to each other.
import type { CutStats, Grid, InsideBy, PairCounts, Slice } from 'mandoline-wasm';
import type { Vector3 } from './vector';
import type { Checks } from './checks';
import type { MeasuredPlace, Measurement } from './measurement';
import type { Comparison, CompareSettings, OtherGridWay } from './comparison';
import type { Bounds } from './grid_around';
import type { Pose } from './motion';
import type { ViewPlane } from './planes';
import type { VolumeRange } from './volumes';
import type { Smoke, SmokeRequest, SmokeSource, SmokeState, Wind, WindFormat, WindRequest, WindSettings } from './wind';

/** Where a mesh comes from. A file's bytes are kept by the worker; a link can't restore it. */
export type Source = { kind: 'gallery'; name: string } | { kind: 'url'; url: string } | { kind: 'file'; name: string };

/** Cubic cells around the mesh, `cells` along its longest side; or a box with its own counts. */
export type GridSettings = { cells: number } | { min: Vector3; max: Vector3; cells: Vector3 };

export type Axis = 'x' | 'y' | 'z';
/** The axis of a mesh that points upwards. */
export type Up = 'x' | 'y' | 'z';
export type SliceName = Axis | 'free';

/** A slice plane. Cells on the side that its normal points to are hidden. */
export interface SliceSettings {
  on: boolean;
  /** 0 to 1 along the diagonal of the grid's box in the direction of the normal: 0 hides all, 1 nothing. */
  position: number;
  /** Unit; for x, y and z the axis or, flipped, its opposite. */
  normal: Vector3;
}

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

export interface RegionInfo {
  id: number;
  isInside: boolean;
  /** Null unless the whole mesh has winding numbers. */
  winding: number | null;
  /** An estimate of the winding number where parts of the mesh are open, else null. */
  insideness: number | null;
  volume: number;
  cutCells: number;
  untouchedCells: number;
}

/** Per cut-cell. */
export interface CellInfo {
  region: Uint32Array;
  volume: Float64Array;
  /** 3 per cell, less the model's origin. */
  centroid: Float32Array;
  gridCell: Int32Array;
}

/** What fills flat cuts, one for each plane. */
export interface Caps {
  planes: readonly ViewPlane[];
  slices: readonly Slice[];
}

/** A cut-mesh, ready to be drawn. Positions in Float32Arrays are less `origin`, the centre of the grid's box. */
export interface Model {
  /** Counts up with every cut. */
  id: number;
  /** Whether it is a moment of a motion. Then `triangles` and `edges` are written over once another model is drawn. */
  isMoving: boolean;
  name: string;
  grid: Grid;
  origin: Vector3;
  /** Of the grid's box. */
  diagonal: number;
  /** Bounding box of the mesh. */
  meshMin: Vector3;
  meshMax: Vector3;
  /** The axis that seems to point upwards. */
  up: Up;
  /** Whether the mesh comes from a file of a format that the package doesn't read. */
  isReadHere: boolean;
  triangleCount: number;
  droppedTriangles: number;
  counts: { cutCells: number; untouchedCells: number; faces: number; vertices: number; regions: number };
  stats: CutStats;
  /** How many pairs of triangles of the mesh, unsnapped, meet other than in shared vertices and edges. */
  crossings: PairCounts;
  /** Time of the estimate of what is inside, or null if there was none to make. */
  estimateMs: number | null;
  regions: RegionInfo[];
  /** What tells which of them are inside. */
  insideBy: InsideBy;
  /** The first outside, or null if all are inside. */
  outsideRegion: number | null;
  cells: CellInfo;
  /** Triangles of all cut-cells, both sides of every face: a face between two cut-cells appears once for each, seen from outside it. */
  triangles: {
    /** 3 per vertex. A vertex belongs to one cut-cell, and to one side of a crease; its position may appear many times. */
    position: Float32Array;
    /** 4 bytes per vertex: the smoothed unit normal of the surface, times 127, on the side of its triangles' normals, and 1; 0 off the surface. */
    normal: Int8Array;
    /** Per vertex: the cut-cell. */
    cell: Uint32Array;
    /** 3 vertices per triangle: first those of pieces of triangles, then those of pieces of grid-faces. */
    index: Uint32Array;
    /** Where the latter begin in `index`. */
    surfaceEnd: number;
  };
  /**
   * Edges of all cut-cells, once for each of their cells: 2 vertices of `triangles` per edge. First hybrid edges, then grid-edges from
   * `hybridEnd`, then pieces of tri-edges from `gridEnd`.
   */
  edges: { index: Uint32Array; hybridEnd: number; gridEnd: number };
  gridCellRegion: Int32Array;
  /** Of the planes with which it was cut; null if none cuts flat. */
  caps: Caps | null;
}

/** What the card of a pinned cell shows. `neighbours` are cut-cells; `cavities` counts shells beyond the outer one. */
export interface CellCard {
  cell: number;
  gridCell: Vector3;
  region: number;
  volume: number;
  centroid: Vector3;
  faces: number;
  surfaceFaces: number;
  vertices: number;
  neighbours: number[];
  untouchedNeighbours: number;
  cavities: number;
  /** The cell alone, less the model's origin. */
  triangles: { position: Float32Array; normal: Float32Array; surface: Uint8Array };
  edges: Float32Array;
}

/** The steps of the algorithm, shown on the current mesh. */
export type StepKind = 'triEdges' | 'hybridEdges' | 'triangleFaces' | 'axialPlane' | 'gridCell';

/** Which item of a step: a triangle, a plane of an axis, a grid cell. */
export interface StepRequest {
  kind: StepKind;
  triangle?: number;
  axis?: 0 | 1 | 2;
  plane?: number;
  gridCell?: Vector3;
}

/** A picture of a step, less the model's origin; colours are linear RGB per vertex. `text` says what is seen, with counts. */
export interface StepPicture {
  kind: StepKind;
  text: string;
  /** 2 points per line. */
  lines: { position: Float32Array; color: Float32Array };
  /** 3 points per triangle. */
  faces: { position: Float32Array; color: Float32Array };
  points: { position: Float32Array; color: Float32Array };
  /** What to look at. */
  center: Vector3;
  radius: number;
  /** The grid cells that hold the triangle, plane or grid cell, as a box; null for a picture of the whole mesh. */
  frame: Bounds | null;
  /** What a request may ask for: how many items there are and which one this is. */
  choices: { triangles: number; planes: Vector3; request: StepRequest };
}

/** Where the triangles of the input meet other than in shared vertices and edges. */
export interface Crossings {
  kind: 'crossings';
  /** How many pairs of triangles are drawn: all, up to a limit. */
  pairs: number;
  /** 2 points per segment, less the model's origin; a point is a segment of no length. */
  segments: Float32Array;
  /** What to look at: the longest connected curve, with some of its surroundings. */
  center: Vector3;
  radius: number;
}

/** What can be drawn instead of the model, in front of its faint surface. */
export type Instead = StepPicture | Crossings;

/** An error to show: what is wrong and where. */
export interface PageError {
  title: string;
  detail: string;
}

/** What the page knows of a mesh. */
export interface MeshInfo {
  name: string;
  triangles: number;
  bounds: Bounds;
}

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

/** A film under way. */
export interface Recording {
  /** Of the file, without codecs: for example "video/webm". */
  type: string;
  stop(): Promise<Blob>;
}
/** About the mesh that is shown. */
type AboutShown<Request> = Omit<Request, 'mesh' | 'known'>;

/** The mesh's axes as the camera sees them: how far each points to the right, up, and to the viewer. */
export type AxesSeen = readonly [Vector3, Vector3, Vector3];

export interface PictureOptions {
  /** How many times the pixels of the screen per side. */
  times: number;
  isTransparent: boolean;
}

export interface Picture {
  blob: Blob;
  /** In pixels. */
  width: number;
  height: number;
  /** Whether it has fewer pixels than asked for, since the GPU has room for no more. */
  isSmaller: boolean;
}

/** What can be saved of the view. */
export interface ViewFiles {
  /** Everything that is seen, at the current explosion. */
  png(options: PictureOptions): Promise<Picture>;
  /** The same as one mesh, or with a node for each cell. */
  glb(isByCell: boolean): Promise<Blob>;
  /** What a plane cuts. */
  svg(name: SliceName): Promise<Blob>;
  /** Films the canvas from now on. Throws a PageError where the browser can't. */
  record(): Recording;
}

/** What is drawn. Owns the canvas; knows nothing of panels. */
export interface View {
  /** Draws this model instead of the last one, with the look that is set next; keeps the camera unless it is to fit the model. */
  setModel(model: Model, frame: boolean): void;
  /** Draws nothing until the next model. */
  clear(): void;
  /** Applies slices, explosion, colours and visibility. */
  setLook(settings: Settings): void;
  /** Draws this instead of the model, or the model again. */
  setInstead(instead: Instead | null): void;
  /** Draws the other way of this right of the divider, or the model alone. */
  setComparison(comparison: Comparison | null): void;
  /** Nothing of a former model is needed here any more. */
  onSpent: (model: Model) => void;
  setPinned(cell: number | null): void;
  /** Taps set the places of this distance from now on, which is drawn; null ends that. */
  setMeasurement(measurement: Measurement | null): void;
  onMeasured: (place: MeasuredPlace) => void;
  /** Draws this flow, or none. */
  setWind(wind: Wind | null): void;
  /** Draws this smoke, or none. */
  setSmoke(smoke: SmokeSource | null): void;
  onHover: (cell: number | null) => void;
  onPick: (cell: number | null) => void;
  /** The camera has turned. */
  onTurned: (axes: AxesSeen) => void;
  /** The camera was moved, by the person. */
  onCamera: (camera: NonNullable<Settings['camera']>) => void;
  /** The free plane was moved with its gizmo. */
  onFreePlane: (slice: SliceSettings) => void;
  /** The wind was turned with its handle. */
  onWind: (direction: Vector3) => void;
  setScheme(dark: boolean): void;
  readonly files: ViewFiles;
  /** How many pictures of models have been drawn. */
  readonly pictures: number;
  frame(): void;
  /** Flies to where the camera looks at the model from this direction. */
  lookFrom(direction: Vector3): void;
}

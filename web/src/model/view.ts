// What draws.
import type { Comparison } from './comparison';
import type { Model } from './cut_model';
import type { Instead } from './instead';
import type { MeasuredPlace, Measurement } from './measurement';
import type { Settings } from './settings';
import type { SliceName, SliceSettings } from './slices';
import type { Vector3 } from './vector';
import type { SmokeSource, Wind } from './wind';

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

/** A film under way. */
export interface Recording {
  /** Of the file, without codecs: for example "video/webm". */
  type: string;
  stop(): Promise<Blob>;
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

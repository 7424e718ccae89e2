// What the view is made of. To add something that is drawn, add a layer.
import type { Object3D } from 'three';
import type { Slice } from 'mandoline-wasm';
import type { Model } from '../../model/cut_model';
import type { Instead } from '../../model/instead';
import type { Settings } from '../../model/settings';
import type { ViewPlane } from '../../model/slices';
import type { Comparison } from '../../model/comparison';
import type { Measurement } from '../../model/measurement';
import type { SmokeSource, Wind } from '../../model/wind';
import type { Piece } from './piece';

/** All that decides what is drawn. */
export interface Look {
  model: Model;
  settings: Settings;
  /** Per region: 1 if it is shown. */
  regions: Uint8Array;
  /** 3 per region: how it moves in an explosion by region. */
  shifts: Float32Array;
  /** They cut what is drawn. */
  planes: readonly ViewPlane[];
  /** What fills flat cuts, one for each of the planes or none at all; `id` counts them. */
  caps: { id: number; slices: readonly Slice[] };
  /** What is drawn instead of the model, if anything. */
  instead: Instead | null;
  /** The flow about the mesh, if there is a wind. */
  wind: Wind | null;
  /** What its flow in time carries instead, if it has one. */
  smoke: SmokeSource | null;
  /** The distance that is measured, if one is. */
  measurement: Measurement | null;
  /** What is drawn right of a divider in other ways, if it is. */
  comparison: Comparison | null;
}

/** A part of the picture. Its coordinates are the model's, less the model's origin. */
export interface Layer {
  readonly object: Object3D;
  /** What is drawn to find out which cell is seen at a point. */
  readonly pick?: Object3D;
  /** What casts a shadow on the ground. */
  readonly caster?: Object3D;
  /** Takes the buffers of a new model, whose look is set next. */
  setModel?(model: Model): void;
  /** What setLook() makes its work of: it is called once one of these is not the same value, or the same object, any more. */
  dependsOn(look: Look): readonly unknown[];
  setLook(look: Look): void;
  /** Moves what moves by itself, before each frame, to a time in seconds. Gives whether it goes on moving. */
  animate?(seconds: number): boolean;
  setPixelRatio?(ratio: number): void;
  /** The triangles that it draws; of one cut-cell, if only those are wanted, or one box, or what has neither: both are -1 then. */
  forEachPiece?(take: (piece: Piece) => void, only?: { cell: number; box: number }): void;
}

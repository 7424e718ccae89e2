// Slice planes along the axes and a free one.
import type { Vector3 } from './vector';

export const axes: readonly Axis[] = ['x', 'y', 'z'];
export const sliceNames: readonly SliceName[] = [...axes, 'free'];

export type Axis = 'x' | 'y' | 'z';

export type SliceName = Axis | 'free';

/** A slice plane. Cells on the side that its normal points to are hidden. */
export interface SliceSettings {
  on: boolean;
  /** 0 to 1 along the diagonal of the grid's box in the direction of the normal: 0 hides all, 1 nothing. */
  position: number;
  /** Unit; for x, y and z the axis or, flipped, its opposite. */
  normal: Vector3;
}

/** A slice plane normal . x = offset, less the model's origin. What lies beyond it is hidden. */
export interface ViewPlane {
  name: SliceName;
  normal: readonly [number, number, number];
  offset: number;
}

export function axisNormal(axis: Axis, sign: number): Vector3 {
  return [axis === 'x' ? sign : 0, axis === 'y' ? sign : 0, axis === 'z' ? sign : 0];
}

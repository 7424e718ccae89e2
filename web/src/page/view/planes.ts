import type { Model, Settings, SliceName } from '../../model/types';

/** A slice plane normal . x = offset, less the model's origin. What lies beyond it is hidden. */
export interface ViewPlane {
  name: SliceName;
  normal: readonly [number, number, number];
  offset: number;
}

export const sliceOrder: readonly SliceName[] = ['x', 'y', 'z', 'free'];

/** Half the extent of the grid's box along a direction. */
export function reach(model: Model, normal: readonly number[]): number {
  return model.grid.planes.reduce((sum, planes, d) => sum + (Math.abs(normal[d]) * (planes[planes.length - 1] - planes[0])) / 2, 0);
}

export function planeOf(model: Model, settings: Settings, name: SliceName): ViewPlane {
  const { normal, position } = settings.slices[name];
  return { name, normal: [normal[0], normal[1], normal[2]], offset: (2 * position - 1) * reach(model, normal) };
}

/** The planes that are on and hide something. */
export function activePlanes(model: Model, settings: Settings): ViewPlane[] {
  const active = sliceOrder.filter((name) => settings.slices[name].on && settings.slices[name].position < 1);
  return active.map((name) => planeOf(model, settings, name));
}

export function isBeyond(planes: readonly ViewPlane[], x: number, y: number, z: number): boolean {
  return planes.some(({ normal, offset }) => normal[0] * x + normal[1] * y + normal[2] * z > offset);
}

/** Whether a whole box lies beyond one of the planes. */
export function isBoxBeyond(planes: readonly ViewPlane[], min: readonly number[], max: readonly number[]): boolean {
  return planes.some(({ normal, offset }) => normal.reduce((sum, n, d) => sum + n * (n > 0 ? min[d] : max[d]), 0) >= offset);
}

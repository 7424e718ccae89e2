import type { Model } from './cut_model';
import type { Settings, Slicing } from './settings';
import { sliceNames, type SliceName, type ViewPlane } from './slices';
import type { Vector3 } from './vector';

type Gridded = Pick<Model, 'grid'>;

/** Half the extent of the grid's box along a direction. */
export function reach({ grid }: Gridded, normal: readonly number[]): number {
  return grid.planes.reduce((sum, planes, d) => sum + (Math.abs(normal[d]) * (planes[planes.length - 1] - planes[0])) / 2, 0);
}

export function planeOf(model: Gridded, settings: Pick<Settings, 'slices'>, name: SliceName): ViewPlane {
  const { normal, position } = settings.slices[name];
  return { name, normal: [normal[0], normal[1], normal[2]], offset: (2 * position - 1) * reach(model, normal) };
}

/** The planes that are on and hide something. */
export function activePlanes(model: Gridded, settings: Pick<Settings, 'slices'>): ViewPlane[] {
  const active = sliceNames.filter((name) => settings.slices[name].on && settings.slices[name].position < 1);
  return active.map((name) => planeOf(model, settings, name));
}

/** In world units, of planes less the model's origin. */
export function inWorld(planes: readonly ViewPlane[], origin: Vector3): { normal: Vector3; offset: number }[] {
  return planes.map(({ normal, offset }) => ({ normal: [...normal], offset: normal.reduce((sum, n, d) => sum + n * origin[d], offset) }));
}

/** Those that cut cells flat, so that caps fill them. */
export function flatPlanes(model: Gridded, slicing: Slicing): ViewPlane[] {
  return slicing.sliceMode === 'flat' ? activePlanes(model, slicing) : [];
}

export function isBeyond(planes: readonly ViewPlane[], x: number, y: number, z: number): boolean {
  return planes.some(({ normal, offset }) => normal[0] * x + normal[1] * y + normal[2] * z > offset);
}

/** Whether a whole box lies beyond one of the planes. */
export function isBoxBeyond(planes: readonly ViewPlane[], min: readonly number[], max: readonly number[]): boolean {
  return planes.some(({ normal, offset }) => normal.reduce((sum, n, d) => sum + n * (n > 0 ? min[d] : max[d]), 0) >= offset);
}

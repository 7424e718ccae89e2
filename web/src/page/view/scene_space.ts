// Coordinates of the scene: the grid's box has a diagonal of 2 and lies around 0.
import { Vector3 } from 'three';
import type { Model } from '../../model/types';
import type { Camera } from './camera';

export function sceneScale(model: Model): number {
  return 2 / model.diagonal;
}

/** A point less the model's origin. */
export function fromModel(model: Model, point: readonly number[]): Vector3 {
  return new Vector3(point[0], point[1], point[2]).multiplyScalar(sceneScale(model));
}

export function fromWorld(model: Model, point: readonly number[]): Vector3 {
  return fromModel(
    model,
    point.map((x, d) => x - model.origin[d]),
  );
}

export function toWorld(model: Model, point: Vector3): readonly [number, number, number] {
  const [x, y, z] = point.toArray().map((value, d) => value / sceneScale(model) + model.origin[d]);
  return [x, y, z];
}

/** Another grid has another centre and size; the camera keeps looking at the same place. */
export function keepCamera(camera: Camera, from: Model, to: Model): void {
  const isSame = from.diagonal === to.diagonal && from.origin.every((x, d) => x === to.origin[d]);
  if (!isSame) camera.transform((point) => fromWorld(to, toWorld(from, point)));
}

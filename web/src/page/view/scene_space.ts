// Coordinates of the scene: the grid's box has a diagonal of 2 and lies around 0.
import { Vector3 } from 'three';
import type { Model } from '../../model/cut_model';

export function sceneScale(model: Model): number {
  return 2 / model.diagonal;
}

/** A point less the model's origin. */
function fromModel(model: Model, point: readonly number[]): Vector3 {
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

/** Whether two models have the same places in the scene: another grid has another centre and size. */
export function haveSameSpace(one: Model, other: Model): boolean {
  return one.diagonal === other.diagonal && one.origin.every((x, d) => x === other.origin[d]);
}

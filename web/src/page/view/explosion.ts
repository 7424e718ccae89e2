// How explosions move what is drawn.
import { isOutside } from '../../model/inside';
import type { Model } from '../../model/cut_model';
import type { Look } from './layer';

type Exploded = Pick<Look, 'settings' | 'shifts'>;

/** How what belongs to a cell moves along an axis, on which the cell's middle lies there. */
export function shiftAlong(d: number, { settings: { explode }, shifts }: Exploded, middle: number, region: number | null): number {
  return explode.cells * middle + (region === null ? 0 : explode.regions * shifts[3 * region + d]);
}

export function movedBy(look: Exploded, middle: ArrayLike<number>, region: number | null): number[] {
  return [0, 1, 2].map((d) => shiftAlong(d, look, middle[d], region));
}

/** Per region: how it moves in an explosion by region, 3 numbers. */
export function regionShifts(model: Model): Float32Array {
  const { region, centroid, volume } = model.cells;
  const centers = new Float64Array(3 * model.regions.length);
  const weights = new Float64Array(model.regions.length);
  for (let cell = 0; cell < region.length; cell++) {
    weights[region[cell]] += volume[cell];
    for (let d = 0; d < 3; d++) centers[3 * region[cell] + d] += volume[cell] * centroid[3 * cell + d];
  }
  const shifts = new Float32Array(3 * model.regions.length);
  const size = Math.max(...model.meshMax.map((x, d) => x - model.meshMin[d]));
  let nested = 0;
  for (const { id } of model.regions) {
    if (isOutside(model, id) || weights[id] === 0) continue;
    const center = [0, 1, 2].map((d) => centers[3 * id + d] / weights[id] - (model.meshMin[d] + model.meshMax[d]) / 2 + model.origin[d]);
    const distance = Math.hypot(...center);
    if (distance > 0.05 * size)
      shifts.set(
        center.map((x) => x * (1 + (0.3 * size) / distance)),
        3 * id,
      );
    else shifts[3 * id] = 1.2 * size * alternating(nested++); // Nested regions have one centre: they line up side by side.
  }
  return shifts;
}

/** 0, 1, -1, 2, -2, ... */
function alternating(index: number): number {
  return index % 2 === 1 ? (index + 1) / 2 : -index / 2;
}

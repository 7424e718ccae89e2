// Which regions and cells the settings show, slices aside.
import type { ColorBy, Model, RegionInfo, Settings } from '../../model/types';
import { isOutside } from '../../model/inside';

/** Per region: 1 if it is shown. A region that is picked is shown even if it is outside. */
export function shownRegions(model: Model, { show }: Settings): Uint8Array {
  const isShown = (id: number) => (show.region !== null ? id === show.region : show.outside || !isOutside(model, id));
  return Uint8Array.from(model.regions, ({ id }) => Number(isShown(id)));
}

/** Whether anything of the model is left to see. */
export function isAnythingShown(model: Model, settings: Settings): boolean {
  const { show, slices } = settings;
  if (!show.surface && !show.gridFaces && !show.edges) return false;
  if (Object.values(slices).some(({ on, position }) => on && position === 0)) return false;
  const isShown = shownRegions(model, settings);
  const hasCells = (region: RegionInfo) => (show.cutCells && region.cutCells > 0) || (show.untouched && region.untouchedCells > 0);
  return model.regions.some((region) => isShown[region.id] === 1 && hasCells(region));
}

/** Whether a third of the surface or more has the outside on both sides, and is hidden with it: an open sheet, walls that cross. */
export function isSheet(model: Model): boolean {
  const { cell, index, surfaceEnd } = model.triangles;
  const isOuter = model.regions.map(({ id }) => isOutside(model, id));
  // A piece with the outside on both sides counts twice, one between the outside and an inside once for each.
  let outer = 0;
  let inner = 0;
  for (let at = 0; at < surfaceEnd; at += 3) {
    if (isOuter[model.cells.region[cell[index[at]]]]) outer++;
    else inner++;
  }
  return outer > 2 * inner;
}

/** By region where there are several inside, else by kind. Estimates divide what is one in truth. */
export function usualColoring({ regions, insideBy }: Model): ColorBy {
  const inside = regions.filter(({ isInside }) => isInside);
  return inside.length > 1 && insideBy !== 'estimate' ? 'region' : 'kind';
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

// What of a model the settings show, slices aside, and what suits it.
import { isOutside } from './inside';
import type { Model, RegionInfo } from './cut_model';
import type { ColorBy, Settings } from './settings';
import type { Up } from './up';

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

/** As set, or as the mesh seems to stand. */
export function upOf({ up }: Settings, model: Model | null): Up {
  return up === 'auto' ? (model?.up ?? 'y') : up;
}

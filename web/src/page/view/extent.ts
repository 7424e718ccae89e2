// What the camera has to see of a model.
import type { Model, Settings } from '../../model/types';
import { shownRegions } from './look';

interface Box {
  min: number[];
  max: number[];
}

/** Around the exploded mesh, or the grid if the outside is shown or the mesh lies beside it; less the model's origin. */
export function shownBall(model: Model, settings: Settings, shifts: Float32Array): { center: number[]; radius: number } {
  const explode = 1 + settings.explode.cells;
  const isGrid = showsGrid(model, settings);
  const { min, max } = apart(model, settings, shifts, isGrid ? gridBox(model) : meshBox(model));
  const center = min.map((x, d) => (x + max[d]) / 2);
  const sides = max.map((x, d) => x - min[d]);
  const diagonal = Math.hypot(...sides);
  if (isGrid) return { center, radius: diagonal / 2 };
  // Unless the box is long, a slight explosion fits into its corners.
  return { center, radius: Math.max((0.51 * diagonal) / explode, 0.53 * Math.max(...sides), 0.42 * diagonal) };
}

function showsGrid({ meshMin, meshMax, grid }: Model, { show }: Settings): boolean {
  const isBesideMesh = grid.planes.some((planes, d) => meshMax[d] < planes[0] || meshMin[d] > planes[planes.length - 1]);
  return isBesideMesh || (show.outside && (show.untouched || show.cutCells));
}

function gridBox({ grid, origin }: Model): Box {
  return {
    min: grid.planes.map((planes, d) => planes[0] - origin[d]),
    max: grid.planes.map((planes, d) => planes[planes.length - 1] - origin[d]),
  };
}

function meshBox({ meshMin, meshMax, origin }: Model): Box {
  return { min: meshMin.map((x, d) => x - origin[d]), max: meshMax.map((x, d) => x - origin[d]) };
}

/** The box after the explosions: the one by cell makes it grow, and it includes the regions where the one by region takes them. */
function apart(model: Model, settings: Settings, shifts: Float32Array, whole: Box): Box {
  const { cells, regions } = settings.explode;
  const box: Box = { min: whole.min.map((x) => x * (1 + cells)), max: whole.max.map((x) => x * (1 + cells)) };
  if (regions === 0) return box;
  const shown = shownRegions(model, settings);
  regionBoxes(model, whole).forEach(({ min, max }, region) => {
    if (!shown[region]) return;
    for (let d = 0; d < 3; d++) {
      const shift = regions * shifts[3 * region + d];
      box.min[d] = Math.min(box.min[d], min[d] * (1 + cells) + shift);
      box.max[d] = Math.max(box.max[d], max[d] * (1 + cells) + shift);
    }
  });
  return box;
}

/** Around the cut-cells of each region, as far as they lie in `whole`; untouched cells lie between them. */
function regionBoxes({ cells: { region, gridCell }, grid, origin, regions }: Model, whole: Box): Box[] {
  const boxes = regions.map((): Box => ({ min: [Infinity, Infinity, Infinity], max: [-Infinity, -Infinity, -Infinity] }));
  for (let cell = 0; cell < region.length; cell++) {
    const { min, max } = boxes[region[cell]];
    for (let d = 0; d < 3; d++) {
      const at = gridCell[3 * cell + d];
      min[d] = Math.min(min[d], Math.max(whole.min[d], grid.planes[d][at] - origin[d]));
      max[d] = Math.max(max[d], Math.min(whole.max[d], grid.planes[d][at + 1] - origin[d]));
    }
  }
  return boxes;
}

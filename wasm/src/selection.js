// Which cells to draw, and where: the options that the functions of three.js share.
import { bad } from './arguments.js';

/** Per region whether it is to be drawn. */
export function chosenRegions({ regionCount }, regions) {
  const chosen = new Uint8Array(regionCount);
  if (regions === undefined) return chosen.fill(1);
  for (let i = 0; i < regions.length; ++i) chosen[regions[i]] = 1;
  return chosen;
}

/** The cut-cells to draw, in order. */
export function chosenCells(cutMesh, { cells, regions }) {
  const { cellRegion } = cutMesh;
  const given = cells === undefined ? Uint32Array.from(cellRegion, (_, cell) => cell) : Uint32Array.from(cells);
  if (regions === undefined) return given;
  const chosen = chosenRegions(cutMesh, regions);
  return given.filter((cell) => chosen[cellRegion[cell]]);
}

/** How far something centred at `x` is moved along an axis: away from the centre of the grid, and to the origin. */
export function shiftAlong({ planes }, axis, { origin, explode = 0 }) {
  const ends = planes[axis];
  const center = 0.5 * (ends[0] + ends[ends.length - 1]);
  return (x) => (explode === 0 ? 0 : explode * (x - center)) - origin[axis];
}

/** 3 per cut-cell. */
export function cellShifts({ cellRegion, grid }, options) {
  const { explode = 0, measures } = options;
  if (explode !== 0 && !measures?.cellCentroid) throw bad('Exploding cut-cells needs the measures.');
  const shiftOf = [0, 1, 2].map((axis) => shiftAlong(grid, axis, options));
  const shifts = new Float64Array(3 * cellRegion.length);
  for (let i = 0; i < shifts.length; ++i) shifts[i] = shiftOf[i % 3](explode === 0 ? 0 : measures.cellCentroid[i]);
  return shifts;
}

// Volumes of cut-cells as shares of their grid cells, on a logarithmic axis: how slivers are found.
import type { Model } from './cut_model';

/** Powers of ten: those from the first on, below the second. At an end of the axis there is no limit. */
export type VolumeRange = readonly [number, number];

/** The axis. Smaller volumes count as its low end. */
export const allVolumes: VolumeRange = [-12, 0];
/** Of a bar of the histogram, in powers of ten. */
export const barWidth = 0.25;

export function gridCellVolume({ grid }: Pick<Model, 'grid'>, gridCell: ArrayLike<number>): number {
  return grid.planes.reduce((volume, planes, d) => volume * (planes[gridCell[d] + 1] - planes[gridCell[d]]), 1);
}

type Cells = Pick<Model, 'grid' | 'cells'>;

/** Of its grid cell. */
export function shareOf(model: Cells, cell: number): number {
  const { volume, gridCell } = model.cells;
  return volume[cell] / gridCellVolume(model, gridCell.subarray(3 * cell, 3 * cell + 3));
}

/** The bar that holds a share. That of a cell without volume may be rounded to less than nothing. */
function barOf(share: number): number {
  const [low, high] = allVolumes;
  const bar = share > 0 ? Math.floor((Math.log10(share) - low) / barWidth) : 0;
  return Math.max(0, Math.min((high - low) / barWidth - 1, bar));
}

/** How many cells each bar holds; `regions` has 1 for those whose cells count. */
export function histogram(model: Cells, regions: Uint8Array): Uint32Array {
  const bars = new Uint32Array((allVolumes[1] - allVolumes[0]) / barWidth);
  model.cells.region.forEach((region, cell) => {
    if (regions[region] === 1) bars[barOf(shareOf(model, cell))]++;
  });
  return bars;
}

/** The middle of a bar, as a share. */
export function shareAt(bar: number): number {
  return 10 ** (allVolumes[0] + (bar + 0.5) * barWidth);
}

/** Of the selected cells of these regions the next one by volume, after the largest the smallest; null if there is none. */
export function nextLarger(model: Cells, regions: Uint8Array, range: VolumeRange, than: number | null): number | null {
  const after = than === null ? -1 : shareOf(model, than);
  const isAfter = (share: number, cell: number) => share > after || (share === after && than !== null && cell > than);
  const isSmaller = (a: number, b: number | null) => b === null || shareOf(model, a) < shareOf(model, b);
  let smallest: number | null = null;
  let next: number | null = null;
  for (const [cell, region] of model.cells.region.entries()) {
    const share = shareOf(model, cell);
    if (regions[region] !== 1 || !isWithin(range, share)) continue;
    if (isSmaller(cell, smallest)) smallest = cell;
    if (isAfter(share, cell) && isSmaller(cell, next)) next = cell;
  }
  return next ?? smallest;
}

export function isAll([from, to]: VolumeRange): boolean {
  return from <= allVolumes[0] && to >= allVolumes[1];
}

/** Whether untouched grid cells, whose share is 1, are selected. */
export function hasWhole([, to]: VolumeRange): boolean {
  return to >= allVolumes[1];
}

export function isWithin([from, to]: VolumeRange, share: number): boolean {
  const at = allVolumes[0] + barWidth * barOf(share);
  return at >= from && at < to;
}

/** For example "from 0.000001 to 0.01 of a grid cell". */
export function rangeWords([from, to]: VolumeRange): string {
  if (isAll([from, to])) return 'of any size';
  if (from <= allVolumes[0]) return `below ${shareWords(to)} of a grid cell`;
  if (hasWhole([from, to])) return `from ${shareWords(from)} of a grid cell on`;
  return `from ${shareWords(from)} to ${shareWords(to)} of a grid cell`;
}

/** Of a power of ten. */
export function shareWords(power: number): string {
  return String(Number((10 ** power).toPrecision(2)));
}

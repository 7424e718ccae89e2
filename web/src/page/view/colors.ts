// What colours mean. Colours are sRGB bytes; the shaders make them linear.
import type { ColorBy, Model, Settings } from '../../model/types';

export type Rgb = readonly [number, number, number];

const palette = ['#e9a23b', '#4f9fdc', '#6dbb5c', '#dc6a6f', '#9c84d6', '#43b7ad', '#d982b5', '#b8a44c'].map(fromHex);
const outsideColor = fromHex('#8ea2b6');
const windings: readonly { winding: number; color: Rgb }[] = [
  { winding: -1, color: fromHex('#7d73d3') },
  { winding: 0, color: fromHex('#98a7b5') },
  { winding: 1, color: fromHex('#e9a23b') },
  { winding: 2, color: fromHex('#dc6a6f') },
  { winding: 3, color: fromHex('#a4487c') },
];
const noWinding = fromHex('#b3aea4');
const volumeRamp = ['#34308a', '#2b7fa3', '#4fb980', '#f2d551'].map(fromHex);
export const surfaceColor = fromHex('#e9a23b');
export const gridFaceColor = fromHex('#6fa3cf');
/** The inside of cut-cells, seen in flat cuts. */
export const insideColor = fromHex('#e6d3ae');
const untouchedKindColor = fromHex('#a9b4bf');

function fromHex(hex: string): Rgb {
  return [1, 3, 5].map((at) => parseInt(hex.slice(at, at + 2), 16)) as unknown as Rgb;
}

function toCss(color: Rgb): string {
  return `rgb(${color.map(Math.round).join(' ')})`;
}

/** Whether a region lies outside the surface, as far as is known. */
export function isOutside(model: Model, region: number): boolean {
  const { winding } = model.regions[region];
  return winding === null ? region === model.outsideRegion : winding === 0;
}

/** Neighbouring ids get colours that are easy to tell apart; the outside has its own. */
export function regionColor(model: Model, region: number): Rgb {
  if (isOutside(model, region)) return outsideColor;
  const rank = model.outsideRegion !== null && region > model.outsideRegion ? region - 1 : region;
  return rank < palette.length ? palette[rank] : hueColor(rank);
}

/** Steps of the golden angle don't come near an earlier hue soon. */
function hueColor(id: number): Rgb {
  const hue = (id * 0.618034) % 1;
  const value = 0.62 + 0.16 * ((id * 0.414214) % 1);
  const pull = (shift: number) => Math.max(0, Math.min(1, 2 - Math.abs(((6 * hue + shift) % 6) - 3)));
  return [0, 2, 4].map((shift) => 255 * value * (1 - 0.55 * pull(shift))) as unknown as Rgb;
}

function windingColor(winding: number | null): Rgb {
  if (winding === null) return noWinding;
  return windings[Math.max(0, Math.min(windings.length - 1, winding + 1))].color;
}

/** The root spreads out the small cells, which are in the majority. */
function volumeColor(fraction: number): Rgb {
  const at = Math.sqrt(Math.max(0, Math.min(1, fraction))) * (volumeRamp.length - 1);
  const from = Math.min(Math.floor(at), volumeRamp.length - 2);
  return [0, 1, 2].map((c) => volumeRamp[from][c] + (at - from) * (volumeRamp[from + 1][c] - volumeRamp[from][c])) as unknown as Rgb;
}

export function gridCellVolume({ grid }: Model, gridCell: ArrayLike<number>): number {
  return grid.planes.reduce((volume, planes, d) => volume * (planes[gridCell[d] + 1] - planes[gridCell[d]]), 1);
}

function byRegion(model: Model, colorBy: ColorBy): Rgb[] {
  return model.regions.map(({ id, winding }) => (colorBy === 'winding' ? windingColor(winding) : regionColor(model, id)));
}

/** 4 bytes per cut-cell, the last one free. */
export function cutCellColors(model: Model, colorBy: ColorBy): Uint8Array {
  const { region, volume, gridCell } = model.cells;
  const regions = byRegion(model, colorBy);
  const colors = new Uint8Array(4 * region.length);
  for (let cell = 0; cell < region.length; cell++) {
    let color: Rgb;
    if (colorBy === 'cell') color = hueColor(cell);
    else if (colorBy === 'kind') color = surfaceColor;
    else if (colorBy === 'volume') color = volumeColor(volume[cell] / gridCellVolume(model, gridCell.subarray(3 * cell, 3 * cell + 3)));
    else color = regions[region[cell]];
    colors.set(color, 4 * cell);
  }
  return colors;
}

/** Colour of an untouched grid cell by its number and region. */
export function untouchedColors(model: Model, colorBy: ColorBy): (gridCell: number, region: number) => Rgb {
  if (colorBy === 'cell') return (gridCell) => hueColor(gridCell);
  if (colorBy === 'kind') return () => untouchedKindColor;
  if (colorBy === 'volume') return () => volumeColor(1);
  const regions = byRegion(model, colorBy);
  return (_gridCell, region) => regions[region];
}

/** What the colours mean, as CSS colours, for at most `most` regions. */
export function legend(model: Model, { colorBy, sliceMode, slices }: Settings, most = 12): { label: string; color: string }[] {
  const entry = (label: string, color: Rgb) => ({ label, color: toCss(color) });
  if (colorBy === 'cell') return [];
  if (colorBy === 'kind') {
    const isCutOpen = sliceMode === 'flat' && Object.values(slices).some(({ on }) => on);
    return [
      entry('pieces of triangles', surfaceColor),
      entry('pieces of grid-faces', gridFaceColor),
      ...(isCutOpen ? [entry('inside of cut-cells', insideColor)] : []),
      entry('untouched cells', untouchedKindColor),
    ];
  }
  if (colorBy === 'volume') return [0, 0.25, 0.5, 1].map((fraction) => entry(`${100 * fraction}% of a grid cell`, volumeColor(fraction)));
  if (colorBy === 'winding') {
    const present = [...new Set(model.regions.map(({ winding }) => winding))].sort((a, b) => (a ?? 0) - (b ?? 0));
    const label = (winding: number | null) => (winding === null ? 'no winding number' : `winding number ${winding}`);
    return present.slice(0, most).map((winding) => entry(label(winding), windingColor(winding)));
  }
  const label = (id: number) => `region ${id}${isOutside(model, id) ? ', outside' : ''}`;
  return model.regions.slice(0, most).map(({ id }) => entry(label(id), regionColor(model, id)));
}

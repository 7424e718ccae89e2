// What colours mean. The colours themselves are the package's; here they are sRGB bytes, which the shaders make linear.
import { idColor, kindColors, outsideColor, regionColor as paletteColor, volumeColor, windingColor } from 'mandoline-wasm/three';
import { insideWords, isOutside, nearestWinding } from '../../model/inside';
import { hasWhole, shareOf } from '../../model/volumes';
import { isAnythingShown } from '../../model/shown';
import type { Model } from '../../model/cut_model';
import type { ColorBy, Settings } from '../../model/settings';

export type Rgb = readonly [number, number, number];

export const surfaceColor = toRgb(kindColors.surface);
export const gridFaceColor = toRgb(kindColors.grid);
/** The inside of cut-cells, seen in flat cuts. */
export const insideColor = toRgb(kindColors.inside);
const untouchedKindColor = toRgb(kindColors.untouched);

/** Colours of ids are computed once: a prime number of them, so that neighbours along an axis never have the same one. */
const idColors = Array.from({ length: 1021 }, (_, id) => toRgb(idColor(id)));
const volumeSteps = 255;
const volumeColors = Array.from({ length: volumeSteps + 1 }, (_, step) => toRgb(volumeColor(step / volumeSteps)));

function toRgb(linear: readonly number[]): Rgb {
  const byte = (x: number) => Math.round(255 * (x <= 0.0031308 ? 12.92 * x : 1.055 * x ** (1 / 2.4) - 0.055));
  return [byte(linear[0]), byte(linear[1]), byte(linear[2])];
}

function toCss(color: Rgb): string {
  return `rgb(${color.join(' ')})`;
}

/** The outside has a colour of its own, and takes none from the palette. */
export function regionColor(model: Model, region: number): Rgb {
  if (isOutside(model, region)) return toRgb(outsideColor);
  return toRgb(paletteColor(model.outsideRegion !== null && region > model.outsideRegion ? region - 1 : region));
}

function colorOfId(id: number): Rgb {
  return idColors[id % idColors.length];
}

/** By the share of a grid cell. The root spreads out the small cells, which are in the majority. */
function shareColor(share: number): Rgb {
  return volumeColors[Math.round(volumeSteps * Math.sqrt(Math.max(0, Math.min(1, share))))];
}

function byRegion(model: Model, colorBy: ColorBy): Rgb[] {
  return model.regions.map(({ id }) => (colorBy === 'winding' ? colorOfWinding(model, id) : regionColor(model, id)));
}

/** Where parity alone tells what is inside, as if that had the winding number 1. */
function colorOfWinding(model: Model, region: number): Rgb {
  return toRgb(windingColor(nearestWinding(model, region) ?? (isOutside(model, region) ? 0 : 1)));
}

function windingLegend(model: Model): { label: string; color: Rgb }[] {
  const entries = new Map<number, { label: string; color: Rgb }>();
  const { insideBy } = model;
  for (const { id, isInside } of model.regions) {
    const winding = nearestWinding(model, id);
    const side = `${isInside ? 'inside' : 'outside'} ${insideWords[insideBy]}`;
    const label = winding === null ? side : `winding number ${winding}${insideBy === 'estimate' ? ', estimated' : ''}`;
    entries.set(winding ?? Number(isInside), { label, color: colorOfWinding(model, id) });
  }
  return [...entries].sort(([a], [b]) => a - b).map(([, entry]) => entry);
}

/** 4 bytes per cut-cell, the last one free. */
export function cutCellColors(model: Model, colorBy: ColorBy): Uint8Array {
  const { region } = model.cells;
  const regions = byRegion(model, colorBy);
  const colors = new Uint8Array(4 * region.length);
  for (let cell = 0; cell < region.length; cell++) {
    let color: Rgb;
    if (colorBy === 'cell') color = colorOfId(cell);
    else if (colorBy === 'kind') color = surfaceColor;
    else if (colorBy === 'volume') color = shareColor(shareOf(model, cell));
    else color = regions[region[cell]];
    colors.set(color, 4 * cell);
  }
  return colors;
}

/** Colour of an untouched grid cell by its number and region. */
export function untouchedColors(model: Model, colorBy: ColorBy): (gridCell: number, region: number) => Rgb {
  if (colorBy === 'cell') return colorOfId;
  if (colorBy === 'kind') return () => untouchedKindColor;
  if (colorBy === 'volume') return () => shareColor(1);
  const regions = byRegion(model, colorBy);
  return (_gridCell, region) => regions[region];
}

/** What the colours mean, as CSS colours, for at most `most` regions; nothing where nothing is seen. */
export function legend(model: Model, settings: Settings, most = 12): { label: string; color: string }[] {
  const { colorBy, sliceMode, slices, show, volumes } = settings;
  const entry = (label: string, color: Rgb) => ({ label, color: toCss(color) });
  if (colorBy === 'cell' || !isAnythingShown(model, settings)) return [];
  if (colorBy === 'kind') {
    const isCutOpen = sliceMode === 'flat' && Object.values(slices).some(({ on }) => on);
    return [
      ...(show.surface ? [entry('pieces of triangles', surfaceColor)] : []),
      ...(show.gridFaces ? [entry('pieces of grid-faces', gridFaceColor)] : []),
      ...(isCutOpen ? [entry('inside of cut-cells', insideColor)] : []),
      ...(show.untouched && show.gridFaces && hasWhole(volumes) && model.counts.untouchedCells > 0
        ? [entry('untouched cells', untouchedKindColor)]
        : []),
    ];
  }
  if (colorBy === 'volume') return [0, 0.25, 0.5, 1].map((fraction) => entry(`${100 * fraction}% of a grid cell`, shareColor(fraction)));
  if (colorBy === 'winding') {
    return windingLegend(model)
      .slice(0, most)
      .map(({ label, color }) => entry(label, color));
  }
  const label = (id: number) => `region ${id}${isOutside(model, id) ? ', outside' : ''}`;
  return model.regions.slice(0, most).map(({ id }) => entry(label(id), regionColor(model, id)));
}

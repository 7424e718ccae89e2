// The settings as the hash of a link.
import { otherWays } from './comparison';
import type { GridSettings } from './grid_around';
import { motions } from './motion';
import { same } from './same';
import { colorings, defaultSettings, layers, ups, type Settings, type Source } from './settings';
import { axes, axisNormal, sliceNames, type Axis, type SliceName, type SliceSettings } from './slices';
import { direction, type Vector3 } from './vector';
import { allVolumes, barWidth } from './volumes';
import { mostWindCells, windColorings } from './wind';

/** Leaves out settings with their default values, so that links stay short. */
export function toHash(settings: Settings): string {
  const fallback = entries(defaultSettings());
  return entries(settings)
    .filter(([key, value]) => !fallback.some(([otherKey, other]) => otherKey === key && other === value))
    .map(([key, value]) => `${key}=${encodeURIComponent(value).replaceAll('%2C', ',')}`)
    .join('&');
}

function entries(settings: Settings): [string, string][] {
  const { source, grid, slices, explode, show, up, camera } = settings;
  const list: [string, string][] = [source.kind === 'url' ? ['url', source.url] : [source.kind === 'file' ? 'file' : 'mesh', source.name]];
  if ('min' in grid) list.push(['n', grid.cells.join()], ['box', [...grid.min, ...grid.max].join()]);
  else list.push(['n', String(grid.cells)]);
  list.push(['snap', String(settings.snapTolerance)]);
  if (settings.pose) list.push(['pose', `${settings.pose.motion},${short([settings.pose.phase])}`]);
  for (const name of sliceNames) list.push([name, sliceText(name, slices[name])]);
  list.push(['slice', settings.sliceMode], ['explode', short([explode.cells, explode.regions])], ['color', settings.colorBy]);
  list.push(['show', layers.filter((layer) => show[layer]).join()]);
  if (show.region !== null) list.push(['region', String(show.region)]);
  list.push(['volumes', short(settings.volumes)], ['up', up]);
  const { wind } = settings;
  list.push(
    ['wind', wind.on ? short(wind.direction) : 'off'],
    ['smoke', wind.smoke ? 'on' : 'off'],
    ['flow', wind.show],
    ['tunnel', String(wind.cells)],
  );
  list.push(['compare', settings.compare.way], ['divider', short([settings.compare.divider])]);
  if (camera) list.push(['camera', short([...camera.position, ...camera.target])]);
  return list;
}

function sliceText(name: SliceName, slice: SliceSettings): string {
  if (!slice.on) return 'off';
  if (name === 'free') return short([slice.position, ...slice.normal]);
  return short([slice.position, slice.normal[axes.indexOf(name)]]);
}

function short(numbers: readonly number[]): string {
  return numbers.map((x) => Number(x.toPrecision(5))).join();
}

/** What a hash says; a key that can't be understood keeps its default and is named in `problems`. */
export function fromHash(hash: string): { settings: Settings; problems: string[] } {
  const settings = defaultSettings();
  const problems: string[] = [];
  const parameters = new URLSearchParams(hash.replace(/^#/, '').replaceAll('+', '%2B'));
  for (const [key, text] of parameters) {
    const read = Object.hasOwn(readers, key) ? readers[key] : undefined;
    if (!read?.(settings, text, parameters)) problems.push(key);
  }
  return { settings, problems };
}

type Reader = (settings: Settings, text: string, all: URLSearchParams) => boolean;

const readers: Record<string, Reader> = {
  mesh: (settings, name) => readSource(settings, { kind: 'gallery', name }, name),
  url: (settings, url) => readSource(settings, { kind: 'url', url }, url),
  file: (settings, name) => readSource(settings, { kind: 'file', name }, name),
  n: readGrid,
  box: (_settings, _text, all) => numbers(all.get('n') ?? '', 3) !== null,
  snap: (settings, text) => {
    const [value] = numbers(text, 1) ?? [-1];
    if (value < 0 || value >= 0.5) return false;
    settings.snapTolerance = value;
    return true;
  },
  pose: (settings, text) => {
    const [name, ...rest] = text.split(',');
    const motion = motions.find((known) => known === name);
    const [phase] = numbers(rest.join(), 1) ?? [NaN];
    if (!motion || !(phase >= 0)) return false;
    settings.pose = { motion, phase };
    return true;
  },
  x: (settings, text) => readAxisSlice(settings, 'x', text),
  y: (settings, text) => readAxisSlice(settings, 'y', text),
  z: (settings, text) => readAxisSlice(settings, 'z', text),
  free: readFreeSlice,
  slice: (settings, text) => {
    if (text !== 'whole' && text !== 'flat') return false;
    settings.sliceMode = text;
    return true;
  },
  explode: (settings, text) => {
    const values = numbers(text, 2);
    if (!values?.every(isFraction)) return false;
    settings.explode = { cells: values[0], regions: values[1] };
    return true;
  },
  color: oneOf(colorings, (settings, coloring) => (settings.colorBy = coloring)),
  show: (settings, text) => {
    const shown = text === '' ? [] : text.split(',');
    if (!shown.every((name) => layers.some((layer) => layer === name))) return false;
    for (const layer of layers) settings.show[layer] = shown.includes(layer);
    return true;
  },
  region: (settings, text) => {
    const region = count(text, 0);
    if (region !== null) settings.show.region = region;
    return region !== null;
  },
  volumes: (settings, text) => {
    const values = numbers(text, 2);
    if (!values || values[0] >= values[1] || !values.every(isOnAxis)) return false;
    settings.volumes = [values[0], values[1]];
    return true;
  },
  up: oneOf(ups, (settings, up) => (settings.up = up)),
  camera: (settings, text) => {
    const values = numbers(text, 6);
    if (!values || same(values.slice(0, 3), values.slice(3))) return false;
    settings.camera = { position: vector(values), target: vector(values.slice(3)) };
    return true;
  },
  wind: readWind,
  smoke: (settings, text) => {
    if (text !== 'on' && text !== 'off') return false;
    settings.wind.smoke = text === 'on';
    return true;
  },
  flow: oneOf(windColorings, (settings, show) => (settings.wind.show = show)),
  tunnel: (settings, text) => {
    const cells = count(text, 2);
    if (cells === null || cells > mostWindCells) return false;
    settings.wind.cells = cells;
    return true;
  },
  compare: (settings, text) => {
    const way = otherWays.find((known) => known === text);
    if (way) settings.compare.way = way;
    return way !== undefined || text === 'none';
  },
  divider: (settings, text) => {
    const [divider] = numbers(text, 1) ?? [NaN];
    if (!isFraction(divider)) return false;
    settings.compare.divider = divider;
    return true;
  },
};

function oneOf<Name extends string>(names: readonly Name[], set: (settings: Settings, name: Name) => void): Reader {
  return (settings, text) => {
    const found = names.find((name) => name === text);
    if (found) set(settings, found);
    return found !== undefined;
  };
}

function readSource(settings: Settings, source: Source, text: string): boolean {
  if (text !== '') settings.source = source;
  return text !== '';
}

function readGrid(settings: Settings, text: string, all: URLSearchParams): boolean {
  const grid = text.includes(',') ? ownGrid(text, all.get('box') ?? '') : cubicGrid(text);
  if (grid) settings.grid = grid;
  return grid !== null;
}

function cubicGrid(text: string): GridSettings | null {
  const cells = count(text, 1);
  return cells === null ? null : { cells };
}

function ownGrid(text: string, box: string): GridSettings | null {
  const cells = numbers(text, 3);
  const ends = numbers(box, 6);
  if (!cells?.every((n) => Number.isInteger(n) && n > 0) || !ends) return null;
  if (![0, 1, 2].every((d) => ends[d] < ends[d + 3])) return null;
  return { min: vector(ends), max: vector(ends.slice(3)), cells: vector(cells) };
}

function readAxisSlice(settings: Settings, axis: Axis, text: string): boolean {
  const slice = settings.slices[axis];
  if (text === 'off') {
    slice.on = false;
    return true;
  }
  const values = numbers(text, 2);
  if (!values || !isFraction(values[0]) || Math.abs(values[1]) !== 1) return false;
  settings.slices[axis] = { on: true, position: values[0], normal: axisNormal(axis, values[1]) };
  return true;
}

function readFreeSlice(settings: Settings, text: string): boolean {
  if (text === 'off') {
    settings.slices.free.on = false;
    return true;
  }
  const values = numbers(text, 4);
  if (!values || !isFraction(values[0])) return false;
  const normal = values.slice(1);
  if (!normal.some((x) => x !== 0)) return false;
  settings.slices.free = { on: true, position: values[0], normal: direction(normal) };
  return true;
}

function readWind(settings: Settings, text: string): boolean {
  if (text === 'off') {
    settings.wind.on = false;
    return true;
  }
  const values = numbers(text, 3);
  if (!values?.some((x) => x !== 0)) return false;
  settings.wind.on = true;
  settings.wind.direction = direction(values);
  return true;
}

function numbers(text: string, length: number): number[] | null {
  const values = text.split(',').map((part) => (part.trim() === '' ? NaN : Number(part)));
  return values.length === length && values.every(Number.isFinite) ? values : null;
}

function count(text: string, least: number): number | null {
  const [value] = numbers(text, 1) ?? [NaN];
  return Number.isInteger(value) && value >= least ? value : null;
}

/** Whether it lies between two bars of the histogram, or at an end of it. */
function isOnAxis(power: number): boolean {
  return power >= allVolumes[0] && power <= allVolumes[1] && Number.isInteger(power / barWidth);
}

function isFraction(x: number): boolean {
  return x >= 0 && x <= 1;
}

function vector(values: readonly number[]): Vector3 {
  return [values[0], values[1], values[2]];
}

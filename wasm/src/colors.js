// Colours of cells: linear RGB, 0 to 1. Mixed in Oklab (Ottosson 2020), where equal steps look equal.
import { bad } from './arguments.js';
import { drawing, readColored } from './drawing.js';

const toLinear = (value) => (value <= 0.04045 ? value / 12.92 : ((value + 0.055) / 1.055) ** 2.4);
const clamp = (value) => Math.min(Math.max(value, 0), 1);

function fromHex(hex) {
  return [1, 3, 5].map((i) => toLinear(parseInt(hex.slice(i, i + 2), 16) / 255));
}

function toOklab(color) {
  const [r, g, b] = color;
  const l = Math.cbrt(0.4122214708 * r + 0.5363325363 * g + 0.0514459929 * b);
  const m = Math.cbrt(0.2119034982 * r + 0.6806995451 * g + 0.1073969566 * b);
  const s = Math.cbrt(0.0883024619 * r + 0.2817188376 * g + 0.6299787005 * b);
  return [
    0.2104542553 * l + 0.793617785 * m - 0.0040720468 * s,
    1.9779984951 * l - 2.428592205 * m + 0.4505937099 * s,
    0.0259040371 * l + 0.7827717662 * m - 0.808675766 * s,
  ];
}

function fromOklab(color) {
  const [lightness, a, b] = color;
  const l = (lightness + 0.3963377774 * a + 0.2158037573 * b) ** 3;
  const m = (lightness - 0.1055613458 * a - 0.0638541728 * b) ** 3;
  const s = (lightness - 0.0894841775 * a - 1.291485548 * b) ** 3;
  return [
    4.0767416621 * l - 3.3077115913 * m + 0.2309699292 * s,
    -1.2684380046 * l + 2.6097574011 * m - 0.3413193965 * s,
    -0.0041960863 * l - 0.7034186147 * m + 1.707614701 * s,
  ].map(clamp);
}

/** The colour at t in 0..1 of a ramp of evenly spaced Oklab colours. */
function ramp(colors, t) {
  const place = clamp(t) * (colors.length - 1);
  const i = Math.min(Math.floor(place), colors.length - 2);
  return fromOklab(colors[i].map((from, k) => from + (place - i) * (colors[i + 1][k] - from)));
}

const labs = (...hexes) => hexes.map((hex) => toOklab(fromHex(hex)));

// Okabe and Ito's colours for all kinds of colour vision, first those that differ most.
const regionColors = labs('#56b4e9', '#e69f00', '#009e73', '#cc79a7', '#f0e442', '#d55e00', '#0072b2');
const negativeWinding = labs('#e8e6e1', '#7fb2d6', '#2f6fa8', '#123a66');
const positiveWinding = labs('#e8e6e1', '#f0a35c', '#c85a1c', '#7a2a0a');
const volumes = labs('#2b2d6e', '#2a6f93', '#3fa98b', '#a6cf5c', '#f6e651');
const noWinding = fromHex('#9a9a9a');

/** For faces by what they are pieces of, for the inside of cut-cells where they are cut open, and for untouched grid cells. */
export const kindColors = {
  surface: fromHex('#e4936a'),
  grid: fromHex('#5a8ab4'),
  inside: fromHex('#f0d9c4'),
  untouched: fromHex('#d3d9e0'),
};
/** For regions outside the surface, where they are told from the others. */
export const outsideColor = fromHex('#8ea2b6');

/** Some whole number made from another, that looks random. */
function hash(value) {
  let h = Math.imul(value ^ (value >>> 16), 0x45d9f3b);
  h = Math.imul(h ^ (h >>> 15), 0x2c1b3c6d);
  return (h ^ (h >>> 13)) >>> 0;
}

/** Ids beyond the palette take its colours lighter, then darker, and so on. */
export function regionColor(region) {
  const [lightness, a, b] = regionColors[region % regionColors.length];
  const round = Math.floor(region / regionColors.length) % 3;
  const strength = [1, 0.7, 0.8][round];
  return fromOklab([[lightness, 0.5 + 0.5 * lightness, 0.6 * lightness][round], strength * a, strength * b]);
}

/** From neutral at 0 to the deepest colour at 3 windings and more. */
export function windingColor(winding) {
  if (winding === null) return noWinding;
  return ramp(winding < 0 ? negativeWinding : positiveWinding, Math.abs(winding) / 3);
}

export function idColor(id) {
  const bits = hash(id + 1);
  const angle = (2 * Math.PI * (bits & 0xffff)) / 0x10000;
  const lightness = 0.6 + (0.25 * (bits >>> 16)) / 0x10000;
  return fromOklab([lightness, 0.11 * Math.cos(angle), 0.11 * Math.sin(angle)]);
}

/** From 0 for the smallest to 1 for the largest. */
export function volumeColor(fraction) {
  return ramp(volumes, fraction);
}

/** Gives colours of volumes on a logarithmic scale from the smallest of `cellVolume`, but at least a 1000th of the largest, to that. */
export function volumeScale(cellVolume) {
  let smallest = Infinity,
    largest = 0;
  for (const volume of cellVolume) {
    if (volume > 0) smallest = Math.min(smallest, volume);
    largest = Math.max(largest, volume);
  }
  const min = Math.log(Math.max(smallest, 1e-3 * largest)),
    range = Math.log(largest) - min;
  return (volume) => volumeColor(range > 0 ? (Math.log(volume) - min) / range : 1);
}

/** Gives the colour of a cell { region, id, volume }, where only what `colorBy` tells needs to be there. */
export function cellColorer(cutMesh, colorBy, measures) {
  const { regionWinding } = cutMesh;
  if (colorBy === 'region') return ({ region }) => regionColor(region);
  if (colorBy === 'winding') return ({ region }) => windingColor(regionWinding ? regionWinding[region] : null);
  if (colorBy === 'cell') return ({ id }) => idColor(id);
  if (!measures) throw bad('Colours by volume need the measures.');
  const scale = volumeScale(measures.cellVolume);
  return ({ volume }) => scale(volume);
}

/** 3 per cut-cell. */
export function colorsOfCells(cutMesh, colorBy, measures) {
  const color = cellColorer(cutMesh, colorBy, measures);
  const colors = new Float32Array(3 * cutMesh.cellRegion.length);
  for (let id = 0; id < cutMesh.cellRegion.length; ++id) {
    colors.set(color({ id, region: cutMesh.cellRegion[id], volume: measures?.cellVolume[id] }), 3 * id);
  }
  return colors;
}

export const cellColors = drawing('cellColors', ['colorBy', 'measures'], colorsOfCells, readColored);

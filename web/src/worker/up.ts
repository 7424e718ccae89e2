// Which axis of a mesh points upwards. Files don't say, and programs disagree; glTF alone has a rule.
import type { Mesh } from 'mandoline-wasm';
import type { Bounds } from '../model/grid_around';
import type { Up } from '../model/up';

/** What is thinner than this, beside its other two extents, lies on its flat side. */
const flat = 0.29;
/** Of the largest extent: how near to 0 a mesh has to begin to stand there. */
const touch = 0.002;
/** Of the box's side: the least area of a foot. */
const foot = 0.025;
/** Shares of the area by which halves of a mesh differ: up to the first they are alike, from the second on they are not. */
const [alike, unlike] = [0.035, 0.06];

/** What speaks for an axis, the strongest first, if it does for no other one. x points upwards but seldom: a large foot has to say so. */
const signs = [
  { holds: liesAcross, axes: [1, 2] },
  { holds: beginsAtZero, axes: [1, 2] },
  { holds: isUneven, axes: [1, 2] },
  { holds: standsOn, axes: [0, 1, 2] },
];

const names: readonly Up[] = ['x', 'y', 'z'];

/** By what a file is made for: STL comes from printers and CAD and has z upwards, glTF has y. Else by the mesh; without a sign, y. */
export function guessUp(name: string, mesh: Mesh, bounds: Bounds): Up {
  if (/\.(glb|gltf)(\.gz)?$/i.test(name)) return 'y';
  if (/\.(stl|3mf)(\.gz)?$/i.test(name)) return 'z';
  // A drawing in a plane is looked at from its front.
  if (bounds.min[2] === bounds.max[2]) return 'y';
  const shape = shapeOf(mesh, bounds);
  for (const { holds, axes } of signs) {
    const found = axes.filter((axis) => holds(shape, axis));
    if (found.length === 1) return names[found[0]];
  }
  return 'y';
}

interface Shape extends Bounds {
  extent: readonly number[];
  largest: number;
  /** Per axis. */
  sides: readonly Side[];
}

interface Side {
  /** Area at both ends of the axis, beside that of the box's sides there. */
  low: number;
  high: number;
  /** How far both halves are from being mirror images, 0 to 1. */
  unevenness: number;
}

function others(axis: number): [number, number] {
  return [(axis + 1) % 3, (axis + 2) % 3];
}

function liesAcross({ extent }: Shape, axis: number): boolean {
  return extent[axis] < flat * Math.min(...others(axis).map((d) => extent[d]));
}

function beginsAtZero({ min, largest }: Shape, axis: number): boolean {
  return Math.abs(min[axis]) <= touch * largest;
}

/** Things are alike to the left and right, or to the front and back, but seldom above and below. */
function isUneven({ sides }: Shape, axis: number): boolean {
  return sides[axis].unevenness >= unlike && sides[3 - axis].unevenness <= alike;
}

/** On something flat, unlike its top and its other sides. */
function standsOn({ sides }: Shape, axis: number): boolean {
  const { low, high } = sides[axis];
  return low >= foot && low > 2 * Math.max(high, ...others(axis).map((d) => sides[d].low));
}

const bins = 64;
/** Places on a triangle, as weights of two of its corners; one is enough for each of many triangles. */
const spread = [0, 1, 2, 3].flatMap((a) => [0, 1, 2, 3].slice(a).map((b) => [(a + 1 / 3) / 4, (b - a + 1 / 3) / 4] as const));
const center = [[1 / 3, 1 / 3]] as const;
const many = 20_000;

function shapeOf(mesh: Mesh, bounds: Bounds): Shape {
  const extent = bounds.max.map((x, d) => x - bounds.min[d]);
  const largest = Math.max(...extent);
  const areas = areasOf(mesh);
  const sides = [0, 1, 2].map((axis) => {
    const [u, v] = others(axis).map((d) => extent[d]);
    const { low, high, unevenness } = sideOf(mesh, areas, axis, [bounds.min[axis], bounds.max[axis], touch * largest]);
    return { low: low / (u * v), high: high / (u * v), unevenness };
  });
  return { ...bounds, extent, largest, sides };
}

/** Per triangle. */
function areasOf({ positions, triangles }: Mesh): Float64Array {
  const areas = new Float64Array(triangles.length / 3);
  for (let triangle = 0; triangle < areas.length; triangle++) {
    const a = 3 * triangles[3 * triangle];
    const b = 3 * triangles[3 * triangle + 1];
    const c = 3 * triangles[3 * triangle + 2];
    let squares = 0;
    for (let d = 0; d < 3; d++) {
      const e = (d + 1) % 3;
      const du = positions[b + d] - positions[a + d];
      const eu = positions[b + e] - positions[a + e];
      const dv = positions[c + d] - positions[a + d];
      const ev = positions[c + e] - positions[a + e];
      squares += (du * ev - eu * dv) ** 2;
    }
    areas[triangle] = 0.5 * Math.sqrt(squares);
  }
  return areas;
}

/** What the mesh is like along an axis, between these ends and so near to them. */
function sideOf({ positions, triangles }: Mesh, areas: Float64Array, axis: number, ends: readonly [number, number, number]): Side {
  const [min, max, near] = ends;
  const heights = new Float64Array(bins);
  const places = areas.length > many ? center : spread;
  let low = 0;
  let high = 0;
  for (let triangle = 0; triangle < areas.length; triangle++) {
    const area = areas[triangle];
    const a = positions[3 * triangles[3 * triangle] + axis];
    const b = positions[3 * triangles[3 * triangle + 1] + axis];
    const c = positions[3 * triangles[3 * triangle + 2] + axis];
    if (Math.max(a, b, c) <= min + near) low += area;
    if (Math.min(a, b, c) >= max - near) high += area;
    for (const [u, v] of places) {
      const bin = Math.floor((bins * (a + u * (b - a) + v * (c - a) - min)) / (max - min || 1));
      heights[Math.max(0, Math.min(bins - 1, bin))] += area / places.length;
    }
  }
  return { low, high, unevenness: unevennessOf(heights) };
}

/** The largest difference between the area up to a height, and that down to the same depth. */
function unevennessOf(areas: Float64Array): number {
  let difference = 0;
  let largest = 0;
  let total = 0;
  areas.forEach((area, bin) => {
    difference += area - areas[bins - 1 - bin];
    largest = Math.max(largest, Math.abs(difference));
    total += area;
  });
  return total > 0 ? largest / total : 0;
}

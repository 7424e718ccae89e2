// The Utah teapot, as Martin Newell measured his own in 1975: bicubic Bezier patches, four around the axis of pot and lid for each piece of
// their profiles, two around handle and spout for each piece of their length.
import { loft, merged, moved, range, type MeshArrays, type Point } from './mesh';
import { add, scale } from '../vector';

/** Radius and height, from below upwards. Every third is a point of the profile, the others are the control points between. */
const pot = [
  [0, 0],
  [1.425, 0],
  [1.5, 0.075],
  [1.5, 0.15],
  [1.5, 0.225],
  [2, 0.45],
  [2, 0.9],
  [2, 1.35],
  [1.75, 1.875],
  [1.5, 2.4],
  [1.4375, 2.53125],
  [1.3375, 2.53125],
  [1.4, 2.4],
];
const lid = [
  [1.3, 2.4],
  [1.3, 2.55],
  [0.4, 2.55],
  [0.2, 2.7],
  [0, 2.85],
  [0.8, 3.15],
  [0, 3.15],
];
/** In the same way along their length: place and height of one side and of the other, and how far they reach to the right and left. */
const handle = [
  [-1.6, 2.025, -1.5, 2.25, 0.3],
  [-2.3, 2.025, -2.5, 2.25, 0.3],
  [-2.7, 2.025, -3, 2.25, 0.3],
  [-2.7, 1.8, -3, 1.8, 0.3],
  [-2.7, 1.575, -3, 1.35, 0.3],
  [-2.5, 1.125, -2.65, 0.9375, 0.3],
  [-2, 0.9, -1.9, 0.6, 0.3],
];
const spout = [
  [1.7, 1.425, 1.7, 0.6, 0.66],
  [2.6, 1.425, 3.1, 0.825, 0.66],
  [2.3, 2.1, 2.4, 2.025, 0.25],
  [2.7, 2.4, 3.3, 2.4, 0.25],
  [2.8, 2.475, 3.525, 2.49375, 0.25],
  [2.9, 2.475, 3.45, 2.5125, 0.15],
  [2.8, 2.4, 3.2, 2.4, 0.15],
];

/** Sides of a patch are divided into so many. */
const steps = 8;

/** Points on cubic Bezier curves, each of which begins where the one before ends. */
function curve(controls: readonly Point[]): Point[] {
  const pieces = (controls.length - 1) / 3;
  return range(steps * pieces + 1).map((k) => {
    const piece = Math.min(Math.floor(k / steps), pieces - 1);
    const t = k / steps - piece;
    const weights = [(1 - t) ** 3, 3 * t * (1 - t) ** 2, 3 * t * t * (1 - t), t ** 3];
    return weights.reduce((sum, weight, at) => add(sum, scale(weight, controls[3 * piece + at])), [0, 0, 0] as Point);
  });
}

/** The surface of rings of control points. A ring whose points coincide is a pole. */
function surface(controls: readonly (readonly Point[])[]): MeshArrays {
  const columns = controls[0].map((_, c) => curve(controls.map((ring) => ring[c])));
  const rings = range(columns[0].length).map((k) => {
    const [first, ...others] = columns.map((column) => column[k]);
    const isPole = others.every((point) => point.every((x, d) => x === first[d]));
    return isPole ? [first] : curve([first, ...others, first]).slice(0, -1);
  });
  return loft(rings, { around: true });
}

/** Four quarters of a circle: their control points are rounded, to 0.56 of the radius, and at the knob of the lid to 0.45 of 0.8. */
function circle([r, z]: readonly number[]): Point[] {
  const c = r === 0.8 ? 0.45 : 0.56 * r;
  const quarter = (x: number, y: number): Point[] => [
    [r * x, r * y, z],
    [r * x - c * y, r * y + c * x, z],
    [c * x - r * y, c * y + r * x, z],
  ];
  return [...quarter(1, 0), ...quarter(0, 1), ...quarter(-1, 0), ...quarter(0, -1)];
}

/** Two halves of a ring. */
function ring([x, z, otherX, otherZ, width]: readonly number[]): Point[] {
  const half = (from: Point, to: Point, y: number): Point[] => [from, [from[0], y, from[2]], [to[0], y, to[2]]];
  const [one, other]: Point[] = [
    [x, 0, z],
    [otherX, 0, otherZ],
  ];
  return [...half(one, other, -width), ...half(other, one, width)];
}

/** All of it is a single layer: the pot is open around its lid, which does not touch it, and spout and handle end open in its wall. */
export function teapot(): MeshArrays {
  const parts = merged(surface(pot.map(circle)), surface(lid.map(circle)), surface(handle.map(ring)), surface(spout.map(ring)));
  // It was made with z up.
  return moved(parts, ([x, y, z]) => [x, z, -y]);
}

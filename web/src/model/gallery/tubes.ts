// Tubes along paths: the hollow Hilbert curve, the torus knot, chain links.
import { flipped, loft, merged, moved, range, type MeshArrays, type Point } from './mesh';
import { add, cross, dot, scale, subtract, unit } from '../vector';

/** A round tube of n sides along an axis-aligned path with right-angled turns, mitred; its ends are capped. */
function mitredTube(path: readonly Point[], radius: number, n: number): MeshArrays {
  const directions = path.slice(1).map((p, k) => unit(subtract(p, path[k])));
  const side: Point = Math.abs(directions[0][2]) < 0.5 ? [0, 0, 1] : [1, 0, 0];
  const up = cross(directions[0], side);
  let offsets = range(n).map((i) => {
    const angle = (2 * Math.PI * (i + 0.5)) / n;
    return add(scale(radius * Math.cos(angle), side), scale(radius * Math.sin(angle), up));
  });
  const rings = path.map((p, k) => {
    const before = directions[Math.max(k - 1, 0)];
    const after = directions[Math.min(k, directions.length - 1)];
    if (dot(before, after) > 0.5) return offsets.map((o) => add(p, o));
    // Where the lines of the tube meet the plane that halves the turn.
    const mitred = offsets.map((o) => subtract(o, scale(dot(o, after), before)));
    offsets = mitred.map((m) => subtract(m, scale(dot(m, after), after)));
    return mitred.map((m) => add(p, m));
  });
  return loft([[path[0]], ...rings, [path[path.length - 1]]], { around: true });
}

/**
 * The Hilbert curve through the 8^order points of a cubic lattice, from the cube's corner at the origin to the one on the x axis: eight
 * smaller curves, one per octant, each turned and mirrored so that it starts beside the end of the one before.
 */
function hilbertCurve(order: number): Point[] {
  if (order === 0) return [[0, 0, 0]];
  const smaller = hilbertCurve(order - 1);
  const half = 2 ** (order - 1);
  // Octant, axis along which the smaller curve ends, and whether it starts at the far end of the x, y and z axes.
  const parts: readonly [Point, number, Point][] = [
    [[0, 0, 0], 2, [0, 0, 0]],
    [[0, 0, 1], 1, [0, 0, 0]],
    [[0, 1, 1], 0, [0, 0, 0]],
    [[0, 1, 0], 2, [1, 0, 1]],
    [[1, 1, 0], 2, [0, 0, 0]],
    [[1, 1, 1], 0, [0, 0, 0]],
    [[1, 0, 1], 1, [1, 1, 0]],
    [[1, 0, 0], 2, [1, 0, 1]],
  ];
  return parts.flatMap(([octant, axis, far]) =>
    smaller.map((p): Point => {
      const along = (d: number) => {
        const x = p[(d - axis + 3) % 3];
        return half * octant[d] + (far[d] ? half - 1 - x : x);
      };
      return [along(0), along(1), along(2)];
    }),
  );
}

/** A closed tube with a closed tube inside it. */
export function hollowHilbertCurve(): MeshArrays {
  const wall = 0.09;
  const path = hilbertCurve(2);
  const last = path.length - 1;
  const lengthened = (by: number) =>
    path.map((p, k): Point => {
      if (k === 0) return add(p, scale(by, subtract(p, path[1])));
      return k === last ? add(p, scale(by, subtract(p, path[last - 1]))) : p;
    });
  return merged(mitredTube(lengthened(0.3), 0.31, 8), flipped(mitredTube(lengthened(0.3 - wall), 0.31 - wall, 8)));
}

/** A trefoil knot that winds twice about the y axis and three times about the ring. */
export function torusKnot(): MeshArrays {
  const slices = 180;
  const sides = 16;
  const at = (t: number): Point => {
    const r = 2 + 0.9 * Math.cos(3 * t);
    return [r * Math.cos(2 * t), 0.9 * Math.sin(3 * t), -r * Math.sin(2 * t)];
  };
  const rings = range(slices).map((k) => {
    const t = (2 * Math.PI * k) / slices;
    const centre = at(t);
    const tangent = unit(subtract(at(t + 1e-4), at(t - 1e-4)));
    const out: Point = [Math.cos(3 * t) * Math.cos(2 * t), Math.sin(3 * t), -Math.cos(3 * t) * Math.sin(2 * t)];
    const side = unit(cross(tangent, out));
    const normal = cross(side, tangent);
    return range(sides).map((i) => {
      const angle = (2 * Math.PI * i) / sides;
      return add(centre, add(scale(0.45 * Math.cos(angle), normal), scale(0.45 * Math.sin(angle), side)));
    });
  });
  return loft(rings, { around: true, along: true });
}

/** A ring about the y axis. */
export function torus(ringRadius: number, tubeRadius: number, slices: number, sides: number): MeshArrays {
  const rings = range(slices).map((k) => {
    const u = (2 * Math.PI * k) / slices;
    return range(sides).map((i): Point => {
      const v = (2 * Math.PI * i) / sides;
      const r = ringRadius + tubeRadius * Math.cos(v);
      return [r * Math.cos(u), -tubeRadius * Math.sin(v), -r * Math.sin(u)];
    });
  });
  return loft(rings, { around: true, along: true });
}

/** Three interlinked rings that do not touch. */
export function chain(): MeshArrays {
  const ring = torus(1, 0.25, 40, 16);
  const links = range(3).map((k) => moved(ring, ([x, y, z]): Point => (k % 2 ? [x + 1.4 * (k - 1), y, z] : [x + 1.4 * (k - 1), -z, y])));
  return merged(...links);
}

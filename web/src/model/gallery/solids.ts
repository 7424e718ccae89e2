// Closed surfaces, oriented outward.
import { flipped, fromPoints, loft, merged, moved, range, type MeshArrays, type Point } from './mesh';
import { add, scale, unit } from '../vector';

/** A sphere of 20 * 4^subdivisions triangles about the origin. */
export function sphere(radius: number, subdivisions: number): MeshArrays {
  const g = (1 + Math.sqrt(5)) / 2;
  const points: Point[] = [];
  for (const a of [-1, 1]) for (const b of [-g, g]) points.push([0, a, b], [a, b, 0], [b, 0, a]);
  let corners: [Point, Point, Point][] = [];
  const near = (p: Point, q: Point) => Math.hypot(p[0] - q[0], p[1] - q[1], p[2] - q[2]) < 2.1;
  points.forEach((a, i) =>
    points.forEach((b, j) =>
      points.forEach((c, k) => {
        if (i >= j || i >= k || j === k || !near(a, b) || !near(b, c) || !near(c, a)) return;
        const volume = a[0] * (b[1] * c[2] - b[2] * c[1]) + a[1] * (b[2] * c[0] - b[0] * c[2]) + a[2] * (b[0] * c[1] - b[1] * c[0]);
        if (volume > 0) corners.push([a, b, c]);
      }),
    ),
  );
  const middle = (p: Point, q: Point) => scale(0.5, add(p, q));
  for (let s = 0; s < subdivisions; ++s) {
    corners = corners.flatMap(([a, b, c]): [Point, Point, Point][] => {
      const [ab, bc, ca] = [middle(a, b), middle(b, c), middle(c, a)];
      return [
        [a, ab, ca],
        [b, bc, ab],
        [c, ca, bc],
        [ab, bc, ca],
      ];
    });
  }
  return moved(fromPoints(corners.flat(), range(3 * corners.length)), (p) => scale(radius, unit(p)));
}

/** Spheres in spheres, alternately solid and hollow; the smallest one fits into a grid cell. */
export function nestedSpheres(): MeshArrays {
  const at = (mesh: MeshArrays, centre: Point) => moved(mesh, (p) => add(p, centre));
  return merged(
    sphere(1, 3),
    flipped(sphere(0.75, 3)),
    sphere(0.5, 3),
    flipped(at(sphere(0.07, 1), [0.13, 0.14, 0.12])),
    at(sphere(0.035, 1), [0.13, 0.14, 0.12]),
  );
}

/** A sphere whose vertices are moved at random along its radius. */
export function noisySphere(): MeshArrays {
  const moves = new Map<string, number>();
  let state = 7;
  const random = () => {
    state = (1664525 * state + 1013904223) % 2 ** 32;
    return state / 2 ** 32;
  };
  return moved(sphere(1, 4), (p) => {
    const key = p.join();
    const move = moves.get(key) ?? 1 + 0.24 * (random() - 0.5);
    moves.set(key, move);
    return scale(move, p);
  });
}

/** Of a given number of teeth about the z axis, with a round hole. */
function gear(teeth: number, radius: number, hole: number, thickness: number, turn: number): MeshArrays {
  const pitch = (2 * Math.PI) / teeth;
  // Within a pitch: the start and end of the tooth's foot, the start and end of its top.
  const corners: readonly [number, number][] = [
    [-0.3, -0.16],
    [-0.12, 0.14],
    [0.12, 0.14],
    [0.3, -0.16],
  ];
  const sections = range(teeth).flatMap((k) =>
    corners.map(([at, height]): Point[] => {
      const angle = turn + pitch * (k + at);
      const [c, s] = [Math.cos(angle), Math.sin(angle)];
      const r = radius + height;
      return [
        [r * c, r * s, thickness],
        [r * c, r * s, -thickness],
        [hole * c, hole * s, -thickness],
        [hole * c, hole * s, thickness],
      ];
    }),
  );
  return loft(sections, { around: true, along: true });
}

/** Two gears in mesh, not touching. */
export function gears(): MeshArrays {
  const left = gear(12, 1.2, 0.4, 0.3, 0);
  const right = moved(gear(8, 0.8, 0.3, 0.3, Math.PI + Math.PI / 8), ([x, y, z]) => [x + 2.06, y, z]);
  return merged(left, right);
}

/** Stairs, all of whose faces lie in axial planes of the grid of 22 cells around them. */
export function alignedSteps(): MeshArrays {
  const outline: [number, number][] = [
    [-10, -10],
    [10, -10],
    [10, -5],
    [5, -5],
    [5, 0],
    [0, 0],
    [0, 5],
    [-5, 5],
    [-5, 10],
    [-10, 10],
  ];
  const [back, front] = [-10, 10].map((z) => outline.map(([x, y]): Point => [x, y, z]));
  const fan = range(outline.length - 2).flatMap((k) => [0, k + 1, k + 2]);
  return merged(loft([back, front], { around: true }), fromPoints(front, fan), flipped(fromPoints(back, fan)));
}

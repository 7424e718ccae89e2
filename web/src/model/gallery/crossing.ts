// Surfaces that cross themselves: bodies in one another, a scan pushed through itself, closed surfaces with one side.
import { loft, merged, moved, range, type MeshArrays, type Point } from './mesh';
import { sphere } from './solids';
import { torus } from './tubes';
import { add, dot, scale, unit } from '../vector';

/** Two rings, each through the wall of the other. */
export function crossingTori(): MeshArrays {
  const ring = torus(1, 0.42, 40, 24);
  return merged(
    moved(ring, ([x, y, z]): Point => [x - 0.45, y, z]),
    moved(ring, ([x, y, z]): Point => [x + 0.45, 0.6 * y - 0.8 * z, 0.8 * y + 0.6 * z]),
  );
}

/** A lumpy ball, one side of which is pushed inward until it comes out at the other, inside out. */
export function pushedBlob(): MeshArrays {
  const pushed = unit([-0.75, -0.35, -0.55]);
  return moved(sphere(1, 4), (p) => {
    const [x, y, z] = p;
    const lumps = 0.09 * Math.sin(4.3 * x + 1.2 * y) + 0.07 * Math.sin(5.1 * y - 2.2 * z + 0.7) + 0.05 * Math.cos(6.7 * z + 3.1 * x);
    const push = 2.9 * Math.exp(-9 * (1 - dot(p, pushed)));
    return add(scale(1 + lumps, p), scale(-push, pushed));
  });
}

/**
 * A Klein bottle: a tube about a path in the plane z = 0 that rises from the bottom, bends over, and comes back to the bottom from above,
 * through the side. There the tube turns inside out: its last ring is the first one, mirrored.
 */
export function kleinBottle(): MeshArrays {
  const slices = 80;
  const sides = 32;
  const centre = (s: number): Point => [-1.35 * Math.sin(s) * Math.sin(s / 2) ** 2, 1.5 * (1 - Math.cos(s)), 0];
  const radius = (s: number) => 0.26 + 0.85 * (0.5 + 0.5 * Math.cos(s - 1)) ** 3;
  const rings = range(slices).map((k) => {
    const s = (2 * Math.PI * k) / slices;
    const [before, after] = [centre(s - 1e-4), centre(s + 1e-4)];
    const [tx, ty] = k === 0 ? [0, 1] : unit([after[0] - before[0], after[1] - before[1], 0]);
    return range(sides).map((i): Point => {
      const angle = (2 * Math.PI * i) / sides;
      const out = radius(s) * Math.cos(angle);
      return add(centre(s), [-ty * out, tx * out, radius(s) * Math.sin(angle)]);
    });
  });
  const mirrored = range(sides).map((i) => rings[0][(sides / 2 - i + sides) % sides]);
  return loft([...rings, mirrored], { around: true });
}

/**
 * Boy's surface as Bryant and Kusner immerse it: the unit disk, opposite points of whose rim are one point. It has threefold symmetry about
 * the y axis and a point through which it passes three times.
 */
export function boysSurface(): MeshArrays {
  const slices = 84;
  const steps = 22;
  const ring = (k: number, count: number) => range(count).map((i) => boysPoint((k / steps) ** 0.8, (2 * Math.PI * i) / slices));
  const rim = ring(steps, slices / 2);
  const inner = range(steps - 1).map((k) => ring(k + 1, slices));
  return loft([[boysPoint(0, 0)], ...inner, [...rim, ...rim]], { around: true });
}

/** The image of the complex number z = r exp(i angle). */
function boysPoint(r: number, angle: number): Point {
  const power = (n: number): [number, number] => [r ** n * Math.cos(n * angle), r ** n * Math.sin(n * angle)];
  const [z1, z3, z5, z6] = [1, 3, 5, 6].map(power);
  // All three coordinates are fractions with the denominator z^6 + sqrt(5) z^3 - 1: times its square they stay finite.
  const [re, im] = [z6[0] + Math.sqrt(5) * z3[0] - 1, z6[1] + Math.sqrt(5) * z3[1]];
  const square = re * re + im * im;
  const x = -1.5 * ((z1[1] - z5[1]) * re - (z1[0] - z5[0]) * im);
  const z = -1.5 * ((z1[0] + z5[0]) * re + (z1[1] + z5[1]) * im);
  const y = z6[1] * re - (1 + z6[0]) * im - 0.5 * square;
  return scale(square / (x * x + y * y + z * z), [x, y, z]);
}

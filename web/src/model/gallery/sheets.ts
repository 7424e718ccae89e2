// Open surfaces, thin layers, and sheets that meet in shared edges.
import { circle, flipped, fromPoints, loft, merged, range, revolved, sheet, type MeshArrays, type Point } from './mesh';

function wave(x: number, z: number): number {
  return 0.22 * Math.sin(5.1 * x + 0.4) * Math.cos(4.3 * z - 0.3) + 0.08 * x;
}

const waveAt =
  (n: number, lift: number) =>
  (i: number, j: number): Point => {
    const x = (2 * i) / n - 1;
    const z = 1 - (2 * j) / n;
    return [x, wave(x, z) + lift, z];
  };

export function wavyPlane(): MeshArrays {
  return sheet(36, 36, waveAt(36, 0));
}

/** The closed layer between two wavy planes. */
export function wavySlab(): MeshArrays {
  const n = 36;
  const bottom = waveAt(n, -0.06);
  const top = waveAt(n, 0.06);
  const rim = [
    ...range(n).map((k): [number, number] => [k, 0]),
    ...range(n).map((k): [number, number] => [n, k]),
    ...range(n).map((k): [number, number] => [n - k, n]),
    ...range(n).map((k): [number, number] => [0, n - k]),
  ];
  const side = loft([rim.map(([i, j]) => bottom(i, j)), rim.map(([i, j]) => top(i, j))], { around: true });
  return merged(sheet(n, n, top), flipped(sheet(n, n, bottom)), side);
}

/** A bowl whose wall is a hundredth of its size. */
export function thinBowl(): MeshArrays {
  const steps = 18;
  const arc = (radius: number) =>
    range(steps).map((k): [number, number] => {
      const angle = (0.52 * Math.PI * (k + 1)) / steps;
      return [radius * Math.sin(angle), -radius * Math.cos(angle)];
    });
  return revolved([[0, -1], ...arc(1), ...arc(0.98).reverse(), [0, -0.98]], 48);
}

export function moebiusStrip(): MeshArrays {
  const slices = 96;
  const across = 6;
  const rows = range(slices).map((k) => {
    const u = (2 * Math.PI * k) / slices;
    return range(across + 1).map((i): Point => {
      const w = 0.8 * (i / across - 0.5);
      const r = 1 + w * Math.cos(u / 2);
      return [r * Math.cos(u), w * Math.sin(u / 2), -r * Math.sin(u)];
    });
  });
  // After one turn the strip comes back upside down.
  return loft([...rows, [...rows[0]].reverse()]);
}

/** A horn without a wall, open at both ends. */
export function trumpet(): MeshArrays {
  const steps = 24;
  const profile = range(steps + 1).map((k): [number, number] => {
    const t = k / steps;
    return [0.14 + 0.1 * t + 0.56 * t ** 5, 2 * t - 1];
  });
  return revolved(profile, 40);
}

/** Three pages on one spine. */
export function pages(): MeshArrays {
  const page = (start: number) =>
    sheet(10, 10, (i, j): Point => {
      const r = i / 10;
      const angle = start + 0.7 * r * r;
      return [r * Math.cos(angle), j / 5 - 1, -r * Math.sin(angle)];
    });
  return merged(...[0.3, 2.3, 4.5].map(page));
}

/** Upright walls that cross on shared edges, like the partition of a crate. */
export function crate(): MeshArrays {
  const n = 4;
  const column = (i: number, j: number): [Point, Point] => {
    const x = i - n / 2 + 0.25 * Math.sin(2.1 * i + 1.3 * j);
    const z = j - n / 2 + 0.25 * Math.cos(1.7 * i + 2.3 * j);
    const height = 0.9 + 0.35 * Math.sin(1.1 * i) * Math.cos(0.9 * j);
    return [
      [x, -1, z],
      [x, height, z],
    ];
  };
  const wall = (a: [Point, Point], b: [Point, Point]) => fromPoints([a[0], b[0], b[1], a[1]], [0, 1, 2, 0, 2, 3]);
  const inner = range(n - 1).map((k) => k + 1);
  return merged(
    ...inner.flatMap((j) => range(n).map((i) => wall(column(i, j), column(i + 1, j)))),
    ...inner.flatMap((i) => range(n).map((j) => wall(column(i, j), column(i, j + 1)))),
  );
}

/** Two bubbles that share a flat wall: three sheets meet along its rim. */
export function doubleBubble(): MeshArrays {
  const slices = 48;
  const steps = 16;
  const widest = Math.PI - Math.atan2(0.8, 0.6);
  const lower = range(steps - 1).map((k): [number, number] => {
    const angle = (widest * (k + 1)) / steps;
    return [Math.sin(angle), -0.6 - Math.cos(angle)];
  });
  const upper = [...lower].reverse().map(([r, y]): [number, number] => [r, -y]);
  const skin = revolved([[0, -1.6], ...lower, [0.8, 0], ...upper, [0, 1.6]], slices);
  const wall = loft([circle(0.8, 0, slices), circle(0.4, 0, slices), [[0, 0, 0]]], { around: true });
  return merged(skin, wall);
}

// Marching cubes, whose cases are found as they are defined: on each side of a cube, segments part the corners inside from those outside, and
// the segments of all sides close to polygons.

/** Corner b of a cube lies at (b & 1, b >> 1 & 1, b >> 2). An edge is (axis, corner at its low end): number 4 * axis + rank of that corner. */
const lowCorners = [1, 2, 4].map((far) => [0, 1, 2, 3, 4, 5, 6, 7].filter((corner) => !(corner & far)));

function edgeBetween(a: number, b: number): number {
  const axis = [1, 2, 4].indexOf(a ^ b);
  return 4 * axis + lowCorners[axis].indexOf(Math.min(a, b));
}

/** Low and high corner of each edge. */
export const cubeEdges: readonly (readonly [number, number])[] = [0, 1, 2].flatMap((axis) =>
  lowCorners[axis].map((corner) => [corner, corner | (1 << axis)] as const),
);

/** The corners of each side of the cube, counter-clockwise seen from outside. */
const sides = [0, 1, 2].flatMap((axis) => {
  const [u, v, far] = [1 << ((axis + 1) % 3), 1 << ((axis + 2) % 3), 1 << axis];
  return [
    [0, v, u | v, u],
    [far, far | u, far | u | v, far | v],
  ];
});

/** Per set of inside corners: polygons of edges, with the inside behind them. */
export const cubeCases: readonly (readonly (readonly number[])[])[] = Array.from({ length: 256 }, (_, inside) => polygonsOf(inside));

function polygonsOf(inside: number): number[][] {
  // On each side, a segment leads from where its border leaves the inside to where it came in: corners inside are never joined across a side.
  const next = new Map<number, number>();
  for (const corners of sides) {
    const isIn = corners.map((corner) => ((inside >> corner) & 1) === 1);
    for (let at = 0; at < 4; at++) {
      if (!isIn[at] || isIn[(at + 1) % 4]) continue;
      let first = at;
      while (isIn[(first + 3) % 4]) first = (first + 3) % 4;
      next.set(edgeBetween(corners[at], corners[(at + 1) % 4]), edgeBetween(corners[(first + 3) % 4], corners[first]));
    }
  }
  const polygons: number[][] = [];
  for (const begin of [...next.keys()]) {
    const loop: number[] = [];
    for (let edge: number | undefined = begin; edge !== undefined && next.has(edge); ) {
      loop.push(edge);
      const following: number | undefined = next.get(edge);
      next.delete(edge);
      edge = following;
    }
    if (loop.length > 0) polygons.push(loop.reverse());
  }
  return polygons;
}

// Meshes as the worker keeps them, and what all generators are made of. Vertices are not shared between parts: the cutter welds by
// position.
export interface MeshArrays {
  positions: Float64Array;
  triangles: Uint32Array;
}

export type Point = readonly [number, number, number];

export function fromPoints(points: readonly Point[], triangles: readonly number[]): MeshArrays {
  return { positions: new Float64Array(points.flat()), triangles: new Uint32Array(triangles) };
}

export function merged(...meshes: readonly MeshArrays[]): MeshArrays {
  const positions: number[] = [];
  const triangles: number[] = [];
  for (const mesh of meshes) {
    const base = positions.length / 3;
    for (const x of mesh.positions) positions.push(x);
    for (const v of mesh.triangles) triangles.push(base + v);
  }
  return { positions: new Float64Array(positions), triangles: new Uint32Array(triangles) };
}

/** The same surface with its other side out. */
export function flipped(mesh: MeshArrays): MeshArrays {
  const triangles = mesh.triangles.slice();
  for (let t = 0; t < triangles.length; t += 3) {
    triangles[t + 1] = mesh.triangles[t + 2];
    triangles[t + 2] = mesh.triangles[t + 1];
  }
  return { positions: mesh.positions, triangles };
}

export function moved(mesh: MeshArrays, place: (p: Point) => Point): MeshArrays {
  const positions = new Float64Array(mesh.positions.length);
  for (let v = 0; v < positions.length; v += 3) {
    positions.set(place([mesh.positions[v], mesh.positions[v + 1], mesh.positions[v + 2]]), v);
  }
  return { positions, triangles: mesh.triangles };
}

/**
 * The surface through rings of points, one behind the other. A ring of one point is a pole. Seen along the path of the rings, their points
 * run clockwise around what is inside. `around` joins the last point of a ring to its first, `along` the last ring to the first.
 */
export function loft(rings: readonly (readonly Point[])[], { around = false, along = false } = {}): MeshArrays {
  const firsts: number[] = [];
  const points: Point[] = [];
  for (const ring of rings) {
    firsts.push(points.length);
    points.push(...ring);
  }
  const triangles: number[] = [];
  const pairs = along ? rings.length : rings.length - 1;
  for (let k = 0; k < pairs; ++k) {
    const next = (k + 1) % rings.length;
    const at = (ring: number, i: number) => firsts[ring] + (i % rings[ring].length);
    const longer = Math.max(rings[k].length, rings[next].length);
    for (let i = 0; i < (around ? longer : longer - 1); ++i) {
      if (rings[k].length > 1) triangles.push(at(k, i), at(k, i + 1), at(next, i + 1));
      if (rings[next].length > 1) triangles.push(at(k, i), at(next, i + 1), at(next, i));
    }
  }
  return fromPoints(points, triangles);
}

/** A sheet of nx by ny squares whose vertices lie at at(i, j). */
export function sheet(nx: number, ny: number, at: (i: number, j: number) => Point): MeshArrays {
  return loft(range(ny + 1).map((j) => range(nx + 1).map((i) => at(i, j))));
}

/** A horizontal circle about the y axis, from the x axis towards -z: counter-clockwise seen from above. */
export function circle(radius: number, y: number, slices: number): Point[] {
  return range(slices).map((i) => {
    const angle = (2 * Math.PI * i) / slices;
    return [radius * Math.cos(angle), y, -radius * Math.sin(angle)];
  });
}

/**
 * Surface of revolution about the y axis of a profile (radius, y); it is outward if the profile goes up on the outside. Radius 0 is a
 * pole.
 */
export function revolved(profile: readonly (readonly [number, number])[], slices: number): MeshArrays {
  return loft(
    profile.map(([radius, y]) => (radius === 0 ? [[0, y, 0]] : circle(radius, y, slices))),
    { around: true },
  );
}

export function range(n: number): number[] {
  return Array.from({ length: n }, (_, k) => k);
}

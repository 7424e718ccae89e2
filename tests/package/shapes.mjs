// Small meshes for the tests of the package.

/** An axis-aligned box from `min` to `max`, oriented outward. */
export function box(min, max) {
  const positions = [];
  for (let corner = 0; corner < 8; ++corner) for (let d = 0; d < 3; ++d) positions.push((corner >> d) & 1 ? max[d] : min[d]);
  const triangles = [0, 2, 3, 0, 3, 1, 4, 5, 7, 4, 7, 6, 0, 1, 5, 0, 5, 4, 2, 6, 7, 2, 7, 3, 0, 4, 6, 0, 6, 2, 1, 3, 7, 1, 7, 5];
  return { positions: Float64Array.from(positions), triangles: Uint32Array.from(triangles) };
}

/** A sphere of radius 1 with 8 n^2 triangles: an octahedron, subdivided and blown up. */
export function sphere(n) {
  const ids = new Map();
  const positions = [], triangles = [];
  const vertex = (x, y, z) => {
    const key = `${x},${y},${z}`;
    if (!ids.has(key)) {
      ids.set(key, ids.size);
      const length = Math.sqrt(x * x + y * y + z * z);
      positions.push(x / length, y / length, z / length);
    }
    return ids.get(key);
  };
  for (let octant = 0; octant < 8; ++octant) {
    const [sx, sy, sz] = [0, 1, 2].map((d) => ((octant >> d) & 1 ? -1 : 1));
    const at = (i, j) => vertex(sx * i, sy * j, sz * (n - i - j));
    const add = (a, b, c) => triangles.push(...(sx * sy * sz > 0 ? [a, b, c] : [a, c, b]));
    for (let i = 0; i < n; ++i) {
      for (let j = 0; i + j < n; ++j) {
        add(at(i, j), at(i + 1, j), at(i, j + 1));
        if (i + j < n - 1) add(at(i + 1, j), at(i + 1, j + 1), at(i, j + 1));
      }
    }
  }
  return { positions: Float64Array.from(positions), triangles: Uint32Array.from(triangles) };
}

/** Three numbers. */
export type Vector3 = readonly number[];
type Triple = [number, number, number];

export function add(a: Vector3, b: Vector3): Triple {
  return [a[0] + b[0], a[1] + b[1], a[2] + b[2]];
}

export function subtract(a: Vector3, b: Vector3): Triple {
  return [a[0] - b[0], a[1] - b[1], a[2] - b[2]];
}

export function scale(s: number, a: Vector3): Triple {
  return [s * a[0], s * a[1], s * a[2]];
}

export function dot(a: Vector3, b: Vector3): number {
  return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}

export function cross(a: Vector3, b: Vector3): Triple {
  return [a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]];
}

export function unit(a: Vector3): Triple {
  return scale(1 / Math.hypot(...a), a);
}

/** A unit vector, also of numbers whose squares are too large or too small. */
export function direction(values: readonly number[]): Vector3 {
  const largest = Math.max(...values.map(Math.abs));
  return unit(values.map((x) => x / largest));
}

// Where a camera has to be so that points fill its picture.
import { Vector3 } from 'three';
import { fromUpright, type Up } from '../../model/up';

/** What the camera first looks from: how far to the right, up, and to the front. */
const first = { right: 0.42, up: 0.36, front: 1 };
/** A scene this much deeper than wide is looked at from its side. */
const deep = 1.6;
/** From the nearest point, in scene units. */
const leastDistance = 0.02;

/** The direction from which points, 3 numbers each, are first looked at: from the front. */
export function firstDirection(points: Float32Array, upAxis: Up): Vector3 {
  const [right, up, front] = uprightAxes(upAxis);
  const extent = (axis: Vector3) => {
    const [low, high] = reach(points, axis);
    return high - low;
  };
  const isDeep = extent(front) > deep * extent(right);
  return new Vector3()
    .addScaledVector(right, isDeep ? first.front : first.right)
    .addScaledVector(up, first.up)
    .addScaledVector(front, isDeep ? first.right : first.front)
    .normalize();
}

export function uprightAxes(up: Up): [right: Vector3, up: Vector3, front: Vector3] {
  const axis = (...direction: number[]) => new Vector3(...fromUpright(direction, up));
  return [axis(1, 0, 0), axis(0, 1, 0), axis(0, 0, 1)];
}

/** How far points reach along a direction, both ways, each by its height along another times a slope. */
function reach(points: Float32Array, along: Vector3, height = along, slope = 0): [number, number] {
  const [lx, ly, lz] = [slope * height.x - along.x, slope * height.y - along.y, slope * height.z - along.z];
  const [hx, hy, hz] = [slope * height.x + along.x, slope * height.y + along.y, slope * height.z + along.z];
  let low = -Infinity;
  let high = -Infinity;
  for (let at = 0; at < points.length; at += 3) {
    const [x, y, z] = [points[at], points[at + 1], points[at + 2]];
    low = Math.max(low, lx * x + ly * y + lz * z);
    high = Math.max(high, hx * x + hy * y + hz * z);
  }
  return [-low, high];
}

/**
 * The place and target of a camera that looks against a direction, so that points just fit between the slopes to its sides, and lie in the
 * middle. `slopes` are tangents: to the right and to the top.
 */
export function fit(
  points: Float32Array,
  direction: Vector3,
  up: Vector3,
  slopes: readonly [number, number],
): { position: Vector3; target: Vector3 } {
  const right = up.clone().cross(direction).normalize();
  const over = direction.clone().cross(right);
  // A point at x to the right and z towards the camera is within the slope t of a camera at cx and d if |x - cx| <= t (d - z).
  const [left, farRight] = reach(points, right, direction, slopes[0]);
  const [bottom, top] = reach(points, over, direction, slopes[1]);
  const [back, front] = reach(points, direction);
  const distance = Math.max((farRight - left) / (2 * slopes[0]), (top - bottom) / (2 * slopes[1]), front + leastDistance);
  const middle = right.multiplyScalar((left + farRight) / 2).addScaledVector(over, (bottom + top) / 2);
  return {
    position: middle.clone().addScaledVector(direction, distance),
    target: middle.addScaledVector(direction, (back + front) / 2),
  };
}

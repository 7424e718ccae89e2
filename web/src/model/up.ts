// Models that stand along y or along z.
import type { Vector3 } from './vector';

/** The axis of a mesh that points upwards. */
export type Up = 'x' | 'y' | 'z';

/** Which axes, and which way along them, point to the right, up, and to the viewer, who looks at the front. */
const frames: Record<Up, readonly (readonly [axis: number, sign: 1 | -1])[]> = {
  x: [
    [1, -1],
    [0, 1],
    [2, 1],
  ],
  y: [
    [0, 1],
    [1, 1],
    [2, 1],
  ],
  z: [
    [0, 1],
    [2, 1],
    [1, -1],
  ],
};

/** As to the right, up, and to the viewer. */
export function toUpright(vector: Vector3, up: Up): Vector3 {
  const [right, over, front] = frames[up].map(([axis, sign]) => sign * vector[axis]);
  return [right, over, front];
}

export function fromUpright(vector: Vector3, up: Up): Vector3 {
  const result: [number, number, number] = [0, 0, 0];
  frames[up].forEach(([axis, sign], d) => (result[axis] = sign * vector[d]));
  return result;
}

// The way of a camera from one place to another: around what it looks at, not through it.
import { MathUtils, Quaternion, Spherical, Vector3 } from 'three';

/** Where a camera is and what it looks at. */
export interface Place {
  position: Vector3;
  target: Vector3;
}

/** A share of the way, for a camera that stands upright. */
export function placeBetween(from: Place, to: Place, share: number, up: Vector3): Place {
  const toUp = new Quaternion().setFromUnitVectors(new Vector3(0, 1, 0), up);
  const toY = toUp.clone().invert();
  const [a, b] = [from, to].map(({ position, target }) =>
    new Spherical().setFromVector3(position.clone().sub(target).applyQuaternion(toY)),
  );
  const around = MathUtils.euclideanModulo(b.theta - a.theta + Math.PI, 2 * Math.PI) - Math.PI;
  const radius = a.radius * (b.radius / a.radius) ** share;
  const offset = new Vector3().setFromSphericalCoords(radius, MathUtils.lerp(a.phi, b.phi, share), a.theta + share * around);
  const target = from.target.clone().lerp(to.target, share);
  return { position: offset.applyQuaternion(toUp).add(target), target };
}

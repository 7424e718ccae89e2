// Where a ray meets what is drawn: on a triangle of a cell, or at a corner nearby.
import { Ray, Vector3, type PerspectiveCamera } from 'three';
import type { MeasuredPlace } from '../../model/measurement';
import { movedBy } from './explosion';
import type { Layer, Look } from './layer';
import type { Picked } from './picking';
import type { Piece } from './piece';
import type { Point } from './pointer';
import { sceneScale } from './scene_space';

/** How near a corner has to be seen to be taken for the place, in pixels. */
const reach = 9;

/** A ray from the eye through a point of the canvas, in the model's units less its origin. */
export function rayAt(look: Look, camera: PerspectiveCamera, { x, y }: Point, { clientWidth, clientHeight }: HTMLCanvasElement): Ray {
  const through = new Vector3((2 * x) / clientWidth - 1, 1 - (2 * y) / clientHeight, 0).unproject(camera);
  const origin = camera.position.clone();
  const direction = through.sub(origin).normalize();
  return new Ray(origin.divideScalar(sceneScale(look.model)), direction);
}

/** The size of a pixel at a distance of 1. */
export function pixelAt({ fov }: PerspectiveCamera, { clientHeight }: HTMLCanvasElement): number {
  return (2 * Math.tan((fov * Math.PI) / 360)) / clientHeight;
}

/** The triangles that are drawn of what was picked: of a cut-cell, of a box, or caps of untouched cells. */
function piecesOf(layers: readonly Layer[], picked: Picked): Piece[] {
  const pieces: Piece[] = [];
  const { cell = -1, box = -1 } = picked ?? {};
  for (const layer of layers) layer.forEachPiece?.((piece) => pieces.push(piece), { cell, box });
  return pieces;
}

interface Hit {
  piece: Piece;
  at: Vector3;
}

/** Where a ray first meets what was picked, in front of all else; `pixel` is the size of one at a distance of 1. */
export function hitOn(layers: readonly Layer[], look: Look, picked: Picked, ray: Ray, pixel: number): MeasuredPlace | null {
  const pieces = piecesOf(layers, picked);
  const met = firstHit(pieces, look, ray);
  if (!met) return null;
  const { piece, at } = cornerNear(pieces, look, ray, reach * pixel * met.at.distanceTo(ray.origin)) ?? met;
  const by = movedBy(look, piece.middle, piece.region);
  const point = at.toArray().map((x, d) => x - by[d] + look.model.origin[d]);
  return { point, middle: Array.from(piece.middle), region: piece.region };
}

function firstHit(pieces: readonly Piece[], look: Look, ray: Ray): Hit | null {
  let first: Hit | null = null;
  let least = Infinity;
  for (const piece of pieces) {
    const [a, b, c] = cornersOf(look, piece);
    const at = ray.intersectTriangle(a, b, c, false, new Vector3());
    const far = at?.distanceTo(ray.origin) ?? Infinity;
    if (at && far < least && isKept(look, piece, at)) [first, least] = [{ piece, at }, far];
  }
  return first;
}

/** The corner that is seen nearest to a ray, within some distance of it. */
function cornerNear(pieces: readonly Piece[], look: Look, ray: Ray, within: number): Hit | null {
  const corners = pieces.flatMap((piece) => cornersOf(look, piece).map((at) => ({ piece, at, off: ray.distanceToPoint(at) })));
  const near = corners.filter(({ piece, at, off }) => off < within && isKept(look, piece, at)).sort((a, b) => a.off - b.off);
  const isSeen = ({ at }: Hit) => {
    const far = at.distanceTo(ray.origin);
    const before = firstHit(pieces, look, new Ray(ray.origin, at.clone().sub(ray.origin).normalize()));
    return !before || before.at.distanceTo(ray.origin) > far - 0.1 * within;
  };
  return near.find(isSeen) ?? null;
}

function cornersOf(look: Look, { corners, middle, region }: Piece): Vector3[] {
  const by = new Vector3(...movedBy(look, middle, region));
  return [0, 3, 6].map((at) => new Vector3(corners[at], corners[at + 1], corners[at + 2]).add(by));
}

/** Whether flat cuts leave this point of a piece. */
function isKept(look: Look, { middle, region, ownPlane }: Piece, at: Vector3): boolean {
  if (look.settings.sliceMode !== 'flat') return true;
  const rest = at.clone().sub(new Vector3(...movedBy(look, middle, region)));
  return look.planes.every(
    ({ normal, offset }, p) => p === ownPlane || rest.dot(new Vector3(...normal)) <= offset + 1e-6 * look.model.diagonal,
  );
}

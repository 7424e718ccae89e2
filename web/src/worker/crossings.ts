// Where the surface meets itself: exactly what findIntersections() gives, as segments.
import type { Mandoline, MeshIntersections } from 'mandoline-wasm';
import { boundsOf, type Bounds } from '../model/grid_around';
import type { Crossings } from '../model/instead';
import type { Cut } from './kept';

/** More can't be told apart on a screen, and fill memory. */
const mostPairs = 200_000;
/** The least that is looked at, as a share of the mesh's size. */
const leastRadius = 0.05;

export function crossingsOf(mandoline: Mandoline, { mesh, origin }: Pick<Cut, 'mesh' | 'origin'>): Crossings {
  const found = mandoline.findIntersections(mesh, { maxPairs: mostPairs });
  const { points, position } = pointsOf(found);
  const segments = segmentsOf(found, points);
  const ends = new Float32Array(3 * segments.length);
  segments.forEach((point, at) => {
    for (let d = 0; d < 3; d++) ends[3 * at + d] = position[3 * point + d] - origin[d];
  });
  const { min, max } = boundsOf({ positions: Float64Array.from(position), triangles: Uint32Array.from(longestCurve(segments, position)) });
  const size = (box: Bounds) => Math.hypot(...box.max.map((x, d) => x - box.min[d]));
  const middle = (d: number) => 0.5 * min[d] + 0.5 * max[d] - origin[d];
  return {
    kind: 'crossings',
    pairs: found.pairKinds.length,
    segments: ends,
    center: [middle(0), middle(1), middle(2)],
    radius: Math.max(size({ min, max }) / 2, leastRadius * size(mesh.bounds)),
  };
}

/** Per point of the pairs, its id among those that differ, and where these are. The same point of several pairs has the same bits. */
function pointsOf({ positions }: MeshIntersections): { points: Uint32Array; position: number[] } {
  const ids = new Map<string, number>();
  const position: number[] = [];
  const points = new Uint32Array(positions.length / 3);
  for (let at = 0; at < points.length; at++) {
    const place = positions.subarray(3 * at, 3 * at + 3);
    const key = place.join();
    const id = ids.get(key) ?? ids.size;
    if (id === ids.size) {
      ids.set(key, id);
      position.push(...place);
    }
    points[at] = id;
  }
  return { points, position };
}

/** 2 points per segment, each segment once: the outlines of what the pairs have in common. A point is a segment of no length. */
function segmentsOf({ pairPointOffsets }: MeshIntersections, points: Uint32Array): number[] {
  const known = new Set<number>();
  const segments: number[] = [];
  for (let pair = 0; pair + 1 < pairPointOffsets.length; pair++) {
    const [begin, end] = [pairPointOffsets[pair], pairPointOffsets[pair + 1]];
    for (let at = begin; at < end; at++) {
      const [from, to] = [points[at], points[at + 1 < end ? at + 1 : begin]];
      const key = Math.min(from, to) * points.length + Math.max(from, to);
      if (!known.has(key)) segments.push(from, to);
      known.add(key);
    }
  }
  return segments;
}

/** The points of the connected curve that is longest. */
function longestCurve(segments: readonly number[], position: readonly number[]): number[] {
  const leader = position.filter((_, at) => at % 3 === 0).map((_, point) => point);
  const find = (point: number): number => {
    let at = point;
    while (leader[at] !== at) at = leader[at] = leader[leader[at]];
    return at;
  };
  for (let at = 0; at < segments.length; at += 2) leader[find(segments[at])] = find(segments[at + 1]);
  const lengths = new Map<number, number>();
  for (let at = 0; at < segments.length; at += 2) {
    const [from, to] = [3 * segments[at], 3 * segments[at + 1]];
    const length = Math.hypot(...[0, 1, 2].map((d) => position[to + d] - position[from + d]));
    const curve = find(segments[at]);
    lengths.set(curve, (lengths.get(curve) ?? 0) + length);
  }
  const [longest] = [...lengths].reduce((best, entry) => (entry[1] > best[1] ? entry : best), [-1, -1]);
  return segments.filter((point) => find(point) === longest);
}

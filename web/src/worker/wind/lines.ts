// Streamlines past the mesh, and when what they carry arrives.
import type { Streamlines } from 'mandoline-wasm/physics';
import type { Vector3 } from '../../model/vector';
import type { Wind } from '../../model/wind';
import type { Velocities } from './flows';
import type { Package } from './package';
import type { Tunnel } from './tunnel';

/** So many are drawn. */
const lineCount = 500;
/** Lines begin where the wind would come this close to the box of the mesh, in longest sides of it. */
const closeness = 0.22;
/** Fewer of many seeds than this are not looked for any further: a flat mesh along the wind. */
const mostSeeds = 40 * lineCount;
/** Of the wind: where air is slower, beside the surface, arrivals would be too late to be seen. */
const slowest = 0.03;

export async function tunnelLines(pack: Package, tunnel: Tunnel, flow: Velocities): Promise<Streamlines> {
  const { mesh, cutMesh, cells } = tunnel;
  return pack.physics.streamlines({ mesh, cutMesh, cells, flow }, await seedsOf(pack, tunnel, flow.wind));
}

/** Evenly spread over that part of the sides where the wind enters, from where it reaches the mesh or its surroundings. */
async function seedsOf({ physics }: Package, tunnel: Tunnel, wind: Vector3): Promise<number[]> {
  const near = async (count: number) =>
    nearSeeds(tunnel, wind, await physics.inflowSeeds(tunnel.cutMesh.grid, [wind[0], wind[1], wind[2]], count));
  const few = await near(lineCount);
  return near(Math.min(mostSeeds, Math.ceil((lineCount * lineCount) / Math.max(1, few.length / 3))));
}

function nearSeeds({ mesh }: Tunnel, wind: Vector3, seeds: Float64Array): number[] {
  const { min, max } = mesh.bounds;
  const margin = closeness * Math.max(...max.map((x, d) => x - min[d]));
  const near: number[] = [];
  for (let at = 0; at < seeds.length; at += 3) {
    let first = -Infinity;
    let last = Infinity;
    for (let d = 0; d < 3; d++) {
      const [a, b] = [min[d] - margin - seeds[at + d], max[d] + margin - seeds[at + d]];
      if (wind[d] === 0) {
        if (a > 0 || b < 0) last = -Infinity;
        continue;
      }
      first = Math.max(first, Math.min(a / wind[d], b / wind[d]));
      last = Math.min(last, Math.max(a / wind[d], b / wind[d]));
    }
    if (first <= last) near.push(seeds[at], seeds[at + 1], seeds[at + 2]);
  }
  return near;
}

/** What points of lines that are left out may differ from what is drawn: in longest sides of the mesh, and in speeds of the wind. */
const mostAside = 0.001;
const mostLate = 0.01;
const mostFaster = 0.03;
/** So many points in a row are looked at. */
const mostLeftOut = 12;

/** The lines as they are drawn: without points between which they are straight. `size` is the longest side of the mesh. */
export function drawnLines(lines: Streamlines, [ox, oy, oz]: Vector3, size: number): Wind['lines'] {
  const { points, speeds, offsets } = lines;
  const times = arrivals(lines);
  const kept: number[] = [];
  const starts = new Uint32Array(offsets.length);
  for (let line = 0; line + 1 < offsets.length; line++) {
    const end = offsets[line + 1];
    for (let at = offsets[line]; at < end; ) {
      kept.push(at);
      let next = at + 1;
      while (next + 1 < end && next - at <= mostLeftOut && isStraight(lines, times, at, next + 1, size)) next++;
      at = next;
    }
    starts[line + 1] = kept.length;
  }
  return {
    position: Float32Array.from(kept.flatMap((at) => [points[3 * at] - ox, points[3 * at + 1] - oy, points[3 * at + 2] - oz])),
    arrival: Float32Array.from(kept, (at) => times[at]),
    speed: Float32Array.from(kept, (at) => speeds[at]),
    offsets: starts,
  };
}

/** When what begins with a line arrives at each of its points. */
function arrivals({ points, speeds, offsets }: Streamlines): Float64Array {
  const times = new Float64Array(speeds.length);
  for (let line = 0; line + 1 < offsets.length; line++) {
    for (let at = offsets[line] + 1; at < offsets[line + 1]; at++) {
      const [x, y, z] = [0, 1, 2].map((d) => points[3 * at + d] - points[3 * at - 3 + d]);
      times[at] = times[at - 1] + Math.hypot(x, y, z) / Math.max(slowest, (speeds[at] + speeds[at - 1]) / 2);
    }
  }
  return times;
}

/** Whether the points between two of a line are about where, when and as fast as on the straight way from one to the other. */
function isStraight({ points, speeds }: Streamlines, times: Float64Array, from: number, to: number, size: number): boolean {
  const [ax, ay, az] = [points[3 * from], points[3 * from + 1], points[3 * from + 2]];
  const [bx, by, bz] = [points[3 * to] - ax, points[3 * to + 1] - ay, points[3 * to + 2] - az];
  const square = bx * bx + by * by + bz * bz;
  for (let at = from + 1; at < to; at++) {
    const [x, y, z] = [points[3 * at] - ax, points[3 * at + 1] - ay, points[3 * at + 2] - az];
    const share = (x * bx + y * by + z * bz) / square;
    const between = (values: Float64Array) => values[from] + share * (values[to] - values[from]);
    const isNear = Math.hypot(x - share * bx, y - share * by, z - share * bz) <= mostAside * size;
    const isThen = Math.abs(times[at] - between(times)) <= mostLate * size;
    if (!isNear || !isThen || Math.abs(speeds[at] - between(speeds)) > mostFaster) return false;
  }
  return true;
}

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

/** The lines as they are drawn. */
export function drawnLines({ points, speeds, offsets }: Streamlines, [ox, oy, oz]: Vector3): Wind['lines'] {
  const position = new Float32Array(points.length);
  const arrival = new Float32Array(speeds.length);
  for (let line = 0; line + 1 < offsets.length; line++) {
    let time = 0;
    for (let at = offsets[line]; at < offsets[line + 1]; at++) {
      const [x, y, z] = [points[3 * at], points[3 * at + 1], points[3 * at + 2]];
      if (at > offsets[line]) {
        const length = Math.hypot(x - points[3 * at - 3], y - points[3 * at - 2], z - points[3 * at - 1]);
        time += length / Math.max(slowest, (speeds[at] + speeds[at - 1]) / 2);
      }
      position[3 * at] = x - ox;
      position[3 * at + 1] = y - oy;
      position[3 * at + 2] = z - oz;
      arrival[at] = time;
    }
  }
  return { position, arrival, speed: Float32Array.from(speeds), offsets: offsets.slice() };
}

// What the page gets of a flow: ready to be drawn.
import type { Wind, WindRequest, WindStats } from '../../model/wind';
import { flowOf, type Velocities } from './flows';
import { drawnLines, tunnelLines } from './lines';
import type { Package } from './package';
import { section } from './section';
import { surfaceSpeeds } from './surface';
import type { Tunnel } from './tunnel';

/** `cellTime`: that of making the tunnel, in ms. */
export async function windPicture(pack: Package, tunnel: Tunnel, request: WindRequest, cellTime: number): Promise<Wind> {
  const { cutMesh, origin, mesh } = tunnel;
  const start = performance.now();
  const flow = await flowOf(pack, tunnel, request.direction);
  const solved = performance.now();
  const size = Math.max(...mesh.bounds.max.map((x, d) => x - mesh.bounds.min[d]));
  const lines = drawnLines(await tunnelLines(pack, tunnel, flow), origin, size);
  const surface = request.surface ? surfaceSpeeds(pack, tunnel, flow, request.known !== tunnel.key) : null;
  const sections = request.planes.map((plane) => section(pack, tunnel, flow, plane));
  return {
    tunnel: tunnel.key,
    direction: request.direction,
    origin,
    half: cutMesh.grid.planes.map((planes) => (planes[planes.length - 1] - planes[0]) / 2),
    size,
    lines,
    surface,
    sections,
    stats: {
      ...statsOf(tunnel, flow),
      times: { cells: cellTime, flow: solved - start, picture: performance.now() - solved },
    },
  };
}

function statsOf({ cutMesh, cells }: Tunnel, { cellVelocity, throttled }: Velocities): Omit<WindStats, 'times'> {
  let largest = 0;
  for (let at = 0; at < cellVelocity.length; at += 3) {
    largest = Math.max(largest, cellVelocity[at] ** 2 + cellVelocity[at + 1] ** 2 + cellVelocity[at + 2] ** 2);
  }
  return {
    grid: cutMesh.grid.cells,
    cells: cells.cellRegion.length,
    cutCells: cells.cutCells,
    largestSpeed: Math.sqrt(largest),
    smallestPressure: 1 - largest,
    isThrottled: throttled.length > 0,
  };
}

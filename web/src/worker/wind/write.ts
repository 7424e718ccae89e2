// The flow as files: the cells with their velocities as CSV and VTU, the streamlines as OBJ.
import type { Flow } from 'mandoline-wasm/physics';
import type { Vector3 } from '../../model/vector';
import type { WindFormat } from '../../model/wind';
import { solvedFlow } from './flows';
import { tunnelLines } from './lines';
import type { Package } from './package';
import type { Tunnel } from './tunnel';

export async function writeWind(pack: Package, tunnel: Tunnel, direction: Vector3, format: WindFormat): Promise<Uint8Array> {
  const flow = await solvedFlow(pack, tunnel, direction);
  if (format === 'csv') return new TextEncoder().encode(cellTable(tunnel, flow));
  if (format === 'obj') return pack.mandoline.writeLines(await tunnelLines(pack, tunnel, flow));
  const fields = { phi: flow.phi, velocity: flow.cellVelocity, pressure_coefficient: flow.cellPressure };
  return pack.physics.writeCells(tunnel.cutMesh, tunnel.cells, 'vtu', { fields });
}

const columns = ['cell', 'x', 'y', 'z', 'volume', 'region', 'phi', 'velocity_x', 'velocity_y', 'velocity_z', 'pressure_coefficient'];

/** A line for each cell, at whose centroid the velocity is. */
function cellTable({ cells }: Tunnel, { phi, cellVelocity, cellPressure }: Flow): string {
  const lines = [columns.join()];
  for (let cell = 0; cell < phi.length; cell++) {
    const at = 3 * cell;
    const [place, velocity] = [cells.cellCentroid, cellVelocity].map((values) => values.subarray(at, at + 3).join());
    lines.push([cell, place, cells.cellVolume[cell], cells.cellRegion[cell], phi[cell], velocity, cellPressure[cell]].join());
  }
  return `${lines.join('\n')}\n`;
}

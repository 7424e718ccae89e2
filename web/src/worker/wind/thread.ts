// The thread of the wind tunnel, beside that which cuts: turning the wind and cutting don't wait for each other. It keeps a mesh and the
// tunnel around it.
import type { Mandoline } from 'mandoline-wasm';
import { serve } from 'mandoline-wasm/physics/worker-thread';
import type { Lack, LoadedMesh, WindCallName, WindCalls } from '../../model/calls';
import { solveAhead } from './flows';
import type { Package } from './package';
import { windPicture } from './picture';
import { keyOf, makeTunnel, type Site, type Tunnel } from './tunnel';
import { writeWind } from './write';

type Answering = { [K in WindCallName]: (pack: Package, ask: WindCalls[K]['ask']) => Promise<WindCalls[K]['answer']> };

let mesh: LoadedMesh | null = null;
let tunnel: Tunnel | null = null;

async function tunnelFor(pack: Package, site: Site): Promise<Tunnel> {
  if (mesh?.id !== site.mesh) {
    const lack: Lack = { lacksMesh: site.mesh };
    throw lack;
  }
  if (tunnel?.key !== keyOf(site)) {
    tunnel = null; // its memory is needed
    tunnel = await makeTunnel(pack, mesh, site);
  }
  return tunnel;
}

/** The package loads the modules that compute and write with the first of their calls. */
async function loadModules({ mandoline, physics }: Package): Promise<void> {
  await physics.inflowSeeds({ min: [0, 0, 0], max: [1, 1, 1], cells: [1, 1, 1] }, [1, 0, 0], 1);
  await mandoline.writeLines({ points: [], offsets: Uint32Array.of(0) });
}

const calls: Answering = {
  async keep(_pack, newMesh) {
    mesh = newMesh;
  },
  async wind(pack, request) {
    const start = performance.now();
    const cells = await tunnelFor(pack, request);
    return windPicture(pack, cells, request, performance.now() - start);
  },
  async windAhead(pack) {
    if (tunnel) return solveAhead(pack, tunnel);
    await loadModules(pack);
    return false;
  },
  async writeWind(pack, { request, format }) {
    return writeWind(pack, await tunnelFor(pack, request), request.direction, format);
  },
};

for (const [name, call] of Object.entries(calls) as [WindCallName, (pack: Package, ask: unknown) => unknown][]) {
  serve({ [name]: (mandoline: Mandoline, [ask]) => call({ mandoline, physics: mandoline as unknown as Package['physics'] }, ask) });
}

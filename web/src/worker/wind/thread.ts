// The thread of the wind tunnel, beside that which cuts: turning the wind and cutting don't wait for each other. It keeps a mesh and the
// tunnel around it.
import type { Mandoline } from 'mandoline-wasm';
import { serve } from 'mandoline-wasm/physics/worker-thread';
import type { Lack, LoadedMesh, WindCallName, WindCalls } from '../../model/calls';
import { solveAhead } from './flows';
import type { Package } from './package';
import { windPicture } from './picture';
import { makeTunnel, type Tunnel } from './tunnel';
import { writeWind } from './write';

type Answering = { [K in WindCallName]: (pack: Package, ask: WindCalls[K]['ask']) => Promise<WindCalls[K]['answer']> };

let mesh: LoadedMesh | null = null;
let tunnel: Tunnel | null = null;

async function tunnelFor(pack: Package, about: { mesh: number; cells: number }): Promise<Tunnel> {
  if (mesh?.id !== about.mesh) {
    const lack: Lack = { lacksMesh: about.mesh };
    throw lack;
  }
  if (tunnel?.mesh !== mesh || tunnel.size !== about.cells) {
    tunnel = null; // its memory is needed
    tunnel = await makeTunnel(pack, mesh, about.cells);
  }
  return tunnel;
}

/** The package loads the module that computes with the first of its calls. */
async function loadModule({ physics }: Package): Promise<void> {
  await physics.inflowSeeds({ min: [0, 0, 0], max: [1, 1, 1], cells: [1, 1, 1] }, [1, 0, 0], 1);
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
    await loadModule(pack);
    return false;
  },
  async writeWind(pack, { request, format }) {
    return writeWind(pack, await tunnelFor(pack, request), request.direction, format);
  },
};

for (const [name, call] of Object.entries(calls) as [WindCallName, (pack: Package, ask: unknown) => unknown][]) {
  serve({ [name]: (mandoline: Mandoline, [ask]) => call({ mandoline, physics: mandoline as unknown as Package['physics'] }, ask) });
}

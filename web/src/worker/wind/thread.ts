// The thread of the wind tunnel, beside that which cuts: turning the wind and cutting don't wait for each other. It keeps a mesh and the
// tunnel around it.
import type { Mandoline } from 'mandoline-wasm';
import { serve } from 'mandoline-wasm/physics/worker-thread';
import type { Lack, LoadedMesh, WindCallName, WindCalls } from '../../model/calls';
import { solveAhead } from './flows';
import { pageError } from '../../model/failure';
import type { Package } from './package';
import type { SmokeFlow } from './smoke';
import { windPicture } from './picture';
import { keyOf, makeTunnel, type Site, type Tunnel } from './tunnel';
import { writeWind } from './write';

type Answering = { [K in WindCallName]: (pack: Package, ask: WindCalls[K]['ask']) => Promise<WindCalls[K]['answer']> };

let mesh: LoadedMesh | null = null;
let tunnel: Tunnel | null = null;
let smoke: SmokeFlow | null = null;

function meshOf(id: number): LoadedMesh {
  if (mesh?.id === id) return mesh;
  const lack: Lack = { lacksMesh: id };
  throw lack;
}

async function tunnelFor(pack: Package, site: Site): Promise<Tunnel> {
  const mesh = meshOf(site.mesh);
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

function endSmoke(): void {
  smoke?.end();
  smoke = null;
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
  loadWind: loadModules,
  async windAhead(pack, request) {
    await windPicture(pack, await tunnelFor(pack, request), request, 0);
  },
  async turnAhead(pack) {
    return tunnel !== null && solveAhead(pack, tunnel);
  },
  async smoke(pack, request) {
    const mesh = meshOf(request.mesh);
    endSmoke();
    tunnel = null; // its memory is needed
    const { SmokeFlow } = await import('./smoke');
    const begun = await SmokeFlow.begin(pack, mesh, request);
    smoke = begun.flow;
    return begun.smoke;
  },
  async smokeStep() {
    if (!smoke) throw pageError('There is no smoke', 'It has ended.');
    return smoke.step();
  },
  async end() {}, // by then all that was asked before is answered
  async writeWind(pack, { request, format }) {
    return writeWind(pack, await tunnelFor(pack, request), request.direction, format);
  },
};

for (const [name, call] of Object.entries(calls) as [WindCallName, (pack: Package, ask: unknown) => unknown][]) {
  serve({ [name]: (mandoline: Mandoline, [ask]) => call({ mandoline, physics: mandoline as unknown as Package['physics'] }, ask) });
}

// What the thread loads before it is asked for.
import type { Mandoline } from 'mandoline-wasm';

const smallestMesh = 'OFF\n3 1 0\n0 0 0\n1 0 0\n0 1 0\n3 0 1 2\n';

export async function loadAhead(mandoline: Mandoline): Promise<void> {
  await Promise.all([
    import('./card'),
    import('./checks'),
    import('./compare'),
    import('./crossings'),
    import('./gltf'),
    import('./steps'),
    import('./three_mf'),
    import('../model/gallery/made'),
    loadFiles(mandoline),
  ]);
}

/** The package loads the module that reads OFF when it is first to read it. */
function loadFiles(mandoline: Mandoline): Promise<unknown> {
  return mandoline.readMesh(new TextEncoder().encode(smallestMesh), { name: 'smallest.off' });
}

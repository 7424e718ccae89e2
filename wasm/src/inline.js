// The WebAssembly and the worker's script within JavaScript. build.mjs puts them in.

const gzippedWasm = 'GZIPPED_WASM';
const workerScript = 'WORKER_SCRIPT';

export async function wasm() {
  const packed = Uint8Array.from(atob(gzippedWasm), (character) => character.charCodeAt(0));
  return new Response(new Blob([packed]).stream().pipeThrough(new DecompressionStream('gzip'))).arrayBuffer();
}

export function thread() {
  if (typeof Worker !== 'function') {
    const { Worker: NodeWorker } = globalThis.process.getBuiltinModule('node:worker_threads');
    return new NodeWorker(new URL(`data:text/javascript,${encodeURIComponent(workerScript)}`), { execArgv: [] });
  }
  const url = URL.createObjectURL(new Blob([workerScript], { type: 'text/javascript' }));
  return new Worker(url, { type: 'module' });
}

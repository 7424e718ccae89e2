// Unpacks what the inline entries hold as text: gzipped WebAssembly and a script.

export async function unpack(gzipped) {
  const packed = Uint8Array.from(atob(gzipped), (character) => character.charCodeAt(0));
  return new Response(new Blob([packed]).stream().pipeThrough(new DecompressionStream('gzip'))).arrayBuffer();
}

/** Starts a worker with a script. */
export function startScript(script) {
  if (typeof Worker !== 'function') {
    const { Worker: NodeWorker } = globalThis.process.getBuiltinModule('node:worker_threads');
    return new NodeWorker(new URL(`data:text/javascript,${encodeURIComponent(script)}`), { execArgv: [] });
  }
  const url = URL.createObjectURL(new Blob([script], { type: 'text/javascript' }));
  return new Worker(url, { type: 'module' });
}

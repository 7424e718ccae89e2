// Unpacks what the inline entries hold as text: gzipped WebAssembly and a script.

export async function unpack(gzipped) {
  const packed = Uint8Array.from(atob(gzipped), (character) => character.charCodeAt(0));
  return new Response(new Blob([packed]).stream().pipeThrough(new DecompressionStream('gzip'))).arrayBuffer();
}

/** Of scripts. What has an address stays in memory as long as the page is there, so each script gets one, for all its threads. */
const addresses = new Map();

function addressOf(script) {
  if (!addresses.has(script)) addresses.set(script, URL.createObjectURL(new Blob([script], { type: 'text/javascript' })));
  return addresses.get(script);
}

/** Starts a worker with a script. */
export function startScript(script) {
  if (typeof Worker !== 'function') {
    const { Worker: NodeWorker } = globalThis.process.getBuiltinModule('node:worker_threads');
    return new NodeWorker(new URL(`data:text/javascript,${encodeURIComponent(script)}`), { execArgv: [] });
  }
  return new Worker(addressOf(script), { type: 'module' });
}

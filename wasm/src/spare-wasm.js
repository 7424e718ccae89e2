// For toolchains that take the package's code along and leave the files behind that lie beside it: bundlers for servers, and Vite before
// version 8 in development. There the WebAssembly comes from inline.js.
import { fileBeside, ownWasm } from './own-wasm.js';

const { source } = ownWasm;
const inNode = Boolean(globalThis.process?.versions?.node);

/** The file in Node; undefined if it is not there. */
function fileInNode() {
  try {
    const file = fileBeside('mandoline.wasm');
    return globalThis.process.getBuiltinModule('node:fs').existsSync(file) ? file : undefined;
  } catch {
    return undefined; // code that is no module any more does not know where it is
  }
}

/** Where mandoline.wasm is; undefined if it is not beside the code. */
export function address() {
  if (inNode) return fileInNode();
  const url = source();
  return /\/deps\/mandoline\.wasm$/.test(url) ? undefined : url; // Vite keeps what it has bundled in "deps"
}

ownWasm.source = async () => address() ?? (await import('./inline.js')).wasm();

// For toolchains that take the package's code along and leave the two files behind that lie beside it: bundlers for servers, and Vite
// before version 8 in development. There the files come from inline.js.
import { fileBeside, ownFiles } from './own-files.js';

const { wasm, thread } = ownFiles;
const inline = () => import('./inline.js');
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

function address() {
  if (inNode) return fileInNode();
  const url = wasm();
  return /\/deps\/mandoline\.wasm$/.test(url) ? undefined : url; // Vite keeps what it has bundled in "deps"
}

ownFiles.wasm = async () => address() ?? (await inline()).wasm();
ownFiles.thread = async () => (address() ? thread() : (await inline()).thread);

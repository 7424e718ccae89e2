// For toolchains that move the package's code but leave behind the files beside it: bundlers for servers, and Vite before version 8 in
// development. There the WebAssembly comes from inline.js.
import './bricks/spare-wasm.js';
import './files/spare-wasm.js';
import { addressOf } from './beside.js';
import { ownWasm } from './own-wasm.js';

const { source } = ownWasm;

/** Where mandoline.wasm is; undefined if it is not beside the code. */
export const address = () => addressOf('mandoline.wasm', source, import.meta.url);

ownWasm.source = async () => address() ?? (await import('./inline.js')).wasm();

// For files.wasm, as in ../spare-wasm.js.
import { addressOf } from '../beside.js';
import { ownFileWasm } from './own-wasm.js';

const { source } = ownFileWasm;

ownFileWasm.source = async () => addressOf('files.wasm', source, import.meta.url) ?? (await import('../inline.js')).filesWasm();

// For bricks.wasm, as in ../spare-wasm.js.
import { addressOf } from '../beside.js';
import { ownBrickWasm } from './own-wasm.js';

const { source } = ownBrickWasm;

ownBrickWasm.source = async () => addressOf('bricks.wasm', source, import.meta.url) ?? (await import('../inline.js')).bricksWasm();

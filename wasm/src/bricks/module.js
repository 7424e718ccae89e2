// The module that is loaded when one of its calls is first made: the cutter once more, for cuts again, brick by brick and of refined cells.
import { cutMesh } from '../kinds.js';
import createModule from './bricks.js';
import { brickCalls } from './calls.js';

export const brickModule = { name: 'bricks', createModule, kinds: { cutMesh }, calls: brickCalls };

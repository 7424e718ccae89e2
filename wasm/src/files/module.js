// The module that is loaded when one of its calls is first made: validation, and files written and read.
import { cutMesh } from '../kinds.js';
import { fileCalls } from './calls.js';
import createModule from './files.js';

export const fileModule = { name: 'files', createModule, kinds: { cutMesh }, calls: fileCalls };

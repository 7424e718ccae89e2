// The module of the main entry, which cuts: { name, createModule, kinds, calls }, as each of the package's modules is described.
import { cutCalls } from './calls.js';
import { cutMesh, prepared } from './kinds.js';
import createModule from './mandoline.js';

export const cutModule = { name: 'cut', createModule, kinds: { cutMesh, prepared }, calls: cutCalls };

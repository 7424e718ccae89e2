// The meshes of the gallery that are made: the paper's cases, and surfaces that cross themselves. They are y-up.
import { boysSurface, crossingTori, kleinBottle, pushedBlob } from './crossing';
import { claw, emptyCones, oscillator, wedge } from './difficult';
import type { MeshArrays } from './mesh';
import { crate, doubleBubble, moebiusStrip, pages, thinBowl, trumpet, wavyPlane, wavySlab } from './sheets';
import { alignedSteps, gears, nestedSpheres, noisySphere } from './solids';
import { teapot } from './teapot';
import { chain, hollowHilbertCurve, torusKnot } from './tubes';

export const makers = new Map<string, () => MeshArrays>([
  ['passing-tori', crossingTori],
  ['turning-gears', gears],
  ['hilbert', hollowHilbertCurve],
  ['wavy-plane', wavyPlane],
  ['wavy-slab', wavySlab],
  ['wedge', wedge],
  ['empty-cone', emptyCones],
  ['claw', claw],
  ['oscillator', oscillator],
  ['nested-spheres', nestedSpheres],
  ['thin-bowl', thinBowl],
  ['double-bubble', doubleBubble],
  ['moebius-strip', moebiusStrip],
  ['torus-knot', torusKnot],
  ['chain', chain],
  ['noisy-sphere', noisySphere],
  ['gears', gears],
  ['aligned-steps', alignedSteps],
  ['trumpet', trumpet],
  ['pages', pages],
  ['crate', crate],
  ['crossing-tori', crossingTori],
  ['pushed-blob', pushedBlob],
  ['teapot', teapot],
  ['klein-bottle', kleinBottle],
  ['boys-surface', boysSurface],
]);

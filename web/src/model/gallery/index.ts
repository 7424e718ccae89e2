// The meshes that the page brings along: the paper's cases, a scan, and surfaces that cross themselves. They are y-up.
import bunnyScan from 'bunny';
import { boysSurface, crossingTori, kleinBottle, pushedBlob } from './crossing';
import { claw, emptyCones, oscillator, wedge } from './difficult';
import type { MeshArrays } from './mesh';
import { crate, doubleBubble, moebiusStrip, pages, thinBowl, trumpet, wavyPlane, wavySlab } from './sheets';
import { alignedSteps, gears, nestedSpheres, noisySphere } from './solids';
import { teapot } from './teapot';
import { chain, hollowHilbertCurve, torusKnot } from './tubes';

export type { MeshArrays } from './mesh';
export { gallery, type GalleryEntry } from './list';

function bunny(): MeshArrays {
  const { positions, cells } = bunnyScan;
  return { positions: new Float64Array(positions.flat()), triangles: new Uint32Array(cells.flat()) };
}

const makers = new Map<string, () => MeshArrays | Promise<MeshArrays>>([
  ['bunny', bunny],
  ['bunny-in-wind', bunny],
  ['adaptive-grid', bunny],
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

export async function galleryMesh(name: string): Promise<MeshArrays> {
  const make = makers.get(name);
  if (!make) throw new Error(`There is no "${name}" in the gallery.`);
  return make();
}

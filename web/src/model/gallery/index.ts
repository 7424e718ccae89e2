// The meshes that the page brings along. They are y-up.
import bunnyScan from 'bunny';
import type { MeshArrays } from './mesh';

export type { MeshArrays } from './mesh';
export { gallery, type GalleryEntry } from './list';

const bunnies = ['bunny', 'bunny-in-wind', 'adaptive-grid'];

function bunny(): MeshArrays {
  const { positions, cells } = bunnyScan;
  return { positions: new Float64Array(positions.flat()), triangles: new Uint32Array(cells.flat()) };
}

/** The bunny is seen first; what makes all others is loaded with the first of them. */
export async function galleryMesh(name: string): Promise<MeshArrays> {
  if (bunnies.includes(name)) return bunny();
  const { makers } = await import('./made');
  const make = makers.get(name);
  if (!make) throw new Error(`There is no "${name}" in the gallery.`);
  return make();
}

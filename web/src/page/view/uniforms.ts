import { Vector4 } from 'three';
import type { Look } from './layer';
import type { Uniforms } from './material';

/** About so many cells share an edge, each of which draws it. */
const cellsPerEdge = 2.8;

/** What of a look all materials share, on so many pixels. */
export function setUniforms(uniforms: Uniforms, { model, settings, planes }: Look, pixels: number): void {
  uniforms.explodeCells.value = settings.explode.cells;
  uniforms.explodeRegions.value = settings.explode.regions;
  uniforms.planeCount.value = planes.length;
  planes.forEach(({ normal, offset }, p) => (uniforms.planes.value[p] = new Vector4(...normal, offset)));
  uniforms.flatCut.value = settings.sliceMode === 'flat';
  uniforms.byKind.value = settings.colorBy === 'kind';
  // So many lines that they fill the picture would only darken it.
  const pixelsPerEdge = (pixels * cellsPerEdge) / (model.edges.index.length / 2);
  uniforms.lineOpacity.value = 0.5 * Math.min(1, Math.max(0.3, Math.sqrt(pixelsPerEdge / 20)));
}

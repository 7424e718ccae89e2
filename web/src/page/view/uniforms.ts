import { Vector4 } from 'three';
import type { Look } from './layer';
import type { Uniforms } from './material';

/** What of a look all materials share, in a picture of this height in CSS pixels. */
export function setUniforms(uniforms: Uniforms, { model, settings, planes }: Look, height: number): void {
  uniforms.explodeCells.value = settings.explode.cells;
  uniforms.explodeRegions.value = settings.explode.regions;
  uniforms.planeCount.value = planes.length;
  planes.forEach(({ normal, offset }, p) => (uniforms.planes.value[p] = new Vector4(...normal, offset)));
  uniforms.flatCut.value = settings.sliceMode === 'flat';
  uniforms.byKind.value = settings.colorBy === 'kind';
  uniforms.cellSize.value = model.diagonal / Math.hypot(...model.grid.cells);
  uniforms.stageHeight.value = height;
}

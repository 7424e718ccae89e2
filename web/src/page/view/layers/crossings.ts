// Where the surface meets itself: glowing lines in front of the faint surface.
import type { Group } from 'three';
import type { Layer, Look } from '../layer';
import type { Uniforms } from '../material';
import { Strokes } from '../strokes';

/** The line, and the light around it: widths in pixels. */
const strokes = [
  { width: 2.5, opacity: 1 },
  { width: 8, opacity: 0.4 },
  { width: 18, opacity: 0.18 },
];

export class CrossingCurves implements Layer {
  readonly object: Group;
  private readonly strokes: Strokes;

  constructor({ accent }: Uniforms) {
    this.strokes = new Strokes(strokes.map((stroke, depth) => ({ ...stroke, color: accent, depth })));
    this.object = this.strokes.object;
  }

  dependsOn({ instead }: Look): readonly unknown[] {
    return [instead];
  }

  setLook({ instead }: Look): void {
    const crossings = instead?.kind === 'crossings' ? instead : null;
    this.object.visible = crossings !== null;
    this.strokes.segments = crossings?.segments ?? new Float32Array(0);
  }
}

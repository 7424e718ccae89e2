// A distance that is measured: the line, its ways along x, y and z, and the places at its ends.
import { Color, Group } from 'three';
import type { MeasuredPlace } from '../../../model/measurement';
import { movedBy } from '../explosion';
import type { Layer, Look } from '../layer';
import type { Uniforms } from '../material';
import { Strokes } from '../strokes';
import { axisColors } from './frames';

export class Ruler implements Layer {
  readonly object = new Group();
  private readonly line: Strokes;
  private readonly ends: Strokes;
  private readonly ways: readonly Strokes[];

  constructor({ accent }: Uniforms) {
    this.line = new Strokes([{ color: accent, width: 3, opacity: 1, depth: 1 }]);
    this.ends = new Strokes([{ color: accent, width: 11, opacity: 1, depth: 0 }]);
    this.ways = axisColors.map((color, d) => {
      return new Strokes([{ color: { value: new Color(color) }, width: 2, opacity: 0.9, depth: 2 + d }]);
    });
    this.object.add(...[this.line, this.ends, ...this.ways].map(({ object }) => object));
  }

  dependsOn({ model, measurement, instead, settings: { explode } }: Look): readonly unknown[] {
    return [model.id, measurement, instead, explode];
  }

  setLook(look: Look): void {
    const { measurement, instead } = look;
    this.object.visible = measurement !== null && instead === null;
    if (!measurement) return;
    const [from, to] = [measurement.from, measurement.to].map((place) => place && drawnAt(look, place));
    this.ends.segments = Float32Array.from([from, to].flatMap((end) => (end ? [...end, ...end] : [])));
    const way = from && to && [from, [to[0], from[1], from[2]], [to[0], to[1], from[2]], to];
    this.line.segments = Float32Array.from(from && to ? [...from, ...to] : []);
    this.ways.forEach((strokes, d) => (strokes.segments = Float32Array.from(way ? [...way[d], ...way[d + 1]] : [])));
  }
}

function drawnAt(look: Look, { point, middle, region }: MeasuredPlace): number[] {
  const by = movedBy(look, middle, region);
  return point.map((x, d) => x - look.model.origin[d] + by[d]);
}

import { BufferGeometry, Float32BufferAttribute, Group, LineBasicMaterial, LineSegments } from 'three';
import type { Model } from '../../../model/cut_model';
import type { SliceName, ViewPlane } from '../../../model/slices';
import type { Layer, Look } from '../layer';

const colors: Record<SliceName, number> = { x: 0xd9534f, y: 0x4fae5a, z: 0x3f83d6, free: 0xd78f1f };

/** Of x, y and z. */
export const axisColors = [colors.x, colors.y, colors.z];

/** How long a plane that has been moved is seen, in ms. */
const seenFor = 700;

/** Outlines of the slice planes where they cut the grid's box, while they are moved. */
export class Frames implements Layer {
  readonly object = new Group();
  onChange = () => {};
  private model = 0;
  private planes: readonly ViewPlane[] = [];
  private timer: ReturnType<typeof setTimeout> | undefined;
  private readonly lines = { x: makeLines('x'), y: makeLines('y'), z: makeLines('z'), free: makeLines('free') };

  dependsOn({ model, planes, settings }: Look): readonly unknown[] {
    return [model.id, planes, settings.explode.cells];
  }

  setLook({ model, planes, settings }: Look): void {
    if (model.id !== this.model) this.object.visible = false;
    else if (planes !== this.planes) this.show();
    this.model = model.id;
    this.planes = planes;
    this.object.scale.setScalar(1 + settings.explode.cells);
    this.object.clear();
    for (const plane of planes) {
      const lines = this.lines[plane.name];
      lines.geometry.dispose();
      lines.geometry = lineGeometry(outline(model, plane));
      this.object.add(lines);
    }
  }

  private show(): void {
    clearTimeout(this.timer);
    this.object.visible = true;
    this.timer = setTimeout(() => {
      this.object.visible = false;
      this.onChange();
    }, seenFor);
  }
}

function makeLines(name: SliceName): LineSegments {
  const lines = new LineSegments(lineGeometry([]), new LineBasicMaterial({ color: colors[name], transparent: true, opacity: 0.7 }));
  lines.frustumCulled = false;
  return lines;
}

function lineGeometry(position: number[]): BufferGeometry {
  return new BufferGeometry().setAttribute('position', new Float32BufferAttribute(position, 3));
}

/** The segments in which a plane cuts the sides of the box: each side is cut where two of its edges are. */
function outline(model: Model, { normal, offset }: ViewPlane): number[] {
  const half = model.grid.planes.map((planes) => (1.01 * (planes[planes.length - 1] - planes[0])) / 2);
  const corner = (bits: number) => half.map((h, d) => (bits & (1 << d) ? h : -h));
  const height = (point: number[]) => normal.reduce((sum, n, d) => sum + n * point[d], -offset);
  const segments: number[] = [];
  for (const [axis, side] of [0, 1, 2].flatMap((d) => [
    [d, 0],
    [d, 1],
  ])) {
    const [u, v] = [1 << ((axis + 1) % 3), 1 << ((axis + 2) % 3)];
    const corners = [0, u, u | v, v].map((bits) => corner(bits | (side << axis)));
    const ends = corners.flatMap((from, at) => {
      const to = corners[(at + 1) % 4];
      const [a, b] = [height(from), height(to)];
      return a > 0 === b > 0 ? [] : [from.map((x, d) => x + (a / (a - b)) * (to[d] - x))];
    });
    for (const end of ends) segments.push(...end);
  }
  return segments;
}

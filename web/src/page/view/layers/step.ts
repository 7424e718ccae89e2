// The picture of a step of the algorithm, over a faint surface.
import { BufferGeometry, DoubleSide, Group } from 'three';
import { LineBasicMaterial, LineSegments, Mesh, MeshBasicMaterial, Points, PointsMaterial } from 'three';
import { refill } from '../buffers';
import type { Layer, Look } from '../layer';

export class Step implements Layer {
  readonly object = new Group();
  private readonly faces = new Mesh(
    new BufferGeometry(),
    new MeshBasicMaterial({ vertexColors: true, side: DoubleSide, polygonOffset: true, polygonOffsetFactor: 1, polygonOffsetUnits: 2 }),
  );
  private readonly lines = new LineSegments(new BufferGeometry(), new LineBasicMaterial({ vertexColors: true }));
  private readonly points = new Points(new BufferGeometry(), new PointsMaterial({ vertexColors: true, size: 7, sizeAttenuation: false }));

  constructor() {
    for (const object of [this.faces, this.lines, this.points]) object.frustumCulled = false;
    this.object.add(this.faces, this.lines, this.points);
  }

  dependsOn({ instead }: Look): readonly unknown[] {
    return [instead];
  }

  setLook({ instead }: Look): void {
    const step = instead?.kind === 'crossings' ? null : instead;
    this.object.visible = step !== null;
    if (!step) return;
    for (const part of ['faces', 'lines', 'points'] as const) {
      const { position, color } = step[part];
      refill(this[part].geometry, { position: { array: position, size: 3 }, color: { array: color, size: 3 } });
    }
  }

  setPixelRatio(ratio: number): void {
    this.points.material.size = 7 * ratio;
  }
}

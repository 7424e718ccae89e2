// The picture of a step of the algorithm, over a faint surface.
import { BufferAttribute, BufferGeometry, DoubleSide, Group } from 'three';
import { LineBasicMaterial, LineSegments, Mesh, MeshBasicMaterial, Points, PointsMaterial } from 'three';
import type { StepPicture } from '../../model/types';

export class Step {
  readonly group = new Group();
  private readonly faces = new Mesh(
    new BufferGeometry(),
    new MeshBasicMaterial({ vertexColors: true, side: DoubleSide, polygonOffset: true, polygonOffsetFactor: 1, polygonOffsetUnits: 2 }),
  );
  private readonly lines = new LineSegments(new BufferGeometry(), new LineBasicMaterial({ vertexColors: true }));
  private readonly points = new Points(new BufferGeometry(), new PointsMaterial({ vertexColors: true, size: 7, sizeAttenuation: false }));

  constructor() {
    for (const object of [this.faces, this.lines, this.points]) object.frustumCulled = false;
    this.group.add(this.faces, this.lines, this.points);
  }

  set(picture: StepPicture): void {
    for (const part of ['faces', 'lines', 'points'] as const) {
      const geometry = new BufferGeometry();
      geometry.setAttribute('position', new BufferAttribute(picture[part].position, 3));
      geometry.setAttribute('color', new BufferAttribute(picture[part].color, 3));
      this[part].geometry.dispose();
      this[part].geometry = geometry;
    }
  }

  setPixelRatio(ratio: number): void {
    this.points.material.size = 7 * ratio;
  }
}

// The picture of a step of the algorithm, over a faint surface, and the grid cells that hold what it shows.
import { DoubleSide, Group, type BufferGeometry } from 'three';
import { LineBasicMaterial, LineSegments, Mesh, MeshBasicMaterial, Points, PointsMaterial } from 'three';
import { boxEdges, boxPoints } from '../box';
import { emptyGeometry, refill } from '../buffers';
import type { Layer, Look } from '../layer';
import type { Uniforms } from '../material';
import { Strokes } from '../strokes';

export class Step implements Layer {
  readonly object = new Group();
  private readonly faces = new Mesh(
    emptyGeometry(),
    new MeshBasicMaterial({ vertexColors: true, side: DoubleSide, polygonOffset: true, polygonOffsetFactor: 1, polygonOffsetUnits: 2 }),
  );
  private readonly lines = new LineSegments(emptyGeometry(), new LineBasicMaterial({ vertexColors: true }));
  private readonly points = new Points(emptyGeometry(), new PointsMaterial({ vertexColors: true, size: 7, sizeAttenuation: false }));
  private readonly frame: LineSegments<BufferGeometry, LineBasicMaterial>;
  /** The frame as it is seen from afar. */
  private readonly mark: Strokes;

  constructor({ accent }: Uniforms) {
    this.frame = new LineSegments(emptyGeometry(), new LineBasicMaterial());
    this.frame.material.color = accent.value;
    this.mark = new Strokes([
      { color: accent, width: 2, opacity: 1, depth: 0 },
      { color: accent, width: 9, opacity: 0.35, depth: 1 },
    ]);
    for (const object of [this.faces, this.lines, this.points, this.frame]) object.frustumCulled = false;
    this.object.add(this.faces, this.lines, this.points, this.frame, this.mark.object);
    this.seenFromAfar = false;
  }

  /** Points would cover all else then. */
  set seenFromAfar(isAfar: boolean) {
    this.mark.object.visible = isAfar;
    this.points.visible = this.frame.visible = !isAfar;
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
    const edges = Float32Array.from(step.frame ? boxPoints(boxEdges, step.frame.min, step.frame.max) : []);
    refill(this.frame.geometry, { position: { array: edges, size: 3 } });
    this.mark.segments = edges;
  }

  setPixelRatio(ratio: number): void {
    this.points.material.size = 7 * ratio;
  }
}

import type { Vector3 } from 'three';
import type { Camera } from './camera';
import type { Place } from './flight';

/** Takes the camera to what is drawn instead of the model, and back in the end. */
export class Visit {
  private before: (Place & { isFramed: boolean }) | null = null;

  constructor(private readonly camera: Camera) {}

  /** To points, 3 numbers each. */
  begin(points: Float32Array): void {
    const { at, isFramed } = this.camera;
    this.before ??= { ...at, isFramed };
    this.camera.frame(points, true);
    this.camera.flyFrom(at);
  }

  /** Follows a scene that has been moved and scaled, beside the camera. */
  transform(move: (point: Vector3) => Vector3): void {
    const { before } = this;
    if (before) this.before = { ...before, position: move(before.position), target: move(before.target) };
  }

  /** `reframe` brings the whole model into view, if the camera was to see it before. */
  end(reframe: () => void): void {
    const { before } = this;
    if (!before) return;
    this.before = null;
    const { at } = this.camera;
    this.camera.place(before);
    if (before.isFramed) reframe();
    this.camera.flyFrom(at);
  }
}

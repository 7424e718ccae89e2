import type { Vector3 } from 'three';
import type { Camera, Place } from './camera';

/** Takes the camera to what is drawn instead of the model, and back in the end. */
export class Visit {
  private before: (Place & { isFramed: boolean }) | null = null;

  constructor(private readonly camera: Camera) {}

  begin(center: Vector3, radius: number): void {
    const { at, isFramed } = this.camera;
    this.before ??= { ...at, isFramed };
    this.camera.frame(center, radius, true);
    this.camera.flyFrom(at);
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

// The wind tunnel as one layer: pulses, the surface in colours, and the handle.
import { Group, type PerspectiveCamera } from 'three';
import type { Wind } from '../../../model/wind';
import type { Layer, Look } from '../layer';
import type { Uniforms } from '../material';
import { reducedMotion } from '../reduced_motion';
import { WindHandle } from './handle';
import { Pulses } from './pulses';
import { WindSurface } from './surface';
import { makeWindUniforms, setWindUniforms } from './uniforms';

export class WindTunnel implements Layer {
  readonly object = new Group();
  /** Whether the model is drawn by this layer, in its own colours. */
  hidesModel = false;
  private readonly uniforms = makeWindUniforms();
  private readonly pulses: Pulses;
  private readonly surface: WindSurface;
  private readonly handle: WindHandle;
  /** What is drawn. */
  private wind: Wind | null = null;

  constructor(uniforms: Uniforms, camera: PerspectiveCamera, canvas: HTMLCanvasElement) {
    this.pulses = new Pulses(this.uniforms, reducedMotion());
    this.surface = new WindSurface(this.uniforms, uniforms);
    this.handle = new WindHandle(camera, canvas, uniforms.accent);
    this.object.add(this.surface.object, this.handle.object, this.pulses.object);
    this.object.visible = false;
  }

  /** Says what is drawn, in data attributes. */
  tellTests(dataset: DOMStringMap): void {
    dataset.wind = this.object.visible && this.wind ? this.wind.direction.join() : '';
    dataset.windHandle = dataset.wind && this.handle.placeInPicture().join();
  }

  get isTouched(): boolean {
    return this.handle.isTouched;
  }
  set hasHandle(isShown: boolean) {
    this.handle.object.visible = isShown;
  }
  set onChange(listener: () => void) {
    this.handle.onChange = listener;
  }
  set onDragging(listener: WindHandle['onDragging']) {
    this.handle.onDragging = listener;
  }
  set onTurned(listener: WindHandle['onTurned']) {
    this.handle.onTurned = listener;
  }

  dependsOn({ wind, model, settings, instead }: Look): readonly unknown[] {
    return [wind, model.id, settings.wind, instead];
  }

  setLook(look: Look): void {
    const { wind, model, instead } = look;
    this.object.visible = wind !== null && instead === null;
    this.hidesModel = wind?.surface != null;
    this.handle.setLook(look);
    if (!wind) return;
    setWindUniforms(this.uniforms, wind, look);
    this.object.position.fromArray(wind.origin.map((x, d) => x - model.origin[d]));
    if (wind === this.wind) return;
    this.wind = wind;
    this.pulses.set(wind);
    this.surface.set(wind);
  }

  animate(seconds: number): boolean {
    return this.pulses.animate(seconds);
  }

  setPixelRatio(ratio: number): void {
    this.pulses.setPixelRatio(ratio);
  }
}

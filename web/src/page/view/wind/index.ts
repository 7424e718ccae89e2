// The wind tunnel as one layer: pulses or smoke, the surface in colours, and the handle.
import { Group, type PerspectiveCamera } from 'three';
import type { SmokeSource, Wind } from '../../../model/wind';
import type { Layer, Look } from '../layer';
import type { Uniforms } from '../material';
import { reducedMotion } from '../reduced_motion';
import { WindHandle } from './handle';
import { Pulses } from './pulses';
import type { SmokeCloud } from './smoke';
import { WindSurface } from './surface';
import { makeWindUniforms, setSmokeUniforms, setWindUniforms } from './uniforms';

export class WindTunnel implements Layer {
  readonly object = new Group();
  onChange = () => {};
  /** Whether the model is drawn by this layer, in its own colours. */
  hidesModel = false;
  private readonly uniforms = makeWindUniforms();
  /** Stands out from the background. */
  private readonly contrast: Uniforms['boxColor'];
  private readonly pulses: Pulses;
  private readonly surface: WindSurface;
  private readonly handle: WindHandle;
  /** Loaded when there is smoke for the first time. */
  private cloud: SmokeCloud | null = null;
  private isCloudAsked = false;
  private pixelRatio = 1;
  /** What is drawn. */
  private wind: Wind | null = null;
  private smoke: SmokeSource | null = null;

  constructor(uniforms: Uniforms, camera: PerspectiveCamera, canvas: HTMLCanvasElement) {
    this.pulses = new Pulses(this.uniforms, reducedMotion());
    this.surface = new WindSurface(this.uniforms, uniforms);
    this.contrast = uniforms.boxColor;
    this.handle = new WindHandle(camera, canvas, uniforms.accent);
    this.handle.onChange = () => this.onChange();
    this.object.add(this.surface.object, this.handle.object, this.pulses.object);
    this.object.visible = false;
  }

  /** Says what is drawn, in data attributes. */
  tellTests(dataset: DOMStringMap): void {
    const isSeen = this.object.visible;
    dataset.wind = isSeen && this.wind ? this.wind.direction.join() : '';
    dataset.smoke = isSeen && this.smoke && this.cloud ? this.smoke.smoke.direction.join() : '';
    dataset.windHandle = (dataset.wind || dataset.smoke) && this.handle.placeInPicture().join();
  }

  get isTouched(): boolean {
    return this.handle.isTouched;
  }
  set hasHandle(isShown: boolean) {
    this.handle.object.visible = isShown;
  }
  set onDragging(listener: WindHandle['onDragging']) {
    this.handle.onDragging = listener;
  }
  set onTurned(listener: WindHandle['onTurned']) {
    this.handle.onTurned = listener;
  }

  dependsOn({ wind, smoke, model, settings, instead }: Look): readonly unknown[] {
    return [wind, smoke, this.cloud, model.id, settings.wind, instead];
  }

  setLook(look: Look): void {
    const { wind, smoke, model, instead } = look;
    const placed = smoke?.smoke ?? wind;
    this.object.visible = placed !== null && instead === null;
    this.hidesModel = wind?.surface != null;
    this.handle.setLook(look);
    if (placed) this.object.position.fromArray(placed.origin.map((x, d) => x - model.origin[d]));
    this.setWind(wind, look);
    this.setSmoke(smoke);
  }

  private setWind(wind: Wind | null, look: Look): void {
    this.pulses.object.visible = this.surface.object.visible = wind !== null;
    if (wind) setWindUniforms(this.uniforms, wind, look);
    if (wind && wind !== this.wind) {
      this.pulses.set(wind);
      this.surface.set(wind);
    }
    this.wind = wind;
  }

  private setSmoke(smoke: SmokeSource | null): void {
    this.smoke = smoke;
    if (smoke) setSmokeUniforms(this.uniforms, smoke.smoke);
    if (this.cloud) this.cloud.set(smoke);
    else if (smoke) void this.loadCloud();
  }

  /** What can't be loaded is asked for again with the next smoke. */
  private async loadCloud(): Promise<void> {
    if (this.isCloudAsked) return;
    this.isCloudAsked = true;
    try {
      const { SmokeCloud } = await import('./smoke');
      this.cloud = new SmokeCloud({ ...this.uniforms, contrast: this.contrast }, reducedMotion(), () => this.onChange());
      this.cloud.setPixelRatio(this.pixelRatio);
      this.object.add(this.cloud.object);
      this.cloud.set(this.smoke);
      this.onChange();
    } catch {
      this.isCloudAsked = false;
    }
  }

  animate(seconds: number): boolean {
    const isSmoking = this.cloud?.animate(seconds) ?? false;
    return this.pulses.animate(seconds) || isSmoking;
  }

  setPixelRatio(ratio: number): void {
    this.pixelRatio = ratio;
    this.pulses.setPixelRatio(ratio);
    this.cloud?.setPixelRatio(ratio);
  }
}

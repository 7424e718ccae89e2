// Which cell is seen at a point of the canvas: the cells are drawn once more into one pixel, with their ids as colours.
import { Group, Scene, WebGLRenderTarget, type Object3D, type PerspectiveCamera, type WebGLRenderer } from 'three';
import type { Pass } from './shaders';

/** A cut-cell, or an untouched grid cell by the number of its box; null for anything else. */
export type Picked = { cell: number; box?: undefined } | { box: number; cell?: undefined } | null;

/** Ids from here on are those of boxes. */
export const firstBox = 2 ** 23;

export class Picker {
  readonly root = new Group();
  private readonly scene = new Scene();
  private readonly target = new WebGLRenderTarget(1, 1);
  readonly pass: Pass = { scene: this.scene, target: this.target };
  private readonly pixel = new Uint8Array(4);
  private running: Promise<unknown> = Promise.resolve();

  constructor(
    private readonly renderer: WebGLRenderer,
    objects: Object3D[],
  ) {
    this.root.add(...objects);
    this.scene.add(this.root);
  }

  /** What is seen at this point, in CSS pixels. */
  pick(camera: PerspectiveCamera, x: number, y: number): Promise<Picked> {
    const answer = this.running.then(() => this.read(camera, x, y));
    this.running = answer.catch(() => null);
    return answer;
  }

  private async read(camera: PerspectiveCamera, x: number, y: number): Promise<Picked> {
    // three.js would wait for it for ever.
    if (this.renderer.getContext().isContextLost()) return null;
    const { clientWidth, clientHeight } = this.renderer.domElement;
    camera.setViewOffset(clientWidth, clientHeight, x, y, 1, 1);
    this.draw(this.target, camera);
    camera.clearViewOffset();
    // It fails if the context is lost meanwhile.
    const pixel = await this.renderer.readRenderTargetPixelsAsync(this.target, 0, 0, 1, 1, this.pixel).catch(() => null);
    if (!pixel) return null;
    const [low, middle, high] = this.pixel;
    const id = low + 256 * middle + 65536 * high;
    if (id >= firstBox) return { box: id - firstBox };
    return id === 0 ? null : { cell: id - 1 };
  }

  /** Draws what can be picked, and how far away it is. */
  draw(target: WebGLRenderTarget, camera: PerspectiveCamera): void {
    this.renderer.setRenderTarget(target);
    this.renderer.setClearColor(0, 0);
    this.renderer.clear();
    this.renderer.render(this.scene, camera);
    this.renderer.setRenderTarget(null);
  }
}

// Which cell is seen at a point of the canvas: the cells are drawn once more into one pixel, with their ids as colours.
import { Group, Scene, WebGLRenderTarget, type Object3D, type PerspectiveCamera, type WebGLRenderer } from 'three';

export class Picker {
  readonly root = new Group();
  private readonly scene = new Scene();
  private readonly target = new WebGLRenderTarget(1, 1);
  private readonly pixel = new Uint8Array(4);
  private running: Promise<unknown> = Promise.resolve();

  constructor(
    private readonly renderer: WebGLRenderer,
    objects: Object3D[],
  ) {
    this.root.add(...objects);
    this.scene.add(this.root);
  }

  /** The cut-cell at this point, in CSS pixels; null where there is none. */
  pick(camera: PerspectiveCamera, x: number, y: number): Promise<number | null> {
    const answer = this.running.then(() => this.read(camera, x, y));
    this.running = answer.catch(() => null);
    return answer;
  }

  private async read(camera: PerspectiveCamera, x: number, y: number): Promise<number | null> {
    const { clientWidth, clientHeight } = this.renderer.domElement;
    camera.setViewOffset(clientWidth, clientHeight, x, y, 1, 1);
    this.renderer.setRenderTarget(this.target);
    this.renderer.setClearColor(0, 0);
    this.renderer.clear();
    this.renderer.render(this.scene, camera);
    this.renderer.setRenderTarget(null);
    camera.clearViewOffset();
    const [low, middle, high] = await this.renderer.readRenderTargetPixelsAsync(this.target, 0, 0, 1, 1, this.pixel);
    const id = low + 256 * middle + 65536 * high - 1;
    return id < 0 ? null : id;
  }
}

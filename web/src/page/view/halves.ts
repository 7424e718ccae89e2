import { Group, type Camera, type Object3D, type Scene, type WebGLRenderer } from 'three';
import { OtherWay } from './layers/other_way';
import type { Uniforms } from './material';

/** The cut-cells left of a divider, and another way right of it, in the same scene. */
export class Halves {
  readonly object = new Group();
  readonly otherWay: OtherWay;
  /** 0 to 1 of the picture's width; null where there are but cut-cells. */
  divider: number | null = null;
  private readonly left: Object3D;

  constructor(uniforms: Uniforms, ofModel: readonly Object3D[]) {
    this.otherWay = new OtherWay(uniforms);
    this.left = new Group().add(...ofModel);
    this.object.add(this.left, this.otherWay.object);
  }

  /** Whether the other way is drawn there, so many pixels from the left of a canvas. */
  isOther(x: number, { clientWidth }: HTMLCanvasElement): boolean {
    return this.divider !== null && x > this.divider * clientWidth;
  }

  render(renderer: WebGLRenderer, scene: Scene, camera: Camera): void {
    const { divider, left, otherWay } = this;
    const { clientWidth: width, clientHeight: height } = renderer.domElement;
    const middle = Math.round((divider ?? 1) * width);
    const draw = (isLeft: boolean, from: number, to: number) => {
      if (from === to) return;
      left.visible = isLeft;
      otherWay.object.visible = !isLeft;
      renderer.setScissor(from, 0, to - from, height);
      renderer.render(scene, camera);
    };
    renderer.setScissorTest(divider !== null);
    draw(true, 0, middle);
    draw(false, middle, width);
    renderer.setScissorTest(false);
  }
}

// Ambient occlusion: in a picture that stands, it is darker where little light comes from around. Software renderers would take seconds for
// it, so it is for GPUs that have shown to be quick.
import { Group } from 'three';
import type { Matrix4, PerspectiveCamera, WebGLRenderer } from 'three';
import type { Look } from './layer';
import type { OcclusionPass } from './occlusion_pass';
import type { Picker } from './picking';

/** In ms: a GPU that takes longer for a picture has no time to spare. */
const quick = 40;
/** In ms: how long it takes to appear. */
const fade = 250;
/** Names of what draws without a GPU: where there is little to draw, that is quick, too. */
const software = /swiftshader|llvmpipe|softpipe|software|basic render/i;

export class Occlusion {
  /** To be drawn after the model, and before handles, which it does not darken. */
  readonly object = new Group();
  /** A picture is asked for. */
  onChange = () => {};
  private isLeftOut = false;
  private isSoftware: boolean | null = null;
  private pass: OcclusionPass | null = null;
  /** What it was worked out for, and when. */
  private made: { look: Look; view: Matrix4; at: number } | null = null;

  constructor(
    private readonly renderer: WebGLRenderer,
    private readonly picker: Picker,
    private readonly camera: PerspectiveCamera,
  ) {}

  /** A picture of the model stands, which took so long, in ms. */
  stand(look: Look | null, took: number): void {
    if (!look || !isModelAlone(look) || this.isLeftOut || took > quick || this.isOf(look)) return;
    this.isSoftware ??= software.test(nameOf(this.renderer.getContext()));
    if (this.isSoftware) return;
    if (this.pass) this.make(this.pass, look);
    else void this.load().catch(() => {}); // Without it the picture is as it is.
  }

  private async load(): Promise<void> {
    this.isLeftOut = true;
    const { OcclusionPass } = await import('./occlusion_pass');
    this.pass = new OcclusionPass(this.renderer, this.camera);
    this.object.add(this.pass.object);
    this.isLeftOut = false;
    this.onChange();
  }

  private make(pass: OcclusionPass, look: Look): void {
    pass.make((target) => this.picker.draw(target, this.camera));
    this.made = { look, view: this.view(), at: performance.now() };
    this.onChange();
  }

  private isOf(look: Look | null): boolean {
    return this.made !== null && this.made.look === look && this.made.view.equals(this.view());
  }

  private view(): Matrix4 {
    this.camera.updateMatrixWorld();
    return this.camera.projectionMatrix.clone().multiply(this.camera.matrixWorldInverse);
  }

  /** To be called before each picture: shows what has been worked out for it. Gives whether it is still appearing. */
  animate(look: Look | null): boolean {
    const { pass, made, renderer } = this;
    const strength = pass && made && this.isOf(look) ? Math.min((performance.now() - made.at) / fade, 1) : 0;
    if (pass) pass.strength = strength;
    renderer.domElement.dataset.occlusion = String(strength);
    return strength > 0 && strength < 1;
  }
}

function isModelAlone({ instead, comparison, wind, smoke }: Look): boolean {
  return !instead && !comparison && !wind && !smoke;
}

function nameOf(gl: WebGLRenderingContext | WebGL2RenderingContext): string {
  const names = gl.getExtension('WEBGL_debug_renderer_info');
  return String(gl.getParameter(names ? names.UNMASKED_RENDERER_WEBGL : gl.RENDERER));
}

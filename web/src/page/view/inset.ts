// A small picture in a corner of the large one: where on the model a step of the algorithm is.
import { Color, PerspectiveCamera, Vector3, type Scene, type WebGLRenderer } from 'three';
import { meshPoints } from './extent';
import { fit } from './fit';
import type { Look } from './layer';
import type { Step } from './layers/step';
import type { Uniforms } from './material';

/** What is shown at this share of the model's size, or at more, needs no inset. */
const largest = 0.3;
/** In CSS pixels: its place in the window, below its head, where nothing else lies over the picture; its width at most; its border. */
const place = { left: 14, top: 62, width: 190, border: 2 };
/** From the top of the picture, at least. */
const leastTop = 10;
/** Of the shorter side of the picture. */
const widest = 0.26;
const angle = 30;
const faintness = 0.16;

export class Inset {
  private readonly camera = new PerspectiveCamera(angle, 1, 0.01, 100);

  constructor(
    private readonly renderer: WebGLRenderer,
    private readonly scene: Scene,
    private readonly uniforms: Uniforms,
    private readonly step: Step,
  ) {}

  /** Draws it, if there is a need, seen from where the large picture is. */
  render(look: Look | null, { quaternion, up }: PerspectiveCamera): void {
    const isNeeded = look !== null && needsInset(look);
    const { renderer, scene, uniforms, step, camera } = this;
    const { clientWidth, clientHeight } = renderer.domElement;
    renderer.domElement.dataset.inset = isNeeded ? 'shown' : '';
    if (!isNeeded) return;
    const towards = new Vector3(0, 0, 1).applyQuaternion(quaternion);
    const slope = 0.92 * Math.tan((angle * Math.PI) / 360);
    const { position, target } = fit(meshPoints(look.model), towards, up, [slope, slope]);
    camera.up.copy(up);
    camera.position.copy(position);
    camera.lookAt(target);
    const width = Math.round(Math.min(place.width, widest * Math.min(clientWidth, clientHeight)));
    const top = Math.max(leastTop, place.top - renderer.domElement.getBoundingClientRect().top);
    const bottom = clientHeight - top - width;
    const usual = uniforms.faintness.value;
    renderer.setScissorTest(true);
    this.fill(place.left - place.border, bottom - place.border, width + 2 * place.border);
    renderer.setScissor(place.left, bottom, width, width);
    renderer.setViewport(place.left, bottom, width, width);
    step.seenFromAfar = true;
    uniforms.faintness.value = faintness;
    renderer.render(scene, camera);
    step.seenFromAfar = false;
    uniforms.faintness.value = usual;
    renderer.setViewport(0, 0, clientWidth, clientHeight);
    renderer.setScissorTest(false);
  }

  /** A square in the colour of the border. */
  private fill(left: number, bottom: number, width: number): void {
    const { renderer, uniforms } = this;
    const [color, alpha] = [renderer.getClearColor(new Color()), renderer.getClearAlpha()];
    renderer.setScissor(left, bottom, width, width);
    renderer.setClearColor(uniforms.accent.value, 1);
    renderer.clear();
    renderer.setClearColor(color, alpha);
  }
}

function needsInset({ instead, model: { meshMin, meshMax } }: Look): boolean {
  if (!instead || instead.kind === 'crossings' || !instead.frame) return false;
  return instead.radius < (largest * Math.hypot(...meshMax.map((x, d) => x - meshMin[d]))) / 2;
}

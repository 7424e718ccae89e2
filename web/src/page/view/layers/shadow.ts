// A soft shadow on the ground where the model stands on it or is near to it. The model is drawn once more, seen from below into a small
// picture, which is blurred and lies on the ground; it is drawn again only when the look has changed and then stays so for a moment.
import { Box3, Matrix4, Mesh, NoBlending, OrthographicCamera, PlaneGeometry, Scene, ShaderMaterial, Vector2, Vector3 } from 'three';
import { WebGLRenderTarget, type Object3D, type WebGLRenderer } from 'three';
import { shownPoints } from '../extent';
import type { Layer, Look } from '../layer';
import type { Uniforms } from '../material';
import type { Pass } from '../shaders';
import { wholeTargetShader } from '../whole_target';

/** Pixels along a side of the picture. */
const size = 128;
/** In ms, without a change of the look. */
const rest = 150;
/** Ground around the model, in its sizes, for the blur. */
const margin = 0.3;
/** Of the picture's side: how high above the ground something may be to cast a shadow. */
const highest = 0.35;
/** One standard deviation, in pixels of the picture. */
const blur = 3;

export class Shadow implements Layer {
  readonly object: Mesh<PlaneGeometry, ShaderMaterial>;
  /** The look has changed, and the shadow with it. */
  onChange = () => {};
  private readonly scene = new Scene();
  private readonly camera = new OrthographicCamera();
  private readonly targets = [0, 1].map(() => new WebGLRenderTarget(size, size));
  private readonly blurring = new Mesh(new PlaneGeometry(2, 2), makeBlur());
  readonly passes: readonly Pass[];
  private isStale = false;
  private timer: ReturnType<typeof setTimeout> | undefined;

  constructor(
    private readonly renderer: WebGLRenderer,
    private readonly uniforms: Uniforms,
    casters: readonly Object3D[],
  ) {
    this.scene.add(...casters);
    this.passes = [this.scene, this.blurring].map((scene) => ({ scene, target: this.targets[0] }));
    this.blurring.frustumCulled = false;
    this.object = new Mesh(new PlaneGeometry(1, 1), makeGround(uniforms, this.targets[0]));
    this.object.frustumCulled = false;
  }

  dependsOn({ model, settings: { show, volumes, explode, sliceMode, up }, planes }: Look): readonly unknown[] {
    return [model.id, show, volumes, explode, sliceMode, planes, up];
  }

  setLook(look: Look): void {
    this.place(look);
    this.isStale = true;
    clearTimeout(this.timer);
    this.timer = setTimeout(() => {
      this.timer = undefined;
      this.onChange();
    }, rest);
  }

  /** Puts the ground under the lowest point that is shown, and the camera under that. */
  private place(look: Look): void {
    const up = this.uniforms.up.value;
    const { min, max } = new Box3().setFromArray(shownPoints(look));
    const extent = max.clone().sub(min);
    const side = (1 + 2 * margin) * extent.clone().addScaledVector(up, -extent.dot(up)).length();
    const low = min.dot(up);
    const middle = min.add(max).divideScalar(2);
    middle.addScaledVector(up, low - middle.dot(up));
    const { object, camera } = this;
    object.quaternion.setFromUnitVectors(new Vector3(0, 0, 1), up);
    object.position.copy(middle);
    object.scale.setScalar(side);
    object.updateMatrix();
    const fade = highest * side;
    this.uniforms.ground.value.set(low, fade);
    camera.left = camera.bottom = -side / 2;
    camera.right = camera.top = side / 2;
    camera.near = 0.9 * side;
    camera.far = side + fade;
    camera.position.copy(middle).addScaledVector(up, -side);
    camera.up.set(1, 0, 0);
    camera.lookAt(middle);
    camera.updateProjectionMatrix();
    camera.updateMatrixWorld();
    const toPicture = object.material.uniforms.toPicture.value as Matrix4;
    toPicture.multiplyMatrices(camera.projectionMatrix, camera.matrixWorldInverse).multiply(object.matrix);
  }

  /** Says in a data attribute whether it is drawn as the look has it. */
  tellTests(dataset: DOMStringMap): void {
    dataset.shadow = this.isStale ? 'awaited' : 'drawn';
  }

  /** Whether the next picture draws it anew: the look has stayed as it is for a moment. */
  get isDue(): boolean {
    return this.isStale && this.timer === undefined;
  }

  animate(): boolean {
    if (this.isDue) this.redraw();
    return false;
  }

  /** What was drawn is lost. */
  forget(): void {
    this.isStale = true;
  }

  redraw(): void {
    if (!this.isStale) return;
    this.isStale = false;
    const { renderer, targets, blurring } = this;
    const passes: [Object3D, WebGLRenderTarget, Vector2?][] = [
      [this.scene, targets[0]],
      [blurring, targets[1], new Vector2(1, 0)],
      [blurring, targets[0], new Vector2(0, 1)],
    ];
    renderer.setClearColor(0, 0);
    for (const [object, target, along] of passes) {
      const { picture, step } = blurring.material.uniforms;
      picture.value = (target === targets[0] ? targets[1] : targets[0]).texture;
      if (along) step.value = along.divideScalar(size);
      renderer.setRenderTarget(target);
      renderer.clear();
      renderer.render(object, this.camera);
    }
    renderer.setRenderTarget(null);
  }
}

function makeGround(uniforms: Uniforms, { texture }: WebGLRenderTarget): ShaderMaterial {
  return new ShaderMaterial({
    uniforms: { picture: { value: texture }, toPicture: { value: new Matrix4() }, shade: uniforms.shade },
    transparent: true,
    depthWrite: false,
    vertexShader: /* glsl */ `
      uniform mat4 toPicture;
      varying vec2 at;
      void main() {
        at = 0.5 + 0.5 * (toPicture * vec4(position, 1.0)).xy;
        gl_Position = projectionMatrix * modelViewMatrix * vec4(position, 1.0);
      }`,
    fragmentShader: /* glsl */ `
      uniform sampler2D picture;
      uniform float shade;
      varying vec2 at;
      void main() {
        gl_FragColor = vec4(vec3(0.0), shade * texture2D(picture, at).r);
      }`,
  });
}

/** Blurs along one direction. */
function makeBlur(): ShaderMaterial {
  return new ShaderMaterial({
    uniforms: { picture: { value: null }, step: { value: new Vector2() } },
    depthTest: false,
    depthWrite: false,
    blending: NoBlending,
    vertexShader: wholeTargetShader,
    fragmentShader: /* glsl */ `
      uniform sampler2D picture;
      uniform vec2 step;
      const float deviation = ${blur.toFixed(1)};
      varying vec2 at;
      void main() {
        float sum = 0.0;
        float weights = 0.0;
        for (float k = -6.0; k <= 6.0; k++) {
          float weight = exp(-0.5 * k * k / (deviation * deviation));
          sum += weight * texture2D(picture, at + k * step).r;
          weights += weight;
        }
        gl_FragColor = vec4(sum / weights, 0.0, 0.0, 1.0);
      }`,
  });
}

// Ambient occlusion, worked out from the depths of what is drawn. Apart from what decides when, since only quick GPUs need to load it.
import { CustomBlending, DepthTexture, DstAlphaFactor, DstColorFactor, Mesh, PlaneGeometry, Scene, ShaderMaterial } from 'three';
import { Vector2, WebGLRenderTarget, ZeroFactor, type PerspectiveCamera, type WebGLRenderer } from 'three';
import { GTAOPass } from 'three/examples/jsm/postprocessing/GTAOPass.js';
import { wholeTargetShader } from './whole_target';

/** From how far away things shade each other, in scene units. */
const reach = 0.3;
/** How dark it gets where no light comes from around, 0 to 1. */
const darkest = 0.6;
/** So many pixels are worked out at most; larger pictures get them enlarged. */
const mostPixels = 2.5e6;

export class OcclusionPass {
  /** Darkens what was drawn before it. */
  readonly object = new Mesh(new PlaneGeometry(2, 2), makeDarkening());
  private readonly depths = new WebGLRenderTarget(1, 1, { depthTexture: new DepthTexture(1, 1) });
  private readonly pass: GTAOPass;

  constructor(
    private readonly renderer: WebGLRenderer,
    camera: PerspectiveCamera,
  ) {
    this.pass = new GTAOPass(new Scene(), camera, 1, 1, { depthTexture: this.depths.depthTexture as DepthTexture });
    this.pass.output = GTAOPass.OUTPUT.Off;
    this.pass.updateGtaoMaterial({ radius: reach });
    this.object.frustumCulled = false;
  }

  /** Of what `draw` draws into a render target. */
  make(draw: (target: WebGLRenderTarget) => void): void {
    const { renderer, depths, pass } = this;
    const { x, y } = renderer.getDrawingBufferSize(new Vector2());
    const share = Math.min(1, Math.sqrt(mostPixels / (x * y)));
    const [width, height] = [x, y].map((pixels) => Math.max(1, Math.round(share * pixels)));
    depths.setSize(width, height);
    pass.setSize(width, height);
    draw(depths);
    pass.render(renderer, depths, depths, 0, false);
    renderer.setRenderTarget(null);
  }

  /** 0 to 1, from nothing to all of it. */
  set strength(strength: number) {
    const { uniforms } = this.object.material;
    uniforms.light.value = this.pass.gtaoMap;
    uniforms.strength.value = darkest * strength;
    this.object.visible = strength > 0;
  }
}

/** Multiplies what is there, and leaves transparency as it is. */
function makeDarkening(): ShaderMaterial {
  return new ShaderMaterial({
    uniforms: { light: { value: null }, strength: { value: 1 } },
    depthTest: false,
    depthWrite: false,
    transparent: true,
    blending: CustomBlending,
    blendSrc: DstColorFactor,
    blendDst: ZeroFactor,
    blendSrcAlpha: DstAlphaFactor,
    blendDstAlpha: ZeroFactor,
    vertexShader: wholeTargetShader,
    fragmentShader: /* glsl */ `
      uniform sampler2D light;
      uniform float strength;
      varying vec2 at;
      void main() {
        gl_FragColor = vec4(vec3(mix(1.0, texture2D(light, at).r, strength)), 1.0);
      }`,
  });
}

// Smoke: short strokes behind particles that the flow carries. It is loaded when there is smoke for the first time.
import {
  DynamicDrawUsage,
  Float32BufferAttribute,
  InstancedBufferAttribute,
  InstancedBufferGeometry,
  Vector2,
  Vector3,
  type Color,
  type IUniform,
  type Mesh,
  type ShaderMaterial,
  type WebGLRenderer,
} from 'three';
import type { SmokeSource } from '../../../model/wind';
import { longestLife, particles, pasts, Tracer } from './tracer';
import { makeRibbons, ribbonChunk, windChunk, type WindUniforms } from './uniforms';

/** In seconds: the longest time between two pictures that the smoke moves on by. */
const longestFrame = 0.1;
/** In CSS pixels: that of a picture with all particles. */
const fullArea = 600_000;
/** The still picture is that of a time by which a wake has grown, in longest sides of the mesh over the speed of the wind. */
const stillTime = 2.5;
/** In ms and s: how often the smoke moves on, and how far, on the way to the still picture. */
const stillPoll = 100;
const stillStep = 0.2;

export class SmokeCloud {
  readonly object: Mesh<InstancedBufferGeometry, ShaderMaterial>;
  private source: SmokeSource | null = null;
  private tracer: Tracer | null = null;
  private last: number | null = null;
  private timer: ReturnType<typeof setTimeout> | undefined;
  private readonly own = {
    viewport: { value: new Vector2() },
    pixelRatio: { value: 1 },
    low: { value: new Vector3() },
    high: { value: new Vector3() },
    now: { value: 0 },
    gap: { value: 1 },
    sincePast: { value: 0 },
    newest: { value: 0 },
    life: { value: 1 },
  };

  constructor(
    shared: WindUniforms & { contrast: IUniform<Color> },
    private readonly reducedMotion: MediaQueryList,
    private readonly onChange: () => void,
  ) {
    this.object = makeRibbons(new InstancedBufferGeometry(), { uniforms: { ...shared, ...this.own }, vertexShader, fragmentShader });
    this.object.onBeforeRender = (renderer) => this.fit(renderer);
  }

  /** A small picture has fewer strokes. */
  private fit(renderer: WebGLRenderer): void {
    const { x, y } = renderer.getDrawingBufferSize(this.own.viewport.value);
    const area = (x * y) / this.own.pixelRatio.value ** 2;
    this.object.geometry.instanceCount = Math.min(particles, Math.ceil((particles * area) / fullArea));
  }

  /** Whose smoke is drawn. Without one nothing is kept. */
  set(source: SmokeSource | null): void {
    if (source === this.source) return;
    clearTimeout(this.timer);
    this.source = source;
    this.last = null;
    this.object.geometry.dispose();
    this.object.visible = source !== null;
    this.tracer = source && new Tracer(source.smoke);
    if (!source || !this.tracer) return;
    this.object.geometry = strokes(this.tracer);
    const { corner, side, counts, size } = source.smoke;
    this.own.low.value.fromArray(corner);
    this.own.high.value.fromArray(corner.map((x, d) => x + side * counts[d]));
    this.own.life.value = longestLife * size;
    this.own.gap.value = this.tracer.gap;
    this.take(this.tracer);
    if (this.reducedMotion.matches) this.goToStill();
  }

  /** Gives whether it goes on moving. */
  animate(seconds: number): boolean {
    if (!this.source || this.reducedMotion.matches || !this.isSeen()) {
      this.last = null;
      return false;
    }
    const passed = Math.min(longestFrame, seconds - (this.last ?? seconds));
    this.last = seconds;
    this.advance(passed);
    return true;
  }

  setPixelRatio(ratio: number): void {
    this.own.pixelRatio.value = ratio;
  }

  private isSeen(): boolean {
    return this.object.visible && this.object.parent?.visible === true;
  }

  private advance(seconds: number): void {
    if (!this.source || !this.tracer) return;
    this.tracer.advance(this.source.advance(seconds));
    this.take(this.tracer);
  }

  /** Without pictures on the way. */
  private goToStill(): void {
    const { source, tracer } = this;
    if (!source || !tracer) return;
    if (!document.hidden) this.advance(stillStep);
    if (tracer.now - source.smoke.begin.time >= stillTime * source.smoke.size) return this.onChange();
    this.timer = setTimeout(() => this.goToStill(), stillPoll);
  }

  private take(tracer: Tracer): void {
    const { attributes } = this.object.geometry;
    for (const name of ['head', 'course']) attributes[name].needsUpdate = true;
    for (const slot of tracer.takeWritten()) attributes[`past${slot}`].needsUpdate = true;
    this.own.newest.value = tracer.newest;
    this.own.sincePast.value = tracer.sincePast;
    this.own.now.value = tracer.now;
  }
}

/** A ribbon along where each particle is and was: two corners per place. */
function strokes({ head, course, past }: Tracer): InstancedBufferGeometry {
  const geometry = new InstancedBufferGeometry();
  const corners = Array.from({ length: pasts + 1 }, (_, place) => [place, -1, 0, place, 1, 0]).flat();
  const index = Array.from({ length: pasts }, (_, place) => [0, 1, 2, 2, 1, 3].map((corner) => 2 * place + corner)).flat();
  geometry.setAttribute('position', new Float32BufferAttribute(corners, 3));
  geometry.setIndex(index);
  const perParticle = (name: string, array: Float32Array, size: number) =>
    geometry.setAttribute(name, new InstancedBufferAttribute(array, size).setUsage(DynamicDrawUsage));
  perParticle('head', head, 4);
  perParticle('course', course, 2);
  past.forEach((array, slot) => perParticle(`past${slot}`, array, 3));
  geometry.instanceCount = particles;
  return geometry;
}

const slots = Array.from({ length: pasts }, (_, slot) => `past${slot}`);

const vertexShader = /* glsl */ `
#define PASTS ${pasts}
${ribbonChunk}
uniform float pixelRatio;
uniform vec3 low;
uniform vec3 high;
uniform float size;
uniform float now;
uniform float gap;
uniform float sincePast;
uniform float life;
uniform int newest;
attribute vec4 head;
attribute vec2 course;
${slots.map((slot) => `attribute vec3 ${slot};`).join('\n')}
varying float vSpeed;
varying float vSide;
varying float vOpacity;
varying float vWidth;

/** Where the particle is (0), and where it was. */
vec3 placeAt(int place, vec3 pasts[PASTS]) {
  float age = (now - course.x) / gap - sincePast;
  int known = min(place - 1, int(floor(age)));
  if (known < 0 || age < 0.0) return head.xyz;
  vec3 was = pasts[(newest - known + PASTS) % PASTS];
  // The last one follows between two, so that the end of the stroke moves as its beginning does.
  if (known == PASTS - 1) return mix(was, pasts[(newest + 2) % PASTS], clamp(sincePast, 0.0, 1.0));
  return was;
}

void main() {
  vec3 pasts[PASTS] = vec3[PASTS](${slots.join(', ')});
  int place = int(position.x);
  vec3 point = placeAt(place, pasts);
  vec3 along = placeAt(max(0, place - 1), pasts) - placeAt(min(PASTS, place + 1), pasts);
  vSpeed = head.w;
  vSide = position.y;
  // Strokes come out of nothing and end in nothing.
  vec3 inward = min(point - low, high - point) / (0.3 * size);
  float age = (now - course.x) / life;
  vOpacity = smoothstep(0.0, 1.0, min(inward.x, min(inward.y, inward.z))) * smoothstep(0.0, 0.02, age) * smoothstep(1.0, 0.9, age);
  // What is disturbed is seen through what is not, and the wake through what goes around it.
  vOpacity *= mix(0.2, 1.0, smoothstep(0.06, 0.5, course.y)) * mix(1.0, 0.6, smoothstep(0.9, 1.3, vSpeed));
  float behind = float(place) / float(PASTS);
  vOpacity *= (1.0 - behind) * (1.0 - behind);
  // A pixel more on each side, in which the edge is smoothed.
  vWidth = 0.9 * pixelRatio * (1.0 - 0.6 * behind);
  gl_Position = besideLine(point, along, vSide * (vWidth + 1.0));
}
`;

const fragmentShader = /* glsl */ `
${windChunk}
uniform vec3 contrast;
varying float vSpeed;
varying float vSide;
varying float vOpacity;
varying float vWidth;

void main() {
  // What is narrower than a pixel covers a part of it.
  float edge = clamp(vWidth + 0.5 - abs(vSide) * (vWidth + 1.0), 0.0, 1.0) * min(1.0, 2.0 * vWidth);
  float opacity = 0.85 * edge * vOpacity;
  if (opacity < 0.01) discard;
  gl_FragColor = vec4(mix(contrast, speedColor(vSpeed), mix(0.6, 0.95, smoothstep(0.2, 1.0, vSpeed))), opacity);
  #include <colorspace_fragment>
}
`;

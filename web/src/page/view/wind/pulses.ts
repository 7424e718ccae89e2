// Pulses that run along the streamlines. Each point of a line knows when what starts with the wind arrives there; one uniform, the time, moves
// all of them.
import { type BufferGeometry, Group, type Mesh, type ShaderMaterial, Vector2 } from 'three';
import type { Wind } from '../../../model/wind';
import { emptyGeometry, refill } from '../buffers';
import { makeRibbons, ribbonChunk, windChunk, type WindUniforms } from './uniforms';

/** Time in which the undisturbed wind covers the longest side of the mesh, in seconds. */
const crossingTime = 1.5;
/** Distance of pulses in the undisturbed wind, in longest sides of the mesh. */
const pulseGap = 0.7;
/** Of neighbouring lines, the pulses come as evenly as can be at different times. */
const goldenRatio = 0.618034;

export class Pulses {
  readonly object = new Group();
  private readonly ribbons: Mesh<BufferGeometry, ShaderMaterial>;
  private readonly own = {
    time: { value: 0 },
    isStill: { value: false },
    viewport: { value: new Vector2() },
    pixelRatio: { value: 1 },
    pulseGap: { value: pulseGap },
  };

  constructor(
    shared: WindUniforms,
    private readonly reducedMotion: MediaQueryList,
  ) {
    this.ribbons = makeRibbons(emptyGeometry(), { uniforms: { ...shared, ...this.own }, vertexShader, fragmentShader });
    this.ribbons.onBeforeRender = (renderer) => void renderer.getDrawingBufferSize(this.own.viewport.value);
    this.object.add(this.ribbons);
  }

  set({ lines }: Wind): void {
    const { index, ...attributes } = ribbonArrays(lines);
    refill(this.ribbons.geometry, attributes, index);
  }

  animate(seconds: number): boolean {
    const { isStill, time } = this.own;
    isStill.value = this.reducedMotion.matches;
    time.value = (seconds / (crossingTime * pulseGap)) % 1;
    return !isStill.value && this.object.visible && this.object.parent?.visible === true;
  }

  setPixelRatio(ratio: number): void {
    this.own.pixelRatio.value = ratio;
  }
}

/** Two vertices per point, one for each side of the ribbon. */
function ribbonArrays({ position, speed, arrival, offsets }: Wind['lines']) {
  const count = 2 * speed.length;
  const place = new Float32Array(3 * count);
  const ahead = new Float32Array(3 * count);
  const course = new Float32Array(3 * count);
  const index = new Uint32Array(6 * Math.max(0, speed.length - (offsets.length - 1)));
  let end = 0;
  for (let line = 0; line + 1 < offsets.length; line++) {
    const [first, last] = [offsets[line], offsets[line + 1] - 1];
    for (let at = first; at <= last; at++) {
      const [before, after] = [Math.max(first, at - 1), Math.min(last, at + 1)];
      for (const vertex of [2 * at, 2 * at + 1]) {
        for (let d = 0; d < 3; d++) {
          place[3 * vertex + d] = position[3 * at + d];
          ahead[3 * vertex + d] = position[3 * after + d] - position[3 * before + d];
        }
        course[3 * vertex] = arrival[at];
        course[3 * vertex + 1] = speed[at];
        course[3 * vertex + 2] = (line * goldenRatio) % 1;
      }
      if (at === last) continue;
      index.set([2 * at, 2 * at + 1, 2 * at + 2, 2 * at + 2, 2 * at + 1, 2 * at + 3], end);
      end += 6;
    }
  }
  return {
    position: { array: place, size: 3 },
    ahead: { array: ahead, size: 3 },
    course: { array: course, size: 3 },
    index: index.subarray(0, end),
  };
}

const varyings = /* glsl */ `
varying vec3 vPoint;
varying float vArrival;
varying float vSpeed;
varying float vPhase;
varying float vSide;
varying float vFade;
varying float vWidth;
`;

const vertexShader = /* glsl */ `
${ribbonChunk}
uniform float pixelRatio;
uniform vec3 reach;
uniform float size;
attribute vec3 ahead;
attribute vec3 course;
${varyings}
void main() {
  vPoint = position;
  vArrival = course.x;
  vSpeed = course.y;
  vPhase = course.z;
  vSide = (gl_VertexID & 1) == 0 ? -1.0 : 1.0;
  // Lines come out of nothing and end in nothing, not at the sides of the tunnel.
  vec3 inward = (reach - abs(position)) / (0.35 * size);
  vFade = smoothstep(0.0, 1.0, min(inward.x, min(inward.y, inward.z)));
  // A pixel more on each side, in which the edge is smoothed.
  vWidth = 0.85 * pixelRatio;
  gl_Position = besideLine(position, ahead * 0.1, vSide * (vWidth + 1.0));
}
`;

const fragmentShader = /* glsl */ `
${windChunk}
uniform float size;
uniform float pulseGap;
uniform float time;
uniform bool isStill;
${varyings}
void main() {
  // In front of a section only what is close to it.
  float beyond = beyondSections(vPoint, -1);
  float near = 1.0 - smoothstep(0.0, 0.12 * size, beyond);
  bool isOverSection = beyond > 0.0;
  // How long ago the latest pulse was here, as a share of the time between two.
  float since = fract(time - vArrival / (pulseGap * size) + vPhase);
  float pulse = isStill ? 0.45 : pow(max(0.0, 1.0 - since / 0.8), 1.6) * smoothstep(0.0, 0.03, since);
  float aside = abs(vSide) * (vWidth + 1.0);
  float edge = clamp(vWidth * (0.45 + 0.55 * pulse) + 0.5 - aside, 0.0, 1.0);
  float opacity = edge * vFade * near * (0.1 + 0.9 * pulse);
  if (opacity < 0.01) discard;
  // A section has the same colours as the pulses in front of it.
  gl_FragColor = vec4(mix(speedColor(vSpeed), vec3(1.0), isOverSection ? 0.75 : 0.0), opacity);
  #include <colorspace_fragment>
}
`;

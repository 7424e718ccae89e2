// Where the surface meets itself: glowing lines in front of the faint surface, however deep inside of it they are.
import { Group, InstancedBufferGeometry, InstancedInterleavedBuffer, InterleavedBufferAttribute, Mesh } from 'three';
import { Float32BufferAttribute, LessDepth, ShaderMaterial, Vector2, type WebGLRenderer } from 'three';
import type { Crossings } from '../../../model/types';
import type { Layer, Look } from '../layer';
import type { Uniforms } from '../material';

/** The line, and the light around it: widths in pixels. */
const strokes = [
  { width: 2.5, opacity: 1 },
  { width: 8, opacity: 0.4 },
  { width: 18, opacity: 0.18 },
];

export class CrossingCurves implements Layer {
  readonly object = new Group();
  private readonly viewport = { value: new Vector2() };
  private geometry = geometryOf(new Float32Array(0));

  constructor(uniforms: Uniforms) {
    for (const [depth, stroke] of strokes.entries()) {
      const mesh = new Mesh(this.geometry, this.material(uniforms, stroke, depth));
      mesh.frustumCulled = false;
      mesh.onBeforeRender = (renderer) => (renderer as WebGLRenderer).getSize(this.viewport.value);
      this.object.add(mesh);
    }
  }

  private material({ accent }: Uniforms, { width, opacity }: (typeof strokes)[number], depth: number): ShaderMaterial {
    return new ShaderMaterial({
      uniforms: { accent, viewport: this.viewport, width: { value: width }, opacity: { value: opacity }, depth: { value: depth } },
      vertexShader,
      fragmentShader,
      transparent: true,
      depthFunc: LessDepth, // where segments of a stroke overlap, only one of them is drawn
    });
  }

  dependsOn({ instead }: Look): readonly unknown[] {
    return [instead];
  }

  setLook({ instead }: Look): void {
    const crossings = instead?.kind === 'crossings' ? instead : null;
    this.object.visible = crossings !== null;
    this.geometry.dispose();
    this.geometry = geometryOf(crossings?.segments ?? new Float32Array(0));
    for (const mesh of this.object.children) (mesh as Mesh).geometry = this.geometry;
  }
}

/** A quad per segment. */
function geometryOf(segments: Crossings['segments']): InstancedBufferGeometry {
  const geometry = new InstancedBufferGeometry();
  geometry.setAttribute('position', new Float32BufferAttribute([0, -1, 0, 1, -1, 0, 1, 1, 0, 0, 1, 0], 3));
  geometry.setIndex([0, 1, 2, 0, 2, 3]);
  const ends = new InstancedInterleavedBuffer(segments, 6);
  geometry.setAttribute('from', new InterleavedBufferAttribute(ends, 3, 0));
  geometry.setAttribute('to', new InterleavedBufferAttribute(ends, 3, 3));
  geometry.instanceCount = segments.length / 6;
  return geometry;
}

const vertexShader = /* glsl */ `
uniform vec2 viewport;
uniform float width;
uniform float depth;
attribute vec3 from;
attribute vec3 to;
varying vec2 vAt;
flat varying vec2 vFrom;
flat varying vec2 vTo;

/** In pixels from the middle of the picture. */
vec2 onScreen(vec4 seen) {
  vec4 projected = projectionMatrix * seen;
  return 0.5 * viewport * projected.xy / projected.w;
}

void main() {
  vec4 a = modelViewMatrix * vec4(from, 1.0);
  vec4 b = modelViewMatrix * vec4(to, 1.0);
  float near = projectionMatrix[3][2] / (projectionMatrix[2][2] - 1.0);
  bool isBehind = a.z > -near && b.z > -near;
  // What lies behind the eye has no place on the screen.
  if (a.z > -near) a = mix(a, b, (a.z + near) / (a.z - b.z));
  else if (b.z > -near) b = mix(b, a, (b.z + near) / (b.z - a.z));
  vFrom = onScreen(a);
  vTo = onScreen(b);
  vec2 way = vTo - vFrom;
  vec2 along = length(way) > 1e-3 ? normalize(way) : vec2(1.0, 0.0);
  vec2 across = vec2(-along.y, along.x);
  vAt = mix(vFrom, vTo, position.x) + 0.5 * width * ((2.0 * position.x - 1.0) * along + position.y * across);
  // In front of everything else, the narrowest stroke first; beyond the far plane, nothing is drawn.
  gl_Position = isBehind ? vec4(0.0, 0.0, 2.0, 1.0) : vec4(2.0 * vAt / viewport, 0.001 * depth - 0.999, 1.0);
}
`;

const fragmentShader = /* glsl */ `
uniform vec3 accent;
uniform float width;
uniform float opacity;
varying vec2 vAt;
flat varying vec2 vFrom;
flat varying vec2 vTo;

void main() {
  vec2 way = vTo - vFrom;
  float share = clamp(dot(vAt - vFrom, way) / max(dot(way, way), 1e-6), 0.0, 1.0);
  if (distance(vAt, vFrom + share * way) > 0.5 * width) discard;
  gl_FragColor = vec4(accent, opacity);
  #include <colorspace_fragment>
}
`;

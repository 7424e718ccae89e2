// Lines of some width in pixels, in front of everything else, however deep inside the model they are.
import { Group, InstancedBufferGeometry, InstancedInterleavedBuffer, InterleavedBufferAttribute, Mesh } from 'three';
import { Float32BufferAttribute, LessDepth, ShaderMaterial, Vector2, Vector4, type Color, type IUniform, type WebGLRenderer } from 'three';

interface Stroke {
  color: IUniform<Color>;
  /** In pixels. */
  width: number;
  opacity: number;
  /** Of two strokes the one with less is in front. */
  depth: number;
}

/** The same segments with several strokes. */
export class Strokes {
  readonly object = new Group();
  private readonly viewport = { value: new Vector2() };
  private geometry = geometryOf(new Float32Array(0));

  constructor(strokes: readonly Stroke[]) {
    for (const stroke of strokes) {
      const mesh = new Mesh(this.geometry, this.material(stroke));
      mesh.frustumCulled = false;
      mesh.onBeforeRender = (renderer) => {
        const { z, w } = (renderer as WebGLRenderer).getCurrentViewport(new Vector4());
        this.viewport.value.set(z, w).divideScalar((renderer as WebGLRenderer).getPixelRatio());
      };
      this.object.add(mesh);
    }
  }

  private material({ color, width, opacity, depth }: Stroke): ShaderMaterial {
    return new ShaderMaterial({
      uniforms: { color, viewport: this.viewport, width: { value: width }, opacity: { value: opacity }, depth: { value: depth } },
      vertexShader,
      fragmentShader,
      transparent: true,
      depthFunc: LessDepth, // where segments of a stroke overlap, only one of them is drawn
    });
  }

  /** 2 points per segment; a point is a segment of no length. */
  set segments(segments: Float32Array) {
    this.geometry.dispose();
    this.geometry = geometryOf(segments);
    for (const mesh of this.object.children) (mesh as Mesh).geometry = this.geometry;
  }
}

/** A quad per segment. */
function geometryOf(segments: Float32Array): InstancedBufferGeometry {
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
uniform vec3 color;
uniform float width;
uniform float opacity;
varying vec2 vAt;
flat varying vec2 vFrom;
flat varying vec2 vTo;

void main() {
  vec2 way = vTo - vFrom;
  float share = clamp(dot(vAt - vFrom, way) / max(dot(way, way), 1e-6), 0.0, 1.0);
  if (distance(vAt, vFrom + share * way) > 0.5 * width) discard;
  gl_FragColor = vec4(color, opacity);
  #include <colorspace_fragment>
}
`;

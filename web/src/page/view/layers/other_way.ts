// What is inside in another way than cut-cells: one closed surface. It has no cells that could stay whole, so that planes cut it flat.
import { BackSide, FrontSide, Group, Mesh, ShaderMaterial, Vector3 } from 'three';
import { emptyGeometry, refill } from '../buffers';
import { insideColor, surfaceColor, type Rgb } from '../colors';
import type { Layer, Look } from '../layer';
import { lightChunk } from '../light';
import type { Uniforms } from '../material';

const edgeStrength = 0.8;

export class OtherWay implements Layer {
  readonly object = new Group();
  /** Made, and their shaders compiled, when there is something to draw. */
  private faces: Mesh | null = null;
  /** The grid, whose planes divide the surface. */
  private readonly grid = { gridLow: { value: new Vector3() }, gridStep: { value: new Vector3() }, edgeStrength: { value: 0 } };

  constructor(private readonly uniforms: Uniforms) {}

  dependsOn({ comparison, model, settings: { compare, show } }: Look): readonly unknown[] {
    return [comparison, model.id, compare.way, show];
  }

  setLook({ comparison, model, settings: { compare, show } }: Look): void {
    const surface = compare.way === 'none' ? null : comparison?.ways[compare.way];
    if (!comparison || !surface) return;
    const { position, index, grid } = surface;
    this.faces ??= this.makeFaces();
    refill(this.faces.geometry, { position: { array: position, size: 3 } }, index);
    this.object.position.fromArray(comparison.origin.map((x, d) => x - model.origin[d]));
    const { gridLow, gridStep, edgeStrength: strength } = this.grid;
    if (grid) {
      gridLow.value.fromArray([...grid.low]);
      gridStep.value.fromArray([...grid.step]);
    }
    strength.value = show.edges && grid ? edgeStrength : 0;
    for (const part of this.object.children) part.visible = show.surface;
  }

  private makeFaces(): Mesh {
    const faces = new Mesh(emptyGeometry(), this.material(surfaceColor, false));
    this.object.add(faces, new Mesh(faces.geometry, this.material(insideColor, true)));
    for (const part of this.object.children) part.frustumCulled = false;
    return faces;
  }

  private material(color: Rgb, isBack: boolean): ShaderMaterial {
    return new ShaderMaterial({
      uniforms: { ...this.uniforms, ...this.grid, color: { value: new Vector3(...color).divideScalar(255) } },
      defines: isBack ? { BACKS: 1 } : {},
      vertexShader,
      fragmentShader,
      side: isBack ? BackSide : FrontSide,
      // The front of a face before its neighbour's back.
      polygonOffset: true,
      polygonOffsetFactor: isBack ? 1.5 : 1,
      polygonOffsetUnits: isBack ? 3 : 2,
    });
  }
}

const vertexShader = /* glsl */ `
uniform float explodeCells;
varying vec3 vRest;
varying vec3 vView;
varying vec3 vEye;

void main() {
  vRest = position;
  // It grows as far as the centres of cells move apart.
  vec4 seen = modelViewMatrix * vec4((1.0 + explodeCells) * position, 1.0);
  vView = seen.xyz;
  vEye = (inverse(modelViewMatrix) * vec4(0.0, 0.0, 0.0, 1.0)).xyz / (1.0 + explodeCells);
  gl_Position = projectionMatrix * seen;
}
`;

const fragmentShader = /* glsl */ `
${lightChunk}
uniform vec4 planes[4];
uniform int planeCount;
uniform vec3 color;
uniform vec3 lineColor;
uniform vec3 gridLow;
uniform vec3 gridStep;
uniform float edgeStrength;
varying vec3 vRest;
varying vec3 vEye;

/** How much of a point is covered by lines in axial planes. They fade where they are dense. */
float lineAt(vec3 point) {
  vec3 cells = (point - gridLow) / gridStep;
  vec3 pixel = fwidth(cells);
  vec3 pixelsOff = abs(fract(cells + 0.5) - 0.5) / max(pixel, 1e-6);
  // A face that lies in a plane isn't one of its lines.
  vec3 covered = (1.0 - smoothstep(0.3, 1.0, pixelsOff)) * (1.0 - smoothstep(0.15, 0.5, pixel)) * step(1e-4, pixel);
  return edgeStrength * max(covered.x, max(covered.y, covered.z));
}

void main() {
  for (int p = 0; p < planeCount; p++) if (dot(planes[p].xyz, vRest) > planes[p].w) discard;
  vec3 point = vRest;
  vec3 n = normalize(cross(dFdx(vView), dFdy(vView)));
  if (dot(n, vView) > 0.0) n = -n;
  #ifdef BACKS
    // Backs of a closed surface are seen where planes cut it open: they look like what fills it there, in the plane that is met last.
    float way = 0.0;
    for (int p = 0; p < planeCount; p++) {
      float above = dot(planes[p].xyz, vEye) - planes[p].w;
      float met = above / (above + planes[p].w - dot(planes[p].xyz, vRest));
      if (above <= 0.0 || met <= way) continue;
      way = met;
      n = mat3(viewMatrix) * planes[p].xyz;
      point = mix(vEye, vRest, met);
    }
  #endif
  gl_FragColor = vec4(mix(linear(color) * light(n), lineColor, lineAt(point)), 1.0);
  #include <colorspace_fragment>
}
`;

// The surface, and sections through the cells, in the colours of speeds or pressures. Drawn instead of the model.
import { DoubleSide, FrontSide, Group, LineSegments, Mesh, ShaderMaterial, type IUniform } from 'three';
import type { Shape, Wind } from '../../../model/wind';
import { emptyGeometry, refill } from '../buffers';
import type { Uniforms } from '../material';
import { windChunk, windLightChunk, type WindUniforms } from './uniforms';

interface Section {
  faces: Mesh;
  edges: LineSegments;
}

export class WindSurface {
  readonly object = new Group();
  private readonly faces: Mesh;
  private readonly sections: Section[];
  private shape: Shape | null = null;

  constructor(shared: WindUniforms, { lineColor }: Uniforms) {
    const material = (purpose: 'SURFACE' | 'SECTION' | 'EDGES', own: Record<string, IUniform>) =>
      new ShaderMaterial({
        uniforms: { ...shared, ...own },
        defines: { [purpose]: 1 },
        vertexShader,
        fragmentShader,
        side: purpose === 'SURFACE' ? FrontSide : DoubleSide,
        transparent: purpose === 'EDGES',
        polygonOffset: purpose !== 'EDGES',
        polygonOffsetFactor: 1,
        polygonOffsetUnits: 1,
      });
    this.faces = new Mesh(emptyGeometry(), material('SURFACE', { own: { value: -1 } }));
    this.sections = [0, 1, 2, 3].map((s) => ({
      faces: new Mesh(emptyGeometry(), material('SECTION', { own: { value: s } })),
      edges: new LineSegments(emptyGeometry(), material('EDGES', { own: { value: s }, lineColor })),
    }));
    this.object.add(this.faces, ...this.sections.flatMap(({ faces, edges }) => [faces, edges]));
    for (const object of this.object.children) object.frustumCulled = false;
  }

  set({ surface, sections }: Wind): void {
    this.setSurface(surface);
    this.sections.forEach(({ faces, edges }, s) => {
      const section = sections[s];
      faces.visible = edges.visible = s < sections.length;
      if (!section) return;
      const { shape, speed } = section;
      refill(faces.geometry, { position: { array: shape.position, size: 3 }, speed: { array: speed, size: 1 } }, shape.index);
      refill(edges.geometry, { position: { array: section.edges, size: 3 } });
    });
  }

  /** Another wind about the same surface changes only its speeds. */
  private setSurface(surface: Wind['surface']): void {
    this.faces.visible = surface?.shape != null;
    if (!surface?.shape) return;
    const { shape, speed } = surface;
    const { geometry } = this.faces;
    const speeds = { speed: { array: speed, size: 1 } };
    if (shape === this.shape) refill(geometry, speeds, shape.index);
    else refill(geometry, { position: { array: shape.position, size: 3 }, ...speeds }, shape.index);
    this.shape = shape;
  }
}

const vertexShader = /* glsl */ `
attribute float speed;
varying vec3 vPoint;
varying vec3 vView;
varying float vSpeed;

void main() {
  vPoint = position;
  vSpeed = speed;
  vec4 seen = modelViewMatrix * vec4(position, 1.0);
  vView = seen.xyz;
  gl_Position = projectionMatrix * seen;
}
`;

const fragmentShader = /* glsl */ `
${windChunk}
${windLightChunk}
uniform int own;
uniform vec3 lineColor;
varying vec3 vPoint;
varying float vSpeed;

void main() {
  if (beyondSections(vPoint, own) > 0.0) discard;
  #ifdef EDGES
    gl_FragColor = vec4(lineColor, 0.22);
  #else
    // Nothing flows in a body.
    vec3 color = vSpeed < 0.0 ? vec3(0.42) : speedColor(vSpeed);
    #ifdef SURFACE
      color *= light();
    #endif
    gl_FragColor = vec4(color, 1.0);
  #endif
  #include <colorspace_fragment>
}
`;

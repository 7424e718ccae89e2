// One cell on its own, which can be rotated. Draws only when something has changed.
import {
  BufferAttribute,
  BufferGeometry,
  Color,
  DirectionalLight,
  DoubleSide,
  HemisphereLight,
  LineBasicMaterial,
  LineSegments,
  Mesh,
  MeshLambertMaterial,
  PerspectiveCamera,
  Scene,
  SRGBColorSpace,
  WebGLRenderer,
} from 'three';
import { OrbitControls } from 'three/addons/controls/OrbitControls.js';
import type { CellCard } from '../../model/cut_model';
import { gridFaceColor, surfaceColor, type Rgb } from '../view/colors';

const linear = ([red, green, blue]: Rgb) => new Color().setRGB(red / 255, green / 255, blue / 255, SRGBColorSpace);
const surfaceKind = linear(surfaceColor);
const gridFaceKind = linear(gridFaceColor);

export class CellViewer {
  private readonly renderer: WebGLRenderer;
  private readonly scene = new Scene();
  private readonly camera = new PerspectiveCamera(35, 1, 0.01, 100);
  private readonly controls: OrbitControls;
  private readonly faces = new Mesh(
    new BufferGeometry(),
    new MeshLambertMaterial({ vertexColors: true, side: DoubleSide, polygonOffset: true, polygonOffsetFactor: 1, polygonOffsetUnits: 1 }),
  );
  private readonly edges = new LineSegments(new BufferGeometry(), new LineBasicMaterial({ color: '#2b2622' }));
  private frameAsked = false;

  constructor(private readonly canvas: HTMLCanvasElement) {
    this.renderer = new WebGLRenderer({ canvas, antialias: true, alpha: true });
    this.renderer.setPixelRatio(Math.min(devicePixelRatio, 2));
    const light = new DirectionalLight('#ffffff', 2);
    light.position.set(0.4, 0.8, 1);
    this.camera.add(light);
    this.scene.add(this.camera, new HemisphereLight('#ffffff', '#8d8780', 1.6), this.faces, this.edges);
    this.controls = new OrbitControls(this.camera, canvas);
    this.controls.enablePan = false;
    this.controls.addEventListener('change', () => this.draw());
    new ResizeObserver(() => this.resize()).observe(canvas);
  }

  show({ triangles, edges }: CellCard): void {
    const { center, radius } = enclosing(triangles.position);
    const position = moved(triangles.position, center, radius);
    replace(this.faces, { position, normal: triangles.normal, color: colors(triangles.surface) });
    replace(this.edges, { position: moved(edges, center, radius) });
    this.camera.position.set(1.65, 1.3, 2.5);
    this.controls.target.set(0, 0, 0);
    this.controls.update();
    this.draw();
  }

  /** Rotates the cell by angles in radians, for the keyboard. */
  turn(around: number, over: number): void {
    const offset = this.camera.position.clone();
    const length = offset.length();
    const polar = Math.min(Math.max(Math.acos(offset.y / length) + over, 0.01), Math.PI - 0.01);
    const azimuth = Math.atan2(offset.x, offset.z) + around;
    this.camera.position.setFromSphericalCoords(length, polar, azimuth);
    this.controls.update();
  }

  private resize(): void {
    const { clientWidth: width, clientHeight: height } = this.canvas;
    if (width === 0 || height === 0) return;
    this.renderer.setSize(width, height, false);
    this.camera.aspect = width / height;
    this.camera.updateProjectionMatrix();
    this.draw();
  }

  private draw(): void {
    if (this.frameAsked) return;
    this.frameAsked = true;
    requestAnimationFrame(() => {
      this.frameAsked = false;
      this.renderer.render(this.scene, this.camera);
    });
  }
}

function replace(object: Mesh | LineSegments, attributes: Record<string, Float32Array>): void {
  object.geometry.dispose();
  object.geometry = new BufferGeometry();
  for (const [name, array] of Object.entries(attributes)) object.geometry.setAttribute(name, new BufferAttribute(array, 3));
}

function enclosing(position: Float32Array): { center: number[]; radius: number } {
  const min = [Infinity, Infinity, Infinity];
  const max = [-Infinity, -Infinity, -Infinity];
  position.forEach((x, i) => {
    min[i % 3] = Math.min(min[i % 3], x);
    max[i % 3] = Math.max(max[i % 3], x);
  });
  const center = min.map((x, d) => (x + max[d]) / 2);
  const radius = Math.hypot(...min.map((x, d) => (max[d] - x) / 2));
  return { center, radius: radius > 0 ? radius : 1 };
}

/** Moved and scaled into the unit ball. */
function moved(position: Float32Array, center: number[], radius: number): Float32Array {
  return position.map((x, i) => (x - center[i % 3]) / radius);
}

function colors(surface: Uint8Array): Float32Array {
  const result = new Float32Array(3 * surface.length);
  surface.forEach((isSurface, i) => (isSurface ? surfaceKind : gridFaceKind).toArray(result, 3 * i));
  return result;
}

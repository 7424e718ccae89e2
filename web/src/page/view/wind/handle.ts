// An arrow that blows at the mesh. It is turned around it by dragging.
import { ConeGeometry, CylinderGeometry, Group, Mesh, Raycaster, ShaderMaterial, Sphere, Vector2, Vector3 } from 'three';
import type { Color, PerspectiveCamera } from 'three';
import type { Vector3 as Numbers } from '../../../model/vector';
import type { Look } from '../layer';
import { windLightChunk } from './uniforms';

/** How near a pointer has to be, in CSS pixels. */
const touchDistance = 30;
/** From the middle of the mesh to the tip, in longest sides of the mesh. */
const distance = 0.82;
/** Of the arrow, in longest sides. */
const length = 0.2;
/** Where the arrow begins and ends, from the middle of the mesh against the wind, in longest sides. */
export const arrowEnds = [distance, distance + length];
const up = new Vector3(0, 1, 0);

export class WindHandle {
  readonly object = new Group();
  onChange = () => {};
  onTurned: (direction: Numbers) => void = () => {};
  /** A drag begins or ends. */
  onDragging: (isDragging: boolean) => void = () => {};
  private readonly arrow = new Group();
  /** 1 while it is touched. */
  private readonly glow = { value: 0 };
  private readonly direction = new Vector3(1, 0, 0);
  private wind: { size: number } | null = null;
  private dragged: number | null = null;
  private isNear = false;
  /** Of the sphere that the arrow is turned on: whether it is grabbed on the side that faces the camera. */
  private isInFront = true;

  constructor(
    private readonly camera: PerspectiveCamera,
    private readonly canvas: HTMLCanvasElement,
    color: { value: Color },
  ) {
    const material = new ShaderMaterial({ uniforms: { color, glow: this.glow }, vertexShader, fragmentShader });
    const head = new Mesh(new ConeGeometry(0.2, 0.5, 40), material);
    const shaft = new Mesh(new CylinderGeometry(0.07, 0.07, 0.5, 24), material);
    head.position.y = -0.25;
    shaft.position.y = -0.75;
    this.arrow.add(head, shaft);
    this.object.add(this.arrow);
    // Before the camera's controls, which would turn the picture.
    canvas.addEventListener('pointerdown', (event) => this.down(event), { capture: true });
    canvas.addEventListener('pointermove', (event) => this.move(event));
    for (const end of ['pointerup', 'pointercancel'] as const) canvas.addEventListener(end, (event) => this.up(event));
  }

  /** Whether the pointer is on it. */
  get isTouched(): boolean {
    return this.dragged !== null || this.isNear;
  }

  setLook({ wind, smoke, settings }: Look): void {
    // The opening's wind can't be turned.
    this.wind = settings.wind.on ? (smoke?.smoke ?? wind) : null;
    this.arrow.visible = this.wind !== null;
    if (!this.wind) this.isNear = false;
    const [x, y, z] = settings.wind.direction;
    this.direction.set(x, y, z);
    this.place();
  }

  private place(): void {
    if (!this.wind) return;
    const { size } = this.wind;
    this.arrow.scale.setScalar(length * size);
    this.arrow.position.copy(this.direction).multiplyScalar(-distance * size);
    this.arrow.quaternion.setFromUnitVectors(up, this.direction);
    this.glow.value = Number(this.isTouched);
  }

  private down(event: PointerEvent): void {
    if (!event.isPrimary || event.button !== 0 || !this.isAt(event)) return;
    event.stopImmediatePropagation();
    this.dragged = event.pointerId;
    this.canvas.setPointerCapture(event.pointerId);
    const toCamera = this.camera.position.clone().sub(this.middle());
    this.isInFront = this.direction.dot(toCamera) < 0;
    this.onDragging(true);
  }

  private move(event: PointerEvent): void {
    if (this.dragged === event.pointerId) this.turn(event);
    else if (event.pointerType !== 'touch' && event.buttons === 0) this.setNear(this.isAt(event));
  }

  private up(event: PointerEvent): void {
    if (this.dragged !== event.pointerId) return;
    this.dragged = null;
    this.onDragging(false);
    // Nothing stays where a finger was.
    this.setNear(event.pointerType !== 'touch' && this.isAt(event));
  }

  private setNear(isNear: boolean): void {
    if (isNear === this.isNear) return;
    this.isNear = isNear;
    this.place();
    this.onChange();
  }

  private isAt(event: PointerEvent): boolean {
    if (!this.wind || this.object.parent?.visible !== true) return false;
    const { left, top } = this.canvas.getBoundingClientRect();
    const [x, y] = this.placeInPicture();
    return Math.hypot(event.clientX - left - x, event.clientY - top - y) < touchDistance;
  }

  /** In CSS pixels of the canvas. */
  placeInPicture(): [x: number, y: number] {
    this.camera.updateMatrixWorld();
    const at = this.arrow.localToWorld(new Vector3(0, -0.5, 0)).project(this.camera);
    return [((at.x + 1) / 2) * this.canvas.clientWidth, ((1 - at.y) / 2) * this.canvas.clientHeight];
  }

  private middle(): Vector3 {
    return this.object.getWorldPosition(new Vector3());
  }

  /** To where the pointer meets the sphere around the mesh, or comes nearest to it. */
  private turn(event: PointerEvent): void {
    if (!this.wind) return;
    const { left, top, width, height } = this.canvas.getBoundingClientRect();
    const place = new Vector2(((event.clientX - left) / width) * 2 - 1, 1 - ((event.clientY - top) / height) * 2);
    const caster = new Raycaster();
    caster.setFromCamera(place, this.camera);
    const middle = this.middle();
    const sphere = new Sphere(middle, this.object.getWorldScale(new Vector3()).x * this.wind.size * (distance + length / 2));
    const { ray } = caster;
    const nearest = ray.closestPointToPoint(middle, new Vector3());
    const aside = nearest.distanceTo(middle);
    if (aside < sphere.radius) {
      const half = Math.sqrt(sphere.radius ** 2 - aside ** 2);
      nearest.addScaledVector(ray.direction, this.isInFront ? -half : half);
    }
    const direction = middle.sub(nearest).normalize();
    if (direction.lengthSq() > 0.5) this.onTurned(direction.toArray());
  }
}

const vertexShader = /* glsl */ `
varying vec3 vView;

void main() {
  vec4 seen = modelViewMatrix * vec4(position, 1.0);
  vView = seen.xyz;
  gl_Position = projectionMatrix * seen;
}
`;

const fragmentShader = /* glsl */ `
${windLightChunk}
uniform vec3 color;
uniform float glow;

void main() {
  gl_FragColor = vec4(mix(color * light(), vec3(1.0), 0.25 * glow), 1.0);
  #include <colorspace_fragment>
}
`;

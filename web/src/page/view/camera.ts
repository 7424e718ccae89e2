// The camera, moved by mouse, touch and keys. In scene units: the grid's box has a diagonal of 2 and lies around 0.
import { PerspectiveCamera, Vector3 } from 'three';
import { OrbitControls } from 'three/examples/jsm/controls/OrbitControls.js';

const firstDirection = new Vector3(0.42, 0.36, 1).normalize();
const turn = Math.PI / 24;
/** What is left of a glide falls to 1 / e in so many ms. */
const glideTime = 100;
/** The camera's place is told at most so often, in ms. */
const tellTime = 200;

export class Camera {
  readonly camera = new PerspectiveCamera(35, 1, 0.01, 100);
  readonly controls: OrbitControls;
  /** The camera is different from before. */
  onChange = () => {};
  /** The person has moved it. */
  onMoved = () => {};
  private isPersons = false;
  /** What was framed last, to be framed again in a window of another shape until the person moves the camera. */
  private framed: { center: Vector3; radius: number } | null = null;
  private timer: ReturnType<typeof setTimeout> | undefined;
  /** In ms: when the camera was moved last, and until when it glides. */
  private movedAt = 0;
  private glidesUntil = 0;

  constructor(
    canvas: HTMLCanvasElement,
    reducedMotion: MediaQueryList,
    private readonly now = () => performance.now(),
  ) {
    this.camera.position.copy(firstDirection).multiplyScalar(5);
    this.controls = new OrbitControls(this.camera, canvas);
    // Frames alone move the camera, by the time that has passed: else a glide would be as fast as frames and events are many.
    this.controls.update = () => this.wake();
    this.controls.minDistance = 0.02;
    this.controls.maxDistance = 60;
    const damp = () => (this.controls.enableDamping = !reducedMotion.matches);
    damp();
    reducedMotion.addEventListener('change', damp);
    this.controls.addEventListener('start', () => (this.isPersons = true));
    this.controls.addEventListener('change', () => this.changed());
    canvas.addEventListener('keydown', (event) => this.key(event));
  }

  /** There is something to be done in the next frame. */
  private wake(): boolean {
    const now = this.now();
    if (now > this.glidesUntil) this.movedAt = now;
    if (this.controls.enableDamping) this.glidesUntil = now + 8 * glideTime;
    this.onChange();
    return false;
  }

  /** Before each frame. */
  update(): void {
    const now = this.now();
    this.move(1 - Math.exp((this.movedAt - now) / glideTime));
    this.movedAt = now;
    if (now < this.glidesUntil) this.onChange();
  }

  /** Makes a share of the movement that is still to come. */
  private move(share: number): void {
    this.controls.dampingFactor = share;
    OrbitControls.prototype.update.call(this.controls);
  }

  private changed(): void {
    const distance = this.camera.position.distanceTo(this.controls.target);
    this.camera.near = distance / 200;
    this.camera.far = distance + 30;
    this.camera.updateProjectionMatrix();
    this.onChange();
    if (!this.isPersons) return;
    this.framed = null;
    this.timer ??= setTimeout(() => this.tell(), tellTime);
  }

  private tell(): void {
    this.timer = undefined;
    this.onMoved();
  }

  /** Arrows turn, with shift they shift; + and - come nearer and go away. */
  private key(event: KeyboardEvent): void {
    if (event.ctrlKey || event.metaKey || event.altKey) return;
    const step = keySteps[event.key];
    if (!step) return;
    event.preventDefault();
    this.isPersons = true;
    const [x, y, nearer] = step;
    if (nearer !== 0) this.controls.dollyIn(nearer > 0 ? 1 / 0.9 : 0.9);
    else if (event.shiftKey) this.controls.pan(-40 * x, 40 * y);
    else {
      if (x) this.controls.rotateLeft(x * turn);
      if (y) this.controls.rotateUp(y * turn);
    }
  }

  /** Looks at all of a ball. */
  frame(center: Vector3, radius: number, keepDirection: boolean): void {
    const direction = keepDirection ? this.camera.position.clone().sub(this.controls.target).normalize() : firstDirection;
    const half = (this.camera.fov * Math.PI) / 360;
    const narrow = Math.min(half, Math.atan(Math.tan(half) * this.camera.aspect));
    this.place(center.clone().addScaledVector(direction, radius / Math.sin(narrow)), center);
    this.framed = { center: center.clone(), radius };
  }

  place(position: Vector3, target: Vector3): void {
    this.isPersons = false;
    this.framed = null;
    clearTimeout(this.timer);
    this.timer = undefined;
    this.move(1); // The rest of a glide ends where it was.
    this.camera.position.copy(position);
    this.controls.target.copy(target);
    this.move(1);
    this.changed();
  }

  /** Follows a scene that was moved and scaled. */
  transform(move: (point: Vector3) => Vector3, scale: number): void {
    const { isPersons, framed } = this;
    this.place(move(this.camera.position), move(this.controls.target));
    this.isPersons = isPersons;
    this.framed = framed && { center: move(framed.center), radius: framed.radius * scale };
  }

  /** Whether the camera still stands where it sees all of something. */
  get isFramed(): boolean {
    return this.framed !== null;
  }

  resize(width: number, height: number): void {
    this.camera.aspect = width / height;
    this.camera.updateProjectionMatrix();
    if (this.framed) this.frame(this.framed.center, this.framed.radius, true);
  }
}

/** Right, up, nearer. */
const keySteps: Record<string, [number, number, number]> = {
  ArrowLeft: [-1, 0, 0],
  ArrowRight: [1, 0, 0],
  ArrowUp: [0, 1, 0],
  ArrowDown: [0, -1, 0],
  '+': [0, 0, 1],
  '=': [0, 0, 1],
  '-': [0, 0, -1],
};

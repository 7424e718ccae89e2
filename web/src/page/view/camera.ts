// The camera, moved by mouse, touch and keys. In scene units: the grid's box has a diagonal of 2 and lies around 0.
import { MathUtils, PerspectiveCamera, Quaternion, Vector3 } from 'three';
import { OrbitControls } from 'three/examples/jsm/controls/OrbitControls.js';
import type { Up } from '../../model/up';
import type { AxesSeen } from '../../model/view';
import { placeBetween, type Place } from './flight';
import { firstDirection, fit, uprightAxes } from './fit';

/** Field of view in degrees, along the picture's shorter side: what a link shows on a desk is in the picture on a phone. */
const shorterAngle = 35;
/** The share of the picture's width or height that what is framed fills. */
const filled = 0.78;
const turn = Math.PI / 24;
/** Inertia: what is left of a movement falls to 1 / e in this time, in ms. */
const glideTime = 100;
/** How long a flight takes, in ms. */
const flightTime = 700;
/** The cosine of the angle to the axis upwards below which no side of the camera is known to be up. */
const nearPole = 0.9999;
/** Shortest time between two reports of the camera's position, in ms. */
const tellTime = 200;

interface Flight {
  from: Place;
  to: Place;
  begin: number;
}

export class Camera {
  readonly camera = new PerspectiveCamera(shorterAngle, 1, 0.01, 100);
  controls: OrbitControls;
  /** The camera has changed. */
  onChange = () => {};
  /** It sees the axes in another way, in the frame that is to be drawn. */
  onTurned: (axes: AxesSeen) => void = () => {};
  /** The person has moved it. */
  onMoved = () => {};
  /** Of no camera, so that the first turn is told, too. */
  private readonly turned = new Quaternion(0, 0, 0, 0);
  private up: Up = 'y';
  private isPersons = false;
  /** Points in view, 3 numbers each, kept in view when the window changes its shape until the person moves the camera. */
  private framed: Float32Array | null = null;
  /** The same after flights around them. */
  private flownAround: Float32Array | null = null;
  private timer: ReturnType<typeof setTimeout> | undefined;
  /** When the camera was last updated and until when it glides, in ms. */
  private movedAt = 0;
  private glidesUntil = 0;
  private flight: Flight | null = null;

  constructor(
    private readonly canvas: HTMLCanvasElement,
    private readonly reducedMotion: MediaQueryList,
    private readonly now = () => performance.now(),
  ) {
    this.camera.position.set(0, 0, 5);
    this.controls = this.makeControls();
    reducedMotion.addEventListener('change', () => (this.controls.enableDamping = !reducedMotion.matches));
    canvas.addEventListener('keydown', (event) => this.key(event));
  }

  private makeControls(): OrbitControls {
    const controls = new OrbitControls(this.camera, this.canvas);
    // Only frames move the camera, by the time that has passed: otherwise inertia would depend on the rates of frames and events.
    controls.update = () => this.wake();
    controls.minDistance = 0.02;
    controls.maxDistance = 60;
    controls.enableDamping = !this.reducedMotion.matches;
    controls.addEventListener('start', () => this.takeOver());
    controls.addEventListener('change', () => this.changed());
    return controls;
  }

  /** Stands the camera upright along an axis, about which it turns from now on. OrbitControls only look at this when they are made. */
  setUp(up: Up): void {
    if (up === this.up) return;
    this.up = up;
    this.camera.up.copy(uprightAxes(up)[1]);
    const { target, enabled } = this.controls;
    this.controls.dispose();
    this.controls = this.makeControls();
    this.controls.target.copy(target);
    this.controls.enabled = enabled;
  }

  /** The person moves the camera now. */
  private takeOver(): void {
    this.isPersons = true;
    this.flight = this.flownAround = null;
  }

  /** Asks for a frame, since there is some movement to make. */
  private wake(): boolean {
    const now = this.now();
    if (now > this.glidesUntil) this.movedAt = now;
    if (this.controls.enableDamping) this.glidesUntil = now + 8 * glideTime;
    this.onChange();
    return false;
  }

  /** To be called before each frame. */
  update(): void {
    const now = this.now();
    if (this.flight) this.flyOn(this.flight);
    this.move(1 - Math.exp((this.movedAt - now) / glideTime));
    this.movedAt = now;
    this.tellTurn();
    if (this.flight || now < this.glidesUntil) this.onChange();
  }

  private tellTurn(): void {
    const { quaternion } = this.camera;
    if (this.turned.equals(quaternion)) return;
    this.turned.copy(quaternion);
    const toCamera = quaternion.clone().invert();
    const seen = (...axis: [number, number, number]) => new Vector3(...axis).applyQuaternion(toCamera).toArray();
    this.onTurned([seen(1, 0, 0), seen(0, 1, 0), seen(0, 0, 1)]);
  }

  /** Makes this share of the movement that is left. */
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

  /** Arrow keys rotate, with Shift they pan; + and - zoom. */
  private key(event: KeyboardEvent): void {
    if (event.ctrlKey || event.metaKey || event.altKey) return;
    const step = keySteps[event.key];
    if (!step) return;
    event.preventDefault();
    this.takeOver();
    const [x, y, nearer] = step;
    if (nearer !== 0) this.controls.dollyIn(nearer > 0 ? 1 / 0.9 : 0.9);
    else if (event.shiftKey) this.controls.pan(-40 * x, 40 * y);
    else {
      if (x) this.controls.rotateLeft(x * turn);
      if (y) this.controls.rotateUp(y * turn);
    }
  }

  /** Brings points into view, 3 numbers each, as large as they fit; from the first direction, or from where the camera is. */
  frame(points: Float32Array, keepDirection: boolean): void {
    this.place(this.placeFor(points, keepDirection ? this.direction : firstDirection(points, this.up), filled));
    this.framed = points;
  }

  /** From there the points fill this share of the picture's width or height. */
  private placeFor(points: Float32Array, direction: Vector3, share: number): Place {
    const slope = share * Math.tan((this.camera.fov * Math.PI) / 360);
    return fit(points, direction, this.camera.up, [slope * this.camera.aspect, slope]);
  }

  /** From the target to the camera. */
  private get direction(): Vector3 {
    return this.camera.position.clone().sub(this.controls.target).normalize();
  }

  /** Flies to points, as if the person had moved there. */
  flyTo(points: Float32Array, share = filled): void {
    this.flyToPlace(this.placeFor(points, this.direction, share));
  }

  private flyToPlace(to: Place): void {
    const { at } = this;
    this.place(to);
    this.flyFrom(at);
    this.isPersons = true;
    this.changed();
  }

  /** Flies around what it looks at, as if the person had, to see it from this direction: all of it, if all was in view. */
  lookFrom(direction: Vector3): void {
    const { at } = this;
    const whole = this.framed ?? this.flownAround;
    const [, up, front] = uprightAxes(this.up);
    // From above what is in front is at the bottom of the picture, from below at its top.
    const from = direction.clone().normalize();
    if (Math.abs(from.dot(up)) > nearPole) from.addScaledVector(front, 1e-3).normalize();
    const distance = at.position.distanceTo(at.target);
    this.flyToPlace(
      whole ? this.placeFor(whole, from, filled) : { position: from.multiplyScalar(distance).add(at.target), target: at.target },
    );
    this.flownAround = whole;
  }

  place(to: Place): void {
    this.isPersons = false;
    this.framed = this.flownAround = this.flight = null;
    clearTimeout(this.timer);
    this.timer = undefined;
    this.move(1); // a glide ends here
    this.moveTo(to);
  }

  get at(): Place {
    return { position: this.camera.position.clone(), target: this.controls.target.clone() };
  }

  /** Flies here from there, unless motion is to be reduced. */
  flyFrom(from: Place): void {
    if (this.reducedMotion.matches) return;
    this.flight = { from, to: this.at, begin: this.now() };
    this.moveTo(from);
  }

  private flyOn({ from, to, begin }: Flight): void {
    const time = Math.min((this.now() - begin) / flightTime, 1);
    const share = time * time * (3 - 2 * time);
    if (time === 1) this.flight = null;
    this.moveTo(time === 1 ? to : placeBetween(from, to, share, this.camera.up));
  }

  private moveTo({ position, target }: Place): void {
    this.camera.position.copy(position);
    this.controls.target.copy(target);
    this.move(1);
    this.changed();
  }

  /** Follows a scene that has been moved and scaled. A glide ends, and where it has led is told. */
  transform(move: (point: Vector3) => Vector3): void {
    const { isPersons, framed, flownAround, flight } = this;
    const moved = ({ position, target }: Place) => ({ position: move(position), target: move(target) });
    this.place(moved(this.at));
    this.isPersons = isPersons;
    if (isPersons) this.changed();
    this.flight = flight && { ...flight, from: moved(flight.from), to: moved(flight.to) };
    const points = framed ?? flownAround ?? [];
    const point = new Vector3();
    for (let at = 0; at < points.length; at += 3) move(point.fromArray(points, at)).toArray(points, at);
    this.framed = framed;
    this.flownAround = flownAround;
  }

  /** Whether something was brought into view and the camera has not been moved since. */
  get isFramed(): boolean {
    return this.framed !== null;
  }

  resize(width: number, height: number): void {
    const { DEG2RAD } = MathUtils;
    this.camera.aspect = width / height;
    this.camera.fov = (2 * Math.atan(Math.tan((shorterAngle * DEG2RAD) / 2) / Math.min(this.camera.aspect, 1))) / DEG2RAD;
    this.camera.updateProjectionMatrix();
    if (this.framed) this.frame(this.framed, true);
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

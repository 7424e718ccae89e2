// Handles to move the free plane along its normal and to turn it.
import { Group, Object3D, Vector3, type Camera } from 'three';
import { TransformControls } from 'three/examples/jsm/controls/TransformControls.js';

const up = new Vector3(0, 0, 1);

export class Gizmo {
  readonly group = new Group();
  onChange = () => {};
  /** The plane was moved: its unit normal and a point on it, in scene units. */
  onMoved: (normal: Vector3, point: Vector3) => void = () => {};
  /** A drag of a handle begins or ends. */
  onDragging: (isDragging: boolean) => void = () => {};
  isDragging = false;
  private readonly handle = new Object3D();
  private readonly controls: TransformControls[];

  constructor(camera: Camera, canvas: HTMLCanvasElement) {
    const [move, rotate] = (['translate', 'rotate'] as const).map((mode) => this.makeControls(mode, camera, canvas));
    for (const key of ['showX', 'showY', 'showXY', 'showYZ', 'showXZ'] as const) move[key] = false;
    for (const key of ['showZ', 'showE', 'showXYZE'] as const) rotate[key] = false;
    this.controls = [move, rotate];
    this.group.add(this.handle, move.getHelper(), rotate.getHelper());
    this.hide();
  }

  private makeControls(mode: 'translate' | 'rotate', camera: Camera, canvas: HTMLCanvasElement): TransformControls {
    const controls = new TransformControls(camera, canvas);
    controls.mode = mode;
    controls.space = 'local';
    controls.size = mode === 'rotate' ? 0.65 : 0.85;
    controls.addEventListener('change', () => this.onChange());
    controls.addEventListener('objectChange', () => {
      this.onMoved(up.clone().applyQuaternion(this.handle.quaternion), this.handle.position.clone());
    });
    controls.addEventListener('dragging-changed', ({ value }) => {
      this.isDragging = value === true;
      for (const other of this.controls) other.enabled = other === controls || !this.isDragging;
      this.onDragging(this.isDragging);
    });
    return controls;
  }

  /** Whether the pointer is on a handle. */
  get isTouched(): boolean {
    return this.group.visible && (this.isDragging || this.controls.some((controls) => controls.axis !== null));
  }

  show(normal: Vector3, point: Vector3): void {
    this.group.visible = true;
    for (const controls of this.controls) {
      controls.enabled = true;
      controls.attach(this.handle);
    }
    if (this.isDragging) return;
    this.handle.quaternion.setFromUnitVectors(up, normal);
    this.handle.position.copy(point);
  }

  hide(): void {
    this.group.visible = false;
    for (const controls of this.controls) {
      controls.detach();
      controls.enabled = false;
    }
  }
}

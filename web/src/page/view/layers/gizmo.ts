// Handles to move the free plane along its normal and to turn it.
import { Group, Line, Mesh, Object3D, Vector3, type Camera, type ColorRepresentation } from 'three';
import type { TransformControls } from 'three/examples/jsm/controls/TransformControls.js';
import { planeOf, reach } from '../../../model/planes';
import type { SliceSettings } from '../../../model/slices';
import type { Layer, Look } from '../layer';
import { sceneScale } from '../scene_space';

const up = new Vector3(0, 0, 1);
/** Opacity of the handles while the pointer is elsewhere. */
const idle = 0.35;

type Controls = typeof TransformControls;

/** Loaded when a free plane is first seen, or ahead. */
export async function loadControls(): Promise<Controls> {
  return (await import('three/examples/jsm/controls/TransformControls.js')).TransformControls;
}

/** In scene units, unlike other layers: handles are as large as the screen has them. */
export class Gizmo implements Layer {
  readonly object = new Group();
  onChange = () => {};
  /** The plane was moved. */
  onMoved: (slice: SliceSettings) => void = () => {};
  /** A drag of a handle begins or ends. */
  onDragging: (isDragging: boolean) => void = () => {};
  isDragging = false;
  private readonly handle = new Object3D();
  /** None before they are loaded. */
  private controls: TransformControls[] = [];
  private isLoading = false;
  private color: ColorRepresentation = 0;
  private look: Look | null = null;

  constructor(
    private readonly camera: Camera,
    private readonly canvas: HTMLCanvasElement,
  ) {
    this.object.add(this.handle);
    this.hide();
  }

  /** Once. What can't be loaded now is loaded when the plane is next seen. */
  private async load(): Promise<void> {
    if (this.isLoading || this.controls.length > 0) return;
    this.isLoading = true;
    try {
      const Controls = await loadControls();
      const [move, rotate] = (['translate', 'rotate'] as const).map((mode) => this.makeControls(Controls, mode));
      for (const key of ['showX', 'showY', 'showXY', 'showYZ', 'showXZ'] as const) move[key] = false;
      for (const key of ['showZ', 'showE', 'showXYZE'] as const) rotate[key] = false;
      this.controls = [move, rotate];
      this.object.add(move.getHelper(), rotate.getHelper());
      this.setColor(this.color);
      this.fade();
      if (this.look && this.object.visible) this.setLook(this.look);
      else this.hide();
      this.onChange();
    } catch {
      // The plane can be moved by its slider and its fields.
    } finally {
      this.isLoading = false;
    }
  }

  private makeControls(Controls: Controls, mode: 'translate' | 'rotate'): TransformControls {
    const controls = new Controls(this.camera, this.canvas);
    controls.mode = mode;
    controls.space = 'local';
    controls.size = mode === 'rotate' ? 0.65 : 0.85;
    controls.addEventListener('change', () => this.onChange());
    controls.addEventListener('axis-changed', () => this.fade());
    controls.addEventListener('objectChange', () => this.moved());
    controls.addEventListener('dragging-changed', ({ value }) => {
      this.isDragging = value === true;
      for (const other of this.controls) other.enabled = other === controls || !this.isDragging;
      this.onDragging(this.isDragging);
    });
    return controls;
  }

  setColor(color: ColorRepresentation): void {
    this.color = color;
    for (const controls of this.controls) controls.setColors(color, color, color, color);
  }

  /** Handles that nobody touches stay in the background. */
  private fade(): void {
    const opacity = this.isTouched ? 1 : idle;
    for (const controls of this.controls) {
      controls.getHelper().traverse((part) => {
        // TransformControls set the opacity of each handle anew from this.
        if (part instanceof Mesh || part instanceof Line) Object.assign(part.material, { _opacity: opacity });
      });
    }
  }

  /** Whether the pointer is on a handle. */
  get isTouched(): boolean {
    return this.object.visible && (this.isDragging || this.controls.some((controls) => controls.axis !== null));
  }

  private moved(): void {
    if (!this.look) return;
    const { model, settings } = this.look;
    const normal = up.clone().applyQuaternion(this.handle.quaternion);
    const scale = sceneScale(model) * (1 + settings.explode.cells);
    const position = (normal.dot(this.handle.position) / scale / reach(model, normal.toArray()) + 1) / 2;
    this.onMoved({ on: true, position: Math.max(0, Math.min(1, position)), normal: normal.toArray() });
  }

  dependsOn({ model, settings: { slices, explode }, instead }: Look): readonly unknown[] {
    return [model.id, slices.free, explode.cells, instead];
  }

  setLook(look: Look): void {
    const { model, settings, instead } = look;
    this.look = look;
    if (!settings.slices.free.on || instead) return this.hide();
    this.object.visible = true;
    void this.load();
    for (const controls of this.controls) {
      controls.enabled = true;
      controls.attach(this.handle);
    }
    if (this.isDragging) return;
    const { normal, offset } = planeOf(model, settings, 'free');
    const direction = new Vector3(...normal);
    this.handle.quaternion.setFromUnitVectors(up, direction);
    this.handle.position.copy(direction).multiplyScalar(offset * sceneScale(model) * (1 + settings.explode.cells));
  }

  hide(): void {
    this.object.visible = false;
    for (const controls of this.controls) {
      controls.detach();
      controls.enabled = false;
    }
  }
}

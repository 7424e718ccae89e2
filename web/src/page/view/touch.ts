// What a pointer does to the model: it lights the cell that it is over, picks it, flies to it, or sets the places that are measured.
import type { MeasuredPlace } from '../../model/measurement';
import type { Camera } from './camera';
import type { Framing } from './framing';
import type { Halves } from './halves';
import { hitOn, pixelAt, rayAt } from './hit';
import type { Layer, Look } from './layer';
import type { Loop } from './loop';
import type { Uniforms } from './material';
import type { Picked, Picker } from './picking';
import { type Point, Pointer } from './pointer';

/** The parts of the view that it works on. */
interface TouchParts {
  canvas: HTMLCanvasElement;
  uniforms: Uniforms;
  camera: Camera;
  framing: Framing;
  loop: Loop;
  picker: Picker;
  halves: Halves;
  ofModel: readonly Layer[];
  /** What is drawn, if it is the model and there is a picture of it. */
  look(): Look | null;
  /** Whether a handle is under the pointer. */
  isTaken(): boolean;
}

export class Touch {
  onHover: (cell: number | null) => void = () => {};
  onPick: (cell: number | null) => void = () => {};
  onMeasured: (place: MeasuredPlace) => void = () => {};
  /** Whether taps set places rather than pick cells. */
  isMeasuring = false;
  private hoverAt: Point | null = null;

  constructor(private readonly parts: TouchParts) {
    const pointer = new Pointer(parts.canvas, parts.isTaken);
    pointer.onHover = (pointed) => {
      const at = parts.look() && pointed;
      this.hoverAt = at;
      // A GPU that is behind is asked once it has caught up.
      if (at) parts.loop.soon(() => void this.hover(at));
      else void this.hover(null);
    };
    pointer.onTap = (at) => void (this.isMeasuring ? this.measure(at) : this.cellAt(at).then((cell) => this.onPick(cell)));
    pointer.onDoubleTap = (at) => {
      if (!this.isMeasuring) void this.cellAt(at).then((cell) => parts.framing.flyToCell(cell));
    };
    parts.canvas.addEventListener('keydown', (event) => {
      if (event.key === 'Escape' && !this.isMeasuring) this.onPick(null);
    });
  }

  /** The cells are others from now on. */
  forget(): void {
    this.hoverAt = null;
    this.parts.uniforms.hovered.value = -1;
  }

  private async hover(at: Point | null): Promise<void> {
    const { hovered } = this.parts.uniforms;
    const cell = at && (await this.cellAt(at));
    // By now the pointer may have left, or another model may have come.
    if (this.hoverAt !== at || hovered.value === (cell ?? -1)) return;
    hovered.value = cell ?? -1;
    this.onHover(cell);
    this.parts.loop.invalidate();
  }

  private async cellAt(at: Point): Promise<number | null> {
    return (await this.pickedAt(at))?.cell ?? null;
  }

  private async pickedAt({ x, y }: Point): Promise<Picked> {
    const { loop, halves, canvas, picker, camera } = this.parts;
    loop.prepare();
    if (!this.parts.look() || halves.isOther(x, canvas)) return null;
    return picker.pick(camera.camera, x, y);
  }

  private async measure(at: Point): Promise<void> {
    const { camera, canvas, ofModel, halves } = this.parts;
    const picking = this.pickedAt(at);
    const look = this.parts.look();
    // The camera may move on until it is known what was picked.
    const ray = look && rayAt(look, camera.camera, at, canvas);
    const picked = await picking;
    if (!this.isMeasuring) return;
    if (!ray || look.model !== this.parts.look()?.model || halves.isOther(at.x, canvas)) return;
    const place = hitOn(ofModel, look, picked, ray, pixelAt(camera.camera, canvas));
    if (place) this.onMeasured(place);
  }
}

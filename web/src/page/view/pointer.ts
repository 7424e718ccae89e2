export interface Point {
  x: number;
  y: number;
}

const tapDistance = 6;

/** Tells taps and hovering apart from drags. */
export class Pointer {
  onHover: (at: Point | null) => void = () => {};
  onTap: (at: Point) => void = () => {};
  onDoubleTap: (at: Point) => void = () => {};
  private pressed: (Point & { id: number }) | null = null;
  private hoverAt: Point | null = null;
  private hoverAsked = 0;

  constructor(
    private readonly canvas: HTMLCanvasElement,
    private readonly isTaken: () => boolean,
  ) {
    canvas.addEventListener('pointerdown', (event) => this.down(event));
    canvas.addEventListener('pointermove', (event) => this.move(event));
    canvas.addEventListener('pointerup', (event) => this.up(event));
    canvas.addEventListener('pointercancel', () => (this.pressed = null));
    canvas.addEventListener('pointerleave', () => this.hover(null));
    canvas.addEventListener('dblclick', (event) => !this.isTaken() && this.onDoubleTap(this.place(event)));
  }

  private place(event: MouseEvent): Point {
    const { left, top } = this.canvas.getBoundingClientRect();
    return { x: event.clientX - left, y: event.clientY - top };
  }

  private down(event: PointerEvent): void {
    // A second finger makes it a gesture.
    const isTap = event.isPrimary && event.button === 0 && !this.isTaken();
    this.pressed = isTap ? { ...this.place(event), id: event.pointerId } : null;
  }

  private move(event: PointerEvent): void {
    if (event.pointerType === 'touch' || event.buttons !== 0) return;
    this.hover(this.isTaken() ? null : this.place(event));
  }

  private up(event: PointerEvent): void {
    const at = this.place(event);
    const { pressed } = this;
    this.pressed = null;
    if (pressed?.id === event.pointerId && Math.hypot(at.x - pressed.x, at.y - pressed.y) < tapDistance) this.onTap(at);
  }

  /** At most once per frame. */
  private hover(at: Point | null): void {
    this.hoverAt = at;
    this.hoverAsked ||= requestAnimationFrame(() => {
      this.hoverAsked = 0;
      this.onHover(this.hoverAt);
    });
  }
}

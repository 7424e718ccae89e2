// When to draw: once something has changed, at the pace of the GPU. Preparing a picture and drawing it are separate tasks, so that the page
// never waits for both at once.
import { GpuPace } from './gpu_pace';
import { Quality } from './quality';

export interface Drawing {
  /** Brings what is drawn up to date. */
  prepare(): void;
  /** Whether the former picture had better stay, since something of the next one is still on its way. */
  isWaiting(): boolean;
  /** Draws, with this share of the screen's pixels per side. Gives whether something goes on moving by itself. */
  draw(seconds: number, share: number): boolean;
}

export class Loop {
  private readonly pace: GpuPace;
  private readonly quality = new Quality(() => this.invalidate());
  private asked = 0;
  private watched = 0;
  private isStale = true;
  /** Whether what is drawn is up to date and waits for its frame. */
  private isPrepared = false;
  private whenFree: (() => void) | null = null;

  constructor(
    gl: WebGL2RenderingContext,
    private readonly drawing: Drawing,
  ) {
    this.pace = new GpuPace(gl);
  }

  /** Asks for a frame. */
  invalidate(): void {
    if (this.asked === 0) this.asked = requestAnimationFrame(() => this.tick());
  }

  /** Asks for a frame that has to be prepared. */
  changed(): void {
    this.isStale = true;
    this.invalidate();
  }

  /** Draws now, as finely as the screen has it. */
  draw(): void {
    cancelAnimationFrame(this.asked);
    this.asked = 0;
    this.prepare();
    this.render(1);
  }

  /** Draws what has been prepared, before it is replaced: pictures must not be put off as long as new ones keep coming. */
  finish(): void {
    if (this.isPrepared && !this.drawing.isWaiting()) this.render();
    this.isPrepared = false;
  }

  /** Brings what is drawn up to date, without drawing it. */
  prepare(): void {
    if (this.isStale) this.drawing.prepare();
    this.isStale = false;
  }

  /** Has the GPU do something else as soon as it has caught up. Of several such tasks the last one wins. */
  soon(task: (() => void) | null): void {
    this.whenFree = task;
    if (task && this.pace.isBehind) this.invalidate();
    else this.runTask();
  }

  private runTask(): void {
    const task = this.whenFree;
    this.whenFree = null;
    task?.();
  }

  /** With a new graphics context nothing is left to wait for. */
  reset(): void {
    this.pace.reset();
  }

  private tick(): void {
    this.asked = 0;
    if (this.pace.isBehind) this.invalidate();
    else if (this.whenFree) {
      this.runTask();
      this.invalidate();
    } else if (this.isStale && !this.isPrepared) {
      this.prepare();
      this.isPrepared = true;
      this.invalidate();
    } else if (this.drawing.isWaiting()) this.invalidate();
    else this.render();
  }

  private render(share = this.quality.next(this.pace.took)): void {
    this.isPrepared = false;
    const isMoving = this.drawing.draw(performance.now() / 1000, share);
    this.pace.mark();
    if (isMoving || this.isStale) this.invalidate();
    this.watched ||= requestAnimationFrame(() => this.watch());
  }

  /** Sees when the picture is done, even if no other follows. */
  private watch(): void {
    this.watched = this.pace.isBehind ? requestAnimationFrame(() => this.watch()) : 0;
  }
}

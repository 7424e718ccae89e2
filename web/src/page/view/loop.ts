// When to draw: once something has changed, at the pace of the GPU. Preparing a picture and drawing it are separate tasks where that takes
// long, so that the page never waits for both at once.
import { GpuPace } from './gpu_pace';
import { Quality } from './quality';

export interface Drawing {
  /** Does a part of what is best done soon after the first picture, or before it. Gives whether there is more. */
  warmUp(): boolean;
  /** Brings what is drawn up to date. */
  prepare(): void;
  /** Whether the former picture had better stay, since something of the next one is still on its way. */
  isWaiting(): boolean;
  /** Whether the GPU has the shaders of what has been prepared. If not, does a part of what is missing. */
  hasShaders(): boolean;
  /** The same of what is drawn beside pictures. */
  hasShadersBeside(): boolean;
  /** Draws, with this share of the screen's pixels per side. Gives whether something goes on moving by itself. */
  draw(seconds: number, share: number): boolean;
  /** A picture that took so long, in ms, has stood for a moment. Gives whether a model is in it. */
  stand(took: number): boolean;
}

/** In ms. */
const pollTime = 4;
const longPreparation = 10;
/** In ms: how long a picture has to be there before it stands. */
const rest = 300;

export class Loop {
  private readonly pace: GpuPace;
  private readonly quality = new Quality(() => this.invalidate());
  private asked = 0;
  private watched = 0;
  private isStale = true;
  private isWarm = false;
  /** Whether the GPU may be compiling shaders for as long as it is behind: what uses them then blocks the page. */
  private isCompiling = false;
  /** Whether what is drawn is up to date and waits for its frame. */
  private isPrepared = false;
  private whenFree: (() => void) | null = null;
  private standing: ReturnType<typeof setTimeout> | undefined;

  constructor(
    gl: WebGL2RenderingContext,
    private readonly drawing: Drawing,
  ) {
    this.pace = new GpuPace(gl);
    setTimeout(() => this.warmUp());
  }

  /** By a timer, since there may be no frames while the GPU is busy. */
  private warmUp(): void {
    if (!this.pace.isBehind) {
      if (!this.drawing.warmUp()) return;
      this.isCompiling = true;
      this.pace.mark(false);
    }
    setTimeout(() => this.warmUp(), pollTime);
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
    if (this.hasShaders()) this.render(1);
  }

  /** Whether a picture, or what is drawn beside it, can be drawn at once. If not, it is asked for once more. */
  private hasShaders(isBeside = false): boolean {
    if (!this.isCompiling || !this.pace.isBehind) {
      this.isCompiling = !(isBeside ? this.drawing.hasShadersBeside() : this.drawing.hasShaders());
      if (!this.isCompiling) return true;
      this.pace.mark(false);
    }
    this.invalidate();
    return false;
  }

  /** Draws what has been prepared, before it is replaced: pictures must not be put off as long as new ones keep coming. */
  finish(): void {
    if (this.isPrepared && !this.drawing.isWaiting() && this.hasShaders()) this.render();
    this.isPrepared = false;
  }

  /** Brings what is drawn up to date, without drawing it. */
  prepare(): void {
    if (this.isStale) this.drawing.prepare();
    this.isStale = false;
  }

  /** Has the GPU draw something else as soon as it has caught up and has the shaders. Of several such tasks the last one wins. */
  soon(task: () => void): void {
    this.whenFree = task;
    if (this.pace.isBehind) this.invalidate();
    else this.runTask();
  }

  /** Gives whether there was one that can be run. */
  private runTask(): boolean {
    const task = this.whenFree;
    if (!task || !this.hasShaders(true)) return false;
    this.whenFree = null;
    task();
    return true;
  }

  /** With a new graphics context nothing is left to wait for. */
  reset(): void {
    this.pace.reset();
  }

  private tick(): void {
    this.asked = 0;
    if (this.pace.isBehind || this.runTask()) this.invalidate();
    else if (this.isStale && !this.isPrepared) {
      const begin = performance.now();
      this.prepare();
      this.isPrepared = true;
      const isLong = performance.now() - begin > longPreparation;
      if (isLong || this.drawing.isWaiting()) this.invalidate();
      else if (this.hasShaders()) this.render();
    } else if (this.drawing.isWaiting()) this.invalidate();
    else if (this.hasShaders()) this.render();
  }

  private render(share = this.quality.next(this.pace.took)): void {
    this.isPrepared = false;
    const isMoving = this.drawing.draw(performance.now() / 1000, share);
    this.pace.mark();
    if (isMoving || this.isStale) this.invalidate();
    this.standSoon();
    this.watched ||= requestAnimationFrame(() => this.watch());
  }

  private standSoon(): void {
    clearTimeout(this.standing);
    this.standing = setTimeout(() => this.stand(), rest);
  }

  /** Only once the GPU has drawn it. */
  private stand(): void {
    if (this.asked !== 0) return;
    if (this.pace.isBehind) return this.standSoon();
    if (!this.drawing.stand(this.pace.took) || this.isWarm) return;
    this.isWarm = true;
    this.warmUp();
  }

  /** Sees when the picture is done, even if no other follows. */
  private watch(): void {
    this.watched = this.pace.isBehind ? requestAnimationFrame(() => this.watch()) : 0;
  }
}

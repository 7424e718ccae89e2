/** Shares of the screen's pixels per side that are drawn while pictures follow one another, from the best to the quickest. */
const levels = [1, 0.7, 0.5];
/** In ms: pictures that take longer are drawn with fewer pixels from the next movement on, and such that take less with more. */
const slow = 60;
const quick = 15;
/** So many pictures in a row: one alone may have waited for something else, and each change makes the canvas anew. */
const inARow = 2;
/** In ms: pictures further apart than this do not follow one another, but stand. */
const rest = 250;

/** How finely to draw: as time allows while something moves, and as finely as the screen has it once it rests. */
export class Quality {
  private level = 0;
  /** How many of the last pictures were slow, or, below 0, quick. */
  private row = 0;
  private lastAt = -Infinity;
  /** For the first picture there is more to do than for those that follow. */
  private isFirst = true;
  private timer: ReturnType<typeof setTimeout> | undefined;

  /** `refine` draws a picture that stands. */
  constructor(
    private readonly refine: () => void,
    private readonly now = () => performance.now(),
  ) {}

  /** To be called before each picture, with the time that the one before took. Gives the share of pixels per side. */
  next(took: number): number {
    const now = this.now();
    const isMoving = now - this.lastAt < rest + took;
    this.lastAt = now;
    clearTimeout(this.timer);
    if (!isMoving) return 1;
    if (this.isFirst) this.isFirst = false;
    else this.judge(took);
    if (this.level > 0) this.timer = setTimeout(() => this.stand(), rest + took);
    return levels[this.level];
  }

  private judge(took: number): void {
    if (took > slow) this.row = Math.max(this.row, 0) + 1;
    else if (took < quick) this.row = Math.min(this.row, 0) - 1;
    else this.row = 0;
    if (Math.abs(this.row) < inARow) return;
    this.level = Math.min(Math.max(this.level + Math.sign(this.row), 0), levels.length - 1);
    this.row = 0;
  }

  private stand(): void {
    this.lastAt = -Infinity;
    this.refine();
  }
}

// Plays what moves by itself.
import type { GridSettings } from '../model/grid_around';
import type { Pose } from '../model/motion';
import { isCut, isMotion, type Play } from '../model/plays';
import type { Settings } from '../model/settings';
import type { SliceSettings } from '../model/slices';
import { nextFrame } from './frames';
import type { State } from './state';

/** Seconds for a period of a motion, or for once there and back. */
const periods: Record<Play, number> = { wave: 2.5, turn: 8, pass: 6, slice: 6, explode: 5, cells: 12 };
/** Cells along the longest side, from the coarsest to the finest. */
const cellRange = [2, 64] as const;
/** The rate is that of the cuts in this time, in ms. */
const rateTime = 1000;

/** The actions of the page that it takes. */
interface Page {
  readonly state: Pick<State, 'mesh' | 'play' | 'playing'>;
  readonly settings: Settings;
  change(part: Pick<Settings, 'explode'>): void;
  changeSlice(name: 'free', part: Partial<SliceSettings>): void;
  /** Both resolve to false if it can't be shown. */
  setGrid(grid: GridSettings): Promise<boolean>;
  setPose(pose: Pose): Promise<boolean>;
}

export class Player {
  private runs = 0;

  constructor(private readonly page: Page) {
    // Another mesh is a new beginning.
    page.state.mesh.subscribe(() => this.pause());
  }

  /** Goes on from where the page stands, until it is paused or can't go on. */
  async play(): Promise<void> {
    const run = ++this.runs;
    const { page } = this;
    const { playing } = page.state;
    const play = page.state.play.value;
    playing.value = { rate: isCut(play) ? 0 : null };
    let phase = phaseOf(page, play);
    let before = performance.now();
    let frame = nextFrame();
    const cuts: number[] = [];
    let shown = show(page, play, phase);
    while (run === this.runs) {
      // The worker goes on with the next cut while this one is taken and drawn. None runs further ahead.
      const next = isCut(play) ? show(page, play, phase) : null;
      if (!(await shown)) break;
      await frame;
      frame = nextFrame();
      const now = performance.now();
      if (run !== this.runs) return;
      phase += (now - before) / (1000 * periods[play]);
      before = now;
      shown = next ?? show(page, play, phase);
      if (!isCut(play)) continue;
      cuts.push(now);
      while (cuts[0] < now - rateTime) cuts.shift();
      playing.value = { rate: cuts.length };
    }
    if (run === this.runs) this.pause();
  }

  pause(): void {
    this.runs++;
    this.page.state.playing.value = null;
  }
}

/** 0 to 1 and back in a period. */
function swing(phase: number): number {
  return 1 - Math.abs(1 - 2 * (phase - Math.floor(phase)));
}

/** The phase in which the page stands. */
function phaseOf({ settings }: Page, play: Play): number {
  const { pose, slices, explode, grid } = settings;
  if (isMotion(play)) return pose?.motion === play ? pose.phase : 0;
  if (play === 'slice') return slices.free.on ? slices.free.position / 2 : 0.5;
  if (play === 'explode') return explode.cells / 2;
  const cells = 'min' in grid ? Math.max(...grid.cells) : grid.cells;
  const [least, most] = cellRange;
  return Math.min(Math.max(Math.log(cells / least) / Math.log(most / least), 0), 1) / 2;
}

/** Shows this phase. Resolves to false if it can't be shown. */
async function show(page: Page, play: Play, phase: number): Promise<boolean> {
  if (isMotion(play)) return page.setPose({ motion: play, phase });
  if (play === 'cells') {
    const [least, most] = cellRange;
    return page.setGrid({ cells: Math.round(least * (most / least) ** swing(phase)) });
  }
  if (play === 'slice') page.changeSlice('free', { on: true, position: swing(phase) });
  else page.change({ explode: { ...page.settings.explode, cells: swing(phase) } });
  return true;
}

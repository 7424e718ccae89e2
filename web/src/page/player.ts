// What moves by itself: the surface, or how it is sliced, pulled apart, and how finely it is cut.
import { motions, type Motion } from '../model/motion';
import type { App } from './app';
import { nextFrame } from './frames';

export const plays = [...motions, 'slice', 'explode', 'cells'] as const;
export type Play = (typeof plays)[number];

/** Seconds for a period of a motion, or for once there and back. */
const periods: Record<Play, number> = { wave: 2.5, turn: 8, pass: 6, slice: 6, explode: 5, cells: 12 };
/** Cells along the longest side, from the coarsest to the finest. */
const cellRange = [2, 64] as const;
/** The rate is that of the cuts in this time, in ms. */
const rateTime = 1000;

export interface Playing {
  /** Cuts a second; null for what is not cut again. */
  rate: number | null;
}

export class Player {
  private runs = 0;

  constructor(private readonly app: App) {
    // Another mesh is a new beginning.
    app.state.mesh.subscribe(() => this.pause());
  }

  /** Goes on from where the page stands, until it is paused or can't go on. */
  async play(): Promise<void> {
    const run = ++this.runs;
    const { app } = this;
    const { playing } = app.state;
    const play = app.state.play.value;
    playing.value = { rate: isCut(play) ? 0 : null };
    let phase = phaseOf(app, play);
    let before = performance.now();
    let frame = nextFrame();
    const cuts: number[] = [];
    let shown = show(app, play, phase);
    while (run === this.runs) {
      // The worker goes on with the next cut while this one is taken and drawn. None runs further ahead.
      const next = isCut(play) ? show(app, play, phase) : null;
      if (!(await shown)) break;
      await frame;
      frame = nextFrame();
      const now = performance.now();
      if (run !== this.runs) return;
      phase += (now - before) / (1000 * periods[play]);
      before = now;
      shown = next ?? show(app, play, phase);
      if (!isCut(play)) continue;
      cuts.push(now);
      while (cuts[0] < now - rateTime) cuts.shift();
      playing.value = { rate: cuts.length };
    }
    if (run === this.runs) this.pause();
  }

  pause(): void {
    this.runs++;
    this.app.state.playing.value = null;
  }
}

function isCut(play: Play): boolean {
  return play !== 'slice' && play !== 'explode';
}

export function isMotion(play: Play): play is Motion {
  return motions.some((motion) => motion === play);
}

/** 0 to 1 and back in a period. */
function swing(phase: number): number {
  return 1 - Math.abs(1 - 2 * (phase - Math.floor(phase)));
}

/** The phase in which the page stands. */
function phaseOf({ settings }: App, play: Play): number {
  const { pose, slices, explode, grid } = settings;
  if (isMotion(play)) return pose?.motion === play ? pose.phase : 0;
  if (play === 'slice') return slices.free.on ? slices.free.position / 2 : 0.5;
  if (play === 'explode') return explode.cells / 2;
  const cells = 'min' in grid ? Math.max(...grid.cells) : grid.cells;
  const [least, most] = cellRange;
  return Math.min(Math.max(Math.log(cells / least) / Math.log(most / least), 0), 1) / 2;
}

/** Shows this phase. Resolves to false if it can't be shown. */
async function show(app: App, play: Play, phase: number): Promise<boolean> {
  if (isMotion(play)) return app.setPose({ motion: play, phase });
  if (play === 'cells') {
    const [least, most] = cellRange;
    return app.setGrid({ cells: Math.round(least * (most / least) ** swing(phase)) });
  }
  if (play === 'slice') app.changeSlice('free', { on: true, position: swing(phase) });
  else app.change({ explode: { ...app.settings.explode, cells: swing(phase) } });
  return true;
}

// The opening of a visit without a link. It changes what is drawn alone: settings, link and history know nothing of it.
import { effect } from '@preact/signals';
import type { Comparison } from '../model/comparison';
import { isOutside } from '../model/inside';
import { lookAt, momentAt, openingSeconds } from '../model/opening';
import type { Model } from '../model/cut_model';
import type { Engine } from '../model/engine';
import { toHash } from '../model/hash';
import type { Wind } from '../model/wind';
import type { App } from './app';
import { firstPicture, nextFrame } from './frames';
import { reducedMotion } from './view/reduced_motion';

/** What a person does first ends it. */
const touches = ['pointerdown', 'keydown', 'wheel', 'dragenter', 'focusin', 'popstate', 'hashchange'];
/** In ms: so often it is seen whether pictures keep up, for the first time before anything moves ... */
const lookEvery = 400;
/** ... and so many have to be drawn in a second. */
const fewestPictures = 18;

/** Plays where it is wanted and the machine keeps up. */
export async function playOpening(app: App, engine: Engine): Promise<void> {
  const { model, state, view } = app;
  if (!model || state.status.value !== 'ready' || !isWanted() || toHash(app.settings) !== '') return;
  const end = new AbortController();
  for (const touch of touches) addEventListener(touch, () => end.abort(), { capture: true, passive: true, signal: end.signal });
  const { settings } = app;
  const unwatch = effect(() => {
    if (state.settings.value !== settings || state.model.value !== model) end.abort();
  });
  end.signal.addEventListener('abort', () => {
    unwatch();
    view.setComparison(state.divided.value);
    view.setWind(state.wind.value);
    if (!app.settings.wind.on) engine.cancelWind();
    view.setLook(app.settings);
  });
  await new Opening(app, engine, model).run(end.signal);
  end.abort();
}

/** Links show what they say, and not everybody likes motion. */
function isWanted(): boolean {
  return location.hash === '' && !reducedMotion().matches;
}

class Opening {
  private wind: Wind | null = null;
  private readonly surface: Comparison;

  constructor(
    private readonly app: App,
    private readonly engine: Engine,
    model: Model,
  ) {
    this.surface = surfaceOf(model);
  }

  /** Until it is over, or pictures don't keep up. */
  async run(signal: AbortSignal): Promise<void> {
    const { state, view } = this.app;
    await firstPicture(state, view);
    let [lookedAt, pictures] = [performance.now(), view.pictures];
    let begin: number | null = null;
    for (;;) {
      const now = await nextFrame();
      const seconds = begin === null ? 0 : (now - begin) / 1000;
      if (signal.aborted || seconds >= openingSeconds) return;
      if (now - lookedAt >= lookEvery) {
        if (view.pictures - pictures < (fewestPictures * (now - lookedAt)) / 1000) return;
        if (begin === null) void this.askForWind();
        begin ??= now;
        [lookedAt, pictures] = [now, view.pictures];
      }
      this.show(seconds);
    }
  }

  /** Without it the opening goes on. */
  private async askForWind(): Promise<void> {
    const { direction, cells } = this.app.settings.wind;
    this.wind = await this.engine.wind({ pose: null, cells, direction, surface: false, planes: [] }, false).catch(() => null);
  }

  private show(seconds: number): void {
    const { view, settings } = this.app;
    const moment = momentAt(seconds);
    view.setComparison(moment.divider < 1 ? this.surface : null);
    view.setWind(moment.wind ? this.wind : null);
    view.setLook(lookAt(settings, moment));
  }
}

/** The mesh as what stands beside the cut-cells: the outer sides of their pieces of triangles. */
function surfaceOf(model: Model): Comparison {
  const { position, index, cell, surfaceEnd } = model.triangles;
  const isInside = (corner: number) => !isOutside(model, model.cells.region[cell[corner]]);
  const shown = index.subarray(0, surfaceEnd).filter((_, at) => isInside(index[at - (at % 3)]));
  const inside = { volume: 0, area: 0, cells: null };
  return { origin: model.origin, ways: { voxels: { ...inside, position, index: shown, grid: null } }, exact: inside };
}

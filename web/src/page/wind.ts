// Shows the flow or the smoke that the settings ask for, whenever that is another one.
import { effect } from '@preact/signals';
import type { Model } from '../model/cut_model';
import type { Engine } from '../model/engine';
import { activePlanes, inWorld } from '../model/planes';
import type { Settings } from '../model/settings';
import type { View } from '../model/view';
import type { Smoke, SmokeState, Wind, WindFormat } from '../model/wind';
import { isAbort } from '../model/failure';
import { ask } from './ask';
import { asPageError } from './failure';
import { idle } from './frames';
import type { SmokeClock } from './smoke';
import type { State } from './state';

type Request = Parameters<Engine['wind']>[0];
type SmokeRequest = Parameters<Engine['smoke']>[0];

/** In ms: the numbers of the smoke change no more often. */
const tellEvery = 250;

/** A flow about a mesh of more triangles is solved when it is asked for, not ahead: it takes long, and much memory. */
const mostTrianglesAhead = 100_000;

export class WindTunnel {
  /** A model of the former mesh, which is shown until there is one of the new mesh. */
  private former: Model | null = null;
  /** What was asked for last. */
  private asked = '';
  private count = 0;
  /** What was solved ahead last. */
  private ahead = '';
  private isSmoke = false;
  private clock: SmokeClock | null = null;
  /** When numbers of the smoke were last said. */
  private told = 0;

  constructor(
    private readonly state: State,
    private readonly engine: Engine,
    private readonly view: View,
  ) {
    effect(() => this.forget(state.mesh.value));
    effect(() => void this.update(state.model.value, state.settings.value, state.playing.value !== null));
  }

  /** From now on the flow about each mesh that stands still is solved when the page has nothing else to do, before it is asked for. */
  beginAhead(): void {
    effect(() => void this.solveAhead(this.state.model.value, this.state.settings.value));
  }

  private async solveAhead(model: Model | null, settings: Settings): Promise<void> {
    const mesh = this.state.mesh.peek();
    if (
      !model ||
      model.isMoving ||
      model === this.former ||
      !mesh ||
      mesh.triangles > mostTrianglesAhead ||
      settings.wind.on ||
      settings.wind.smoke
    )
      return;
    const request: Request = { ...requestOf(model, settings), planes: [] };
    const ahead = JSON.stringify(request);
    if (ahead === this.ahead) return;
    this.ahead = ahead;
    await idle();
    if (ahead === this.ahead && !this.state.settings.peek().wind.on) await this.engine.windAhead(request).catch(() => {});
  }

  /** The flow about the former mesh. */
  private forget(mesh: unknown): void {
    this.former = mesh ? this.state.model.peek() : null;
    this.ahead = '';
    this.stop();
  }

  private stop(): void {
    this.count++;
    this.asked = '';
    this.engine.cancelWind();
    this.state.isWindAwaited.value = false;
    this.show(null);
    this.showSmoke(null);
    this.engine.endSmoke();
  }

  private show(wind: Wind | null): void {
    if (wind === this.state.wind.peek()) return;
    this.state.wind.value = wind;
    this.view.setWind(wind);
  }

  /** About a mesh that moves by itself there is no smoke: it would begin again with each moment. */
  private async update(model: Model | null, settings: Settings, isPlaying: boolean): Promise<void> {
    if (!settings.wind.on || !model || model === this.former || (settings.wind.smoke && isPlaying)) {
      if (this.asked !== '') this.stop();
      return;
    }
    const { smoke } = settings.wind;
    const request = smoke ? smokeRequestOf(settings) : requestOf(model, settings);
    const asked = JSON.stringify([smoke, request]);
    if (asked === this.asked) return;
    if (smoke !== this.isSmoke) this.stop();
    this.isSmoke = smoke;
    this.asked = asked;
    const count = ++this.count;
    this.state.isWindAwaited.value = true;
    if (smoke) await this.updateSmoke(smokeRequestOf(settings), count);
    else await this.updateWind(requestOf(model, settings), count);
  }

  private async updateSmoke(request: SmokeRequest, count: number): Promise<void> {
    this.clock?.end(); // its flow ends where another one begins
    const begun = await ask(this.state, Promise.all([this.engine.smoke(request), import('./smoke')]));
    if (count !== this.count) return;
    if (!begun) this.showSmoke(null);
    else {
      const [smoke, { SmokeClock }] = begun;
      this.showSmoke(
        new SmokeClock(this.engine, smoke, {
          state: (state, rate) => this.tell(smoke, state, rate),
          error: (error) => this.endSmoke(error),
        }),
      );
      this.tell(smoke, smoke.begin, 0);
    }
    this.state.isWindAwaited.value = false;
  }

  private tell({ counts, cells, size }: Smoke, { time, drag, lift }: SmokeState, stepsPerSecond: number): void {
    const now = performance.now();
    if (stepsPerSecond > 0 && now - this.told < tellEvery) return;
    this.told = now;
    this.state.smoke.value = { counts, cells, time: time / size, drag, lift, stepsPerSecond };
  }

  /** What is drawn stays as it is. */
  private endSmoke(error: unknown): void {
    if (!isAbort(error)) this.state.alert(asPageError(error));
    this.engine.endSmoke();
  }

  private showSmoke(clock: SmokeClock | null): void {
    if (clock === this.clock) return;
    this.clock?.end();
    this.clock = clock;
    this.view.setSmoke(clock);
    if (!clock) this.state.smoke.value = null;
  }

  private async updateWind(request: Request, count: number): Promise<void> {
    const wind = await ask(this.state, this.engine.wind(request));
    // Where newer ones have been asked for, this one is shown until they come, unless it is about another mesh.
    if (wind && this.asked !== '') this.show(wind);
    if (count !== this.count) return;
    this.state.isWindAwaited.value = false;
    if (!wind) this.show(null);
  }

  /** The flow as a file. */
  async write(format: WindFormat): Promise<Uint8Array | null> {
    const { model, settings } = this.state;
    return model.value && ask(this.state, this.engine.writeWind(requestOf(model.value, settings.value), format));
  }
}

function smokeRequestOf({ pose, wind: { direction } }: Settings): SmokeRequest {
  return { pose, direction };
}

function requestOf(model: Model, settings: Settings): Request {
  const { direction, cells, show } = settings.wind;
  const planes = show === 'none' ? [] : activePlanes(model, settings);
  return {
    pose: settings.pose,
    cells,
    direction,
    surface: show !== 'none',
    planes: inWorld(planes, model.origin),
  };
}

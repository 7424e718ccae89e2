// Shows the flow that the settings ask for, whenever that is another one.
import { effect } from '@preact/signals';
import type { Engine, Model, Settings, View } from '../model/types';
import type { Wind, WindFormat } from '../model/wind';
import { ask } from './ask';
import type { State } from './state';
import { activePlanes, inWorld } from '../model/planes';

type Request = Parameters<Engine['wind']>[0];

export class WindTunnel {
  /** A model of the former mesh, which is shown until there is one of the new mesh. */
  private former: Model | null = null;
  /** What was asked for last. */
  private asked = '';
  private count = 0;

  constructor(
    private readonly state: State,
    private readonly engine: Engine,
    private readonly view: View,
  ) {
    effect(() => this.forget(state.mesh.value));
    effect(() => void this.update(state.model.value, state.settings.value));
  }

  /** The flow about the former mesh. */
  private forget(mesh: unknown): void {
    this.former = mesh ? this.state.model.peek() : null;
    this.stop();
  }

  private stop(): void {
    this.count++;
    this.asked = '';
    this.engine.cancelWind();
    this.state.isWindAwaited.value = false;
    this.show(null);
  }

  private show(wind: Wind | null): void {
    if (wind === this.state.wind.peek()) return;
    this.state.wind.value = wind;
    this.view.setWind(wind);
  }

  private async update(model: Model | null, settings: Settings): Promise<void> {
    if (!settings.wind.on || !model || model === this.former) {
      if (this.asked !== '') this.stop();
      return;
    }
    const request = requestOf(model, settings);
    const asked = JSON.stringify(request);
    if (asked === this.asked) return;
    this.asked = asked;
    const count = ++this.count;
    this.state.isWindAwaited.value = true;
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

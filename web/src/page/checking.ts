// Checks a small cut-mesh once it has stood for a moment, and any when asked.
import { effect } from '@preact/signals';
import { checksSentence, mostFacesUnasked, type Checks } from '../model/checks';
import { pageError } from '../model/failure';
import type { Model } from '../model/cut_model';
import type { Engine } from '../model/engine';
import { ask } from './ask';
import type { State } from './state';

/** In ms: a cut-mesh stands if no other has come and nothing has been held for so long. */
const pause = 600;

export class Checking {
  private timer: ReturnType<typeof setTimeout> | undefined;
  /** The model whose check is under way. */
  private underWay: number | null = null;

  constructor(
    private readonly state: State,
    private readonly engine: Engine,
  ) {}

  /** From now on small cut-meshes are checked unasked. */
  begin(): void {
    effect(() => {
      const { model, status, playing, isHeld } = this.state;
      clearTimeout(this.timer);
      const shown = model.value;
      const isStanding = status.value === 'ready' && playing.value === null && !isHeld.value;
      if (shown && isStanding) this.timer = setTimeout(() => void this.checkUnasked(shown), pause);
    });
  }

  /** Nobody waits for it: where it can't be done nothing is said. */
  private async checkUnasked(model: Model): Promise<void> {
    const known = [this.state.checked.value?.model, this.underWay];
    if (model.counts.faces > mostFacesUnasked || known.includes(model.id)) return;
    this.underWay = model.id;
    const checks = await this.engine.validate().catch(() => null);
    if (this.underWay === model.id) this.underWay = null;
    if (checks) this.take(checks);
  }

  /** As the person asks. */
  async check(): Promise<void> {
    const checks = await ask(this.state, this.engine.validate());
    if (checks) this.take(checks);
  }

  /** If another cut came meanwhile, its checks have been answered. */
  private take(checks: Checks): void {
    const model = this.state.model.value;
    if (!model) return;
    this.state.checked.value = { model: model.id, checks };
    if (!checks.pass) this.state.alert(pageError('The cut-mesh is wrong', checksSentence(checks, model.counts.cutCells) ?? ''), 'mesh');
  }
}

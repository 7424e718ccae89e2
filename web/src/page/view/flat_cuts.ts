// What fills cells that are cut flat: it comes with the model; when planes move, the worker slices again, one request at a time.
import type { Caps, Model } from '../../model/cut_model';
import type { Engine } from '../../model/engine';
import { isAbort, type PageError } from '../../model/failure';
import { activePlanes, inWorld } from '../../model/planes';
import type { Settings } from '../../model/settings';
import type { ViewPlane } from '../../model/slices';
import type { Look } from './layer';

/** The answer to a request for slices. */
interface Slices extends Caps {
  id: number;
  model: number;
}

/** In ms. */
const longestWait = 400;
const noCaps = { id: 0, slices: [] };

export class FlatCuts {
  /** Slices have come that were asked for. */
  onMade = () => {};
  onError: (error: PageError) => void = () => {};
  private made: Slices | null = null;
  private count = 0;
  private isAsking = false;
  private model: Model | null = null;
  private settings: Settings | null = null;
  private modelSince = 0;
  private wanted: readonly ViewPlane[] = [];

  constructor(private readonly slice: Engine['slice']) {}

  setModel(model: Model): void {
    this.model = model;
    this.modelSince = performance.now();
    if (model.caps) this.made = { id: ++this.count, model: model.id, ...model.caps };
  }

  /**
   * The planes to draw with, the same array as long as they are the same. A flat cut keeps the former ones until new slices arrive, so that
   * no picture lacks its caps.
   */
  choose(model: Model, settings: Settings): Pick<Look, 'planes' | 'caps'> {
    this.settings = settings;
    const asked = activePlanes(model, settings);
    if (!samePlanes(asked, this.wanted)) this.wanted = asked;
    const { wanted } = this;
    if (settings.sliceMode !== 'flat' || wanted.length === 0) return { planes: wanted, caps: noCaps };
    const made = this.made?.model === model.id ? this.made : null;
    if (!made || !samePlanes(made.planes, wanted)) void this.ask();
    return made ? { planes: made.planes, caps: made } : { planes: wanted, caps: noCaps };
  }

  /** Whether the slices of a new model are on their way: the former picture stays meanwhile, but not for long. */
  get isAwaited(): boolean {
    return this.isAsking && this.made?.model !== this.model?.id && performance.now() - this.modelSince < longestWait;
  }

  /** One request at a time: after its answer, the planes wanted by then are asked for. */
  private async ask(): Promise<void> {
    const { model, settings } = this;
    if (this.isAsking || !model || !settings) return;
    this.isAsking = true;
    const planes = activePlanes(model, settings);
    const slices = await this.slice(inWorld(planes, model.origin), true).catch((error: unknown) => {
      if (!isAbort(error)) this.onError(error as PageError);
      // Without caps, cells are seen cut open. The same planes aren't asked for again, or failures would go on for ever.
      return [];
    });
    // A newer model may have come, with its own.
    if (model === this.model) this.made = { id: ++this.count, model: model.id, planes, slices };
    this.isAsking = false;
    this.onMade();
  }
}

function samePlanes(a: readonly ViewPlane[], b: readonly ViewPlane[]): boolean {
  return JSON.stringify(a) === JSON.stringify(b);
}

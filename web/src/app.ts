// The state of the page and what can be done to it. Panels call the methods and listen to the events.
import type { Validation } from 'mandoline-wasm';
import { Events } from './events';
import { defaultSettings, defaultSource } from './settings';
import type { CellCard, Engine, GridSettings, Model, PageError, Settings, SliceName, SliceSettings, Source, StepPicture, StepRequest, View } from './types';

export interface LoadedMesh {
  name: string;
  vertices: number;
  triangles: number;
}

export interface AppEvents {
  settings: Settings;
  /** The mesh that cuts are made of from now on. */
  mesh: LoadedMesh;
  model: Model;
  state: 'busy' | 'ready' | 'error';
  /** Whether a cut is under way. */
  cutting: boolean;
  progress: { stage: string; fraction: number } | null;
  cutError: PageError | null;
  alert: PageError;
  hover: number | null;
  pinned: CellCard | null;
  step: StepPicture | null;
}

/** A cut that took longer is given up for a newer one; a shorter one is drawn first, so that dragging shows pictures all along. */
const patience = 400;

export class App {
  readonly events = new Events<AppEvents>();
  settings = defaultSettings();
  model: Model | null = null;
  private loads = 0;
  private pins = 0;
  private pinned = false;
  private steps = 0;
  private stepKind: StepRequest['kind'] | null = null;
  private cutAsked: { frame: boolean } | null = null;
  private cutStarted = 0;
  private cutRuns = false;

  constructor(
    private readonly engine: Engine,
    readonly view: View,
  ) {
    engine.onProgress = (progress) => this.events.tell('progress', progress);
    view.onHover = (cell) => this.events.tell('hover', cell);
    view.onPick = (cell) => void this.pin(cell);
    view.onCamera = (camera) => this.change({ camera }, false);
    view.onFreePlane = (slice) => this.change({ slices: { ...this.settings.slices, free: slice } }, false);
  }

  /** Loads a mesh and cuts it, into `cells` along its longest side if that is given. Resolves to whether the mesh could be loaded; if not, the page goes on with the former one. */
  async open(source: Source, { bytes, cells }: { bytes?: ArrayBuffer; cells?: number } = {}): Promise<boolean> {
    const load = ++this.loads;
    this.events.tell('state', 'busy');
    this.engine.cancel();
    try {
      const mesh = await this.engine.load(source, bytes);
      if (load !== this.loads) return true;
      this.events.tell('mesh', mesh);
    } catch (error) {
      if (load === this.loads && !isAbort(error)) {
        this.events.tell('alert', pageError(error));
        this.events.tell('state', 'error');
      }
      return false;
    }
    const { grid, show } = this.settings;
    const former = 'min' in grid ? Math.max(...grid.cells) : grid.cells;
    this.change({ source, grid: { cells: cells ?? former }, show: { ...show, region: null }, camera: null }, false);
    await this.recut(true);
    return true;
  }

  /** Takes over all settings, as a link gives them. A mesh that can't be had is replaced by the default one. */
  async restore(settings: Settings): Promise<void> {
    const wanted = settings.source.kind === 'file' ? defaultSource : settings.source;
    this.settings = { ...settings, source: wanted };
    this.events.tell('state', 'busy');
    const loaded = await this.loadOrDefault(wanted);
    if (loaded) this.events.tell('mesh', loaded);
    this.events.tell('settings', this.settings);
    if (loaded) await this.recut(settings.camera === null);
    else this.events.tell('state', 'error');
  }

  private async loadOrDefault(source: Source): Promise<LoadedMesh | null> {
    try {
      return await this.engine.load(source);
    } catch (error) {
      this.events.tell('alert', pageError(error));
      if (this.model || source === defaultSource) return null;
      this.settings = { ...this.settings, source: defaultSource };
      return this.loadOrDefault(defaultSource);
    }
  }

  /** Changes how the model is shown. */
  change(part: Partial<Settings>, draw = true): void {
    this.settings = { ...this.settings, ...part };
    if (draw) this.view.setLook(this.settings);
    this.events.tell('settings', this.settings);
  }

  changeSlice(name: SliceName, part: Partial<SliceSettings>): void {
    const { slices } = this.settings;
    this.change({ slices: { ...slices, [name]: { ...slices[name], ...part } } });
  }

  /** Turns a plane around where it is. */
  flip(name: SliceName): void {
    const { position, normal } = this.settings.slices[name];
    this.changeSlice(name, { position: 1 - position, normal: [-normal[0], -normal[1], -normal[2]] });
  }

  /** Looks at all of the model. */
  frame(): void {
    this.view.frame();
    this.change({ camera: null }, false);
  }

  changeShow(part: Partial<Settings['show']>): void {
    this.change({ show: { ...this.settings.show, ...part } });
  }

  setGrid(grid: GridSettings): void {
    this.change({ grid }, false);
    void this.recut(false);
  }

  setSnapTolerance(snapTolerance: number): void {
    this.change({ snapTolerance }, false);
    void this.recut(false);
  }

  /** Cuts with the newest settings: at once, or after the cut under way. */
  async recut(frame: boolean): Promise<void> {
    this.cutAsked = { frame: frame || (this.cutAsked?.frame ?? false) };
    if (this.cutRuns) {
      this.giveUpLater();
      return;
    }
    this.cutRuns = true;
    this.events.tell('cutting', true);
    while (this.cutAsked) {
      const asked: { frame: boolean } = this.cutAsked;
      this.cutAsked = null;
      await this.cutOnce(asked.frame);
    }
    this.cutRuns = false;
    this.events.tell('cutting', false);
  }

  private giveUpLater(): void {
    const started = this.cutStarted;
    const stillInTheWay = () => this.cutAsked && this.cutRuns && this.cutStarted === started;
    setTimeout(() => stillInTheWay() && this.engine.cancel(), started + patience - performance.now());
  }

  private async cutOnce(frame: boolean): Promise<void> {
    const load = this.loads;
    this.cutStarted = performance.now();
    this.events.tell('state', 'busy');
    try {
      const model = await this.engine.cut(this.settings.grid, this.settings.snapTolerance);
      if (load !== this.loads) return;
      this.takeModel(model, frame);
      this.events.tell('cutError', null);
      this.events.tell('state', 'ready');
    } catch (error) {
      if (load !== this.loads) return;
      if (!isAbort(error)) this.events.tell('cutError', pageError(error));
      this.events.tell('state', isAbort(error) ? 'ready' : 'error');
    }
  }

  private takeModel(model: Model, frame: boolean): void {
    this.model = model;
    void this.pin(null);
    const { region } = this.settings.show;
    if (region !== null && region >= model.counts.regions) this.settings = { ...this.settings, show: { ...this.settings.show, region: null } };
    this.view.setModel(model, frame);
    this.view.setLook(this.settings);
    this.events.tell('model', model);
    this.events.tell('settings', this.settings);
    if (this.stepKind) void this.step({ kind: this.stepKind });
  }

  cancel(): void {
    this.cutAsked = null;
    this.engine.cancel();
  }

  /** Pins a cell and gets its card, or lets go of it. */
  async pin(cell: number | null): Promise<void> {
    const pin = ++this.pins;
    this.pinned = cell !== null;
    this.view.setPinned(cell);
    if (cell === null) return this.events.tell('pinned', null);
    const card = await this.ask(this.engine.card(cell));
    if (card && pin === this.pins) this.events.tell('pinned', card);
  }

  /** Shows a step of the algorithm instead of the model, or the model again. */
  async step(request: StepRequest | null): Promise<void> {
    const step = ++this.steps;
    this.stepKind = request?.kind ?? null;
    if (!request) return this.showStep(null);
    const picture = await this.ask(this.engine.step(request));
    if (picture && step === this.steps) this.showStep(picture);
  }

  private showStep(picture: StepPicture | null): void {
    this.view.setStep(picture);
    this.events.tell('step', picture);
  }

  /** Lets go of the pinned cell, or else of the step. */
  leave(): void {
    if (this.pinned) void this.pin(null);
    else if (this.stepKind) void this.step(null);
  }

  validate(): Promise<Validation | null> {
    return this.ask(this.engine.validate());
  }

  write(format: 'json' | 'vtu' | 'obj'): Promise<Uint8Array | null> {
    return this.ask(this.engine.write(format));
  }

  /** The answer, or null after an alert. */
  async ask<T>(answer: Promise<T>): Promise<T | null> {
    try {
      return await answer;
    } catch (error) {
      if (!isAbort(error)) this.events.tell('alert', pageError(error));
      return null;
    }
  }
}

function isAbort(error: unknown): boolean {
  return error instanceof Error && error.name === 'AbortError';
}

function pageError(error: unknown): PageError {
  if (typeof error === 'object' && error !== null && 'title' in error && 'detail' in error) return { title: String(error.title), detail: String(error.detail) };
  return { title: 'Something went wrong', detail: error instanceof Error ? error.message : String(error) };
}

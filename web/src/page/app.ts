// The actions on the state of the page. Panels call them and read the state.
import { batch } from '@preact/signals';
import type { Validation } from 'mandoline-wasm';
import { isPageError } from '../model/failure';
import { gallery } from '../model/gallery/list';
import { defaultCells, defaultSettings, defaultSource } from '../model/settings';
import { isOutside } from '../model/inside';
import type { Pose } from '../model/motion';
import { Player } from './player';
import { isSheet } from './view/look';
import type { State } from './state';
import { WindTunnel } from './wind';
import type {
  Cutting,
  Engine,
  GridSettings,
  Instead,
  MeshInfo,
  Model,
  PageError,
  Settings,
  SliceName,
  SliceSettings,
  Source,
  StepRequest,
  View,
} from '../model/types';

/** Fewer cut-cells than this are best seen without a slice. */
const fewCells = 60;

export class App {
  readonly player: Player;
  readonly windTunnel: WindTunnel;
  private loads = 0;
  private loading = 0;
  private pins = 0;
  private pinned = false;
  private insteads = 0;
  private insteadKind: Instead['kind'] | null = null;
  private work = 0;
  private cuts = 0;
  private failed = false;
  /** What was opened from files, by their names, for the way back. */
  private readonly files = new Map<string, Blob>();
  /** Alerts to be shown in the end: a fallback that succeeds must not clear them. */
  private troubles: PageError[] = [];
  /** Whether the next model needs a camera that sees all of it, or a look that suits it. */
  private frameNext = false;
  private fitNext = false;
  /** What the model was made of. */
  private shown: { cutting: Cutting; mesh: MeshInfo | null } = { cutting: defaultSettings(), mesh: null };

  constructor(
    private readonly engine: Engine,
    readonly view: View,
    readonly state: State,
  ) {
    this.player = new Player(this);
    engine.onProgress = (progress) => (state.progress.value = progress);
    view.onHover = (cell) => (state.hovered.value = cell);
    view.onPick = (cell) => void this.pin(cell);
    view.onCamera = (camera) => this.change({ camera }, false);
    this.windTunnel = new WindTunnel(state, engine, view, (answer) => this.ask(answer));
    view.onWind = (direction) => this.changeWind({ direction });
    view.onFreePlane = (slice) => this.change({ slices: { ...this.settings.slices, free: slice } }, false);
  }

  get settings(): Settings {
    return this.state.settings.value;
  }

  get mesh(): MeshInfo | null {
    return this.state.mesh.value;
  }

  get model(): Model | null {
    return this.state.model.value;
  }

  /** Loads a mesh and cuts it, if given into `cells` along its longest side. If it can't be loaded, the page keeps the previous one. */
  async open(source: Source, { bytes, cells }: { bytes?: ArrayBuffer; cells?: number } = {}): Promise<void> {
    await this.during(async () => {
      if (source.kind === 'file' && bytes) this.files.set(source.name, new Blob([bytes]));
      if ((await this.load(source)) !== 'loaded') return;
      const grid = { cells: cells ?? this.cellsToKeep() };
      this.fitNext = true;
      this.change({ source, grid, snapTolerance: 0, pose: null, show: { ...this.settings.show, region: null }, camera: null }, false);
      await this.recut(true);
    });
  }

  /** The resolution for a mesh that comes without one: the current one, unless it was meant for a mesh of the gallery. */
  private cellsToKeep(): number {
    const { source, grid } = this.settings;
    const cells = 'min' in grid ? Math.max(...grid.cells) : grid.cells;
    const isGallerys = source.kind === 'gallery' && gallery.some((entry) => entry.name === source.name && entry.cells === cells);
    return isGallerys ? defaultCells : cells;
  }

  /** Applies all settings of a link. If its mesh can't be loaded, the previous or the default one takes its place. */
  async restore(settings: Settings): Promise<void> {
    await this.during(async () => {
      let source = this.canOpen(settings.source) ? settings.source : defaultSource;
      let outcome = this.isOpen(source) ? 'loaded' : await this.load(source);
      if (outcome === 'failed' || outcome === 'cancelled') {
        source = this.model ? this.settings.source : defaultSource;
        outcome = this.model ? 'loaded' : await this.load(source);
      }
      if (outcome !== 'loaded') return;
      this.change({ ...settings, source }, false);
      if (this.isCut()) return this.showAgain();
      const error = await this.recut(settings.camera === null);
      if (error && !this.model) await this.fallBack(error);
      else if (!error) this.showSomething();
    });
  }

  /** Files can be opened again as long as the page is there. */
  canOpen(source: Source): boolean {
    return source.kind !== 'file' || this.files.has(source.name);
  }

  private isOpen(source: Source): boolean {
    return this.mesh !== null && this.loading === 0 && same(source, this.settings.source);
  }

  /** Whether the model is what the settings ask for. */
  private isCut(): boolean {
    const { grid, snapTolerance, pose } = this.settings;
    return (
      this.model !== null && this.cuts === 0 && this.shown.mesh === this.mesh && same(this.shown.cutting, { grid, snapTolerance, pose })
    );
  }

  private showAgain(): void {
    this.state.cutError.value = null;
    this.view.setLook(this.settings);
    if (!this.settings.camera) this.view.frame();
    this.showSomething();
  }

  /** Links leave out defaults, and these would hide a sheet, or a model that is all outside. */
  private showSomething(): void {
    const { model, settings } = this;
    if (!model || settings.show.outside) return;
    if (isSheet(model) && JSON.stringify(settings.show) === JSON.stringify(defaultSettings().show)) this.fitLook();
    else if (model.regions.every(({ id }) => isOutside(model, id))) this.changeShow({ outside: true });
  }

  /** Back to the look in which this mesh was first shown. */
  resetLook(): void {
    const { slices, sliceMode, explode, colorBy, show } = defaultSettings();
    this.change({ slices, sliceMode, explode, colorBy, show, camera: null }, false);
    this.fitLook();
  }

  private fitLook(): void {
    if (this.model) this.change(this.lookFor(this.model));
    if (!this.settings.camera) this.view.frame();
  }

  /**
   * The look to start with: a sheet with the edges of the cells around it, but without their grid-faces, which would hide it; few cells
   * without a slice. Planes that were moved stay.
   */
  private lookFor(model: Model): Pick<Settings, 'slices' | 'show'> {
    const sheet = isSheet(model);
    const { slices, show } = this.settings;
    const { free } = defaultSettings().slices;
    const isMoved = slices.free.position !== free.position || slices.free.normal.some((x, d) => x !== free.normal[d]);
    const on = isMoved ? slices.free.on : !sheet && model.counts.cutCells >= fewCells;
    return {
      slices: { ...slices, free: { ...slices.free, on } },
      show: { ...show, gridFaces: !sheet, untouched: !sheet, outside: sheet },
    };
  }

  /** Shows the default mesh, since a page without a picture is no use. */
  private async fallBack(error: PageError): Promise<void> {
    this.troubles.push(error);
    if ((await this.load(defaultSource)) !== 'loaded') return;
    const { source, grid, snapTolerance, pose } = defaultSettings();
    this.change({ source, grid, snapTolerance, pose, camera: null }, false);
    await this.recut(true);
  }

  /** Failures are shown in the end; the outcome is "superseded" if a newer mesh was asked for meanwhile. */
  private async load(source: Source): Promise<'loaded' | 'failed' | 'cancelled' | 'superseded'> {
    const load = ++this.loads;
    this.loading++;
    this.tellWork();
    try {
      const bytes = source.kind === 'file' ? await this.files.get(source.name)?.arrayBuffer() : undefined;
      if (load !== this.loads) return 'superseded';
      const mesh = await this.engine.load(source, bytes);
      if (load !== this.loads) return 'superseded';
      this.state.mesh.value = mesh;
      return 'loaded';
    } catch (error) {
      if (load !== this.loads) return 'superseded';
      if (isAbort(error)) return 'cancelled';
      this.failed = true;
      this.troubles.push(pageError(error));
      return 'failed';
    } finally {
      this.loading--;
      this.tellWork();
    }
  }

  private tellWork(): void {
    this.state.work.value = this.loading > 0 ? 'loading' : this.cuts > 0 ? 'cutting' : null;
    this.state.progress.value = null;
  }

  /** The page is busy until this and everything else is done. */
  private async during(task: () => Promise<void>): Promise<void> {
    if (this.work++ === 0) this.state.status.value = 'busy';
    this.failed = false;
    await task();
    if (--this.work > 0) return;
    for (const error of this.troubles.splice(0)) this.state.alert(error);
    this.state.status.value = this.failed ? 'error' : 'ready';
  }

  /** Changes how the model is shown. */
  change(part: Partial<Settings>, draw = true): void {
    this.state.settings.value = { ...this.settings, ...part };
    if (draw) this.view.setLook(this.settings);
  }

  changeSlice(name: SliceName, part: Partial<SliceSettings>): void {
    const { slices } = this.settings;
    this.change({ slices: { ...slices, [name]: { ...slices[name], ...part } } });
  }

  /** Flips a plane in place. */
  flip(name: SliceName): void {
    const { position, normal } = this.settings.slices[name];
    this.changeSlice(name, { position: 1 - position, normal: [-normal[0], -normal[1], -normal[2]] });
  }

  /** Moves the camera so that it sees the whole model. */
  fit(): void {
    this.view.frame();
    this.change({ camera: null }, false);
  }

  changeShow(part: Partial<Settings['show']>): void {
    this.change({ show: { ...this.settings.show, ...part } });
  }

  /** Where a wind blows nothing is pulled apart, unless the person does so then. */
  changeWind(part: Partial<Settings['wind']>): void {
    const wind = { ...this.settings.wind, ...part };
    this.change({ wind, ...(part.on ? { explode: { cells: 0, regions: 0 } } : {}) });
  }

  /** Resolves once this is drawn, or a newer cut has taken its place; false if it failed. */
  setGrid(grid: GridSettings): Promise<boolean> {
    return this.setCutting({ grid });
  }

  setSnapTolerance(snapTolerance: number): Promise<boolean> {
    return this.setCutting({ snapTolerance });
  }

  /** Cuts the mesh at a moment of a motion. */
  setPose(pose: Pose | null): Promise<boolean> {
    return this.setCutting({ pose });
  }

  private async setCutting(part: Partial<Cutting>): Promise<boolean> {
    this.change(part, false);
    return (await this.recut(false)) === null;
  }

  /** Cuts with the current settings; the engine makes the newest cut win. Resolves to what went wrong, if anything did. */
  private async recut(frame: boolean): Promise<PageError | null> {
    let problem: PageError | null = null;
    this.frameNext ||= frame;
    const { grid, snapTolerance, pose } = this.settings;
    const cutting = { grid, snapTolerance, pose };
    this.cuts++;
    this.tellWork();
    await this.during(async () => {
      try {
        this.takeModel(await this.engine.cut(cutting));
        this.failed = false;
        this.shown = { mesh: this.mesh, cutting };
        this.state.cutError.value = null;
        this.state.clearAlerts();
      } catch (error) {
        if (isAbort(error)) return;
        this.failed = true;
        problem = pageError(error);
        this.giveUp(problem);
      }
    });
    this.cuts--;
    this.tellWork();
    return problem;
  }

  private takeModel(model: Model): void {
    const { settings } = this;
    const { region } = settings.show;
    const isGone = region !== null && region >= model.counts.regions;
    batch(() => {
      this.state.model.value = model;
      this.state.hovered.value = null;
      if (isGone) this.state.settings.value = { ...settings, show: { ...settings.show, region: null } };
      if (this.fitNext) this.state.settings.value = { ...this.settings, ...this.lookFor(model) };
    });
    void this.pin(null);
    this.view.setModel(model, this.frameNext);
    this.fitNext = this.frameNext = false;
    this.view.setLook(this.settings);
    this.renewInstead();
  }

  /** Shows the same of the new cut; of another mesh, where that meets itself is another matter. */
  private renewInstead(): void {
    if (this.insteadKind !== 'crossings') {
      if (this.insteadKind) void this.step({ kind: this.insteadKind });
    } else if (this.shown.mesh === this.mesh) void this.showCrossings();
    else this.showModel();
  }

  /** There is no cut with these settings. A picture of the same mesh stays; one of another mesh would be mistaken for this one. */
  private giveUp(problem: PageError): void {
    if (this.model && this.shown.mesh !== this.mesh) {
      this.state.model.value = null;
      void this.pin(null);
      this.showModel();
      this.view.clear();
    }
    this.state.cutError.value = problem;
  }

  /** Stops what is under way and goes back to the settings of the picture, if that is of the same mesh. */
  cancel(): void {
    this.engine.cancel();
    const { mesh, cutting } = this.shown;
    if (this.mesh === mesh) this.change(cutting, false);
    else this.giveUp({ title: 'Cancelled', detail: 'This mesh has not been cut yet. Change its grid to cut it.' });
  }

  /** Pins a cell and fetches its card, or unpins it. */
  async pin(cell: number | null): Promise<void> {
    const pin = ++this.pins;
    this.pinned = cell !== null;
    this.view.setPinned(cell);
    const card = cell === null ? null : await this.ask(this.engine.card(cell));
    if (pin === this.pins && (card || cell === null)) this.state.pinned.value = card;
  }

  /** Shows a step of the algorithm instead of the model, or the model again. */
  async step(request: StepRequest | null): Promise<void> {
    if (request) await this.showInstead(request.kind, this.engine.step(request));
    else this.showModel();
  }

  /** Shows where the surface meets itself, instead of the model. */
  showCrossings(): Promise<void> {
    return this.showInstead('crossings', this.engine.crossings());
  }

  showModel(): void {
    this.insteads++;
    this.insteadKind = null;
    this.takeInstead(null);
  }

  private async showInstead(kind: Instead['kind'], answer: Promise<Instead>): Promise<void> {
    const asked = ++this.insteads;
    this.insteadKind = kind;
    const instead = await this.ask(answer);
    if (instead && asked === this.insteads) this.takeInstead(instead);
  }

  private takeInstead(instead: Instead | null): void {
    this.view.setInstead(instead);
    this.state.instead.value = instead;
  }

  /** Unpins the cell, or else goes back to the model. */
  leave(): void {
    if (this.pinned) void this.pin(null);
    else if (this.insteadKind) this.showModel();
  }

  validate(): Promise<Validation | null> {
    return this.ask(this.engine.validate());
  }

  countEdges(): Promise<number | null> {
    return this.ask(this.engine.countEdges());
  }

  write(format: 'json' | 'vtu' | 'obj'): Promise<Uint8Array | null> {
    return this.ask(this.engine.write(format));
  }

  /** Resolves to the answer, or to null after an alert. */
  async ask<T>(answer: Promise<T>): Promise<T | null> {
    try {
      const value = await answer;
      this.state.clearAlerts();
      return value;
    } catch (error) {
      if (!isAbort(error)) this.state.alert(pageError(error));
      return null;
    }
  }
}

function same(a: unknown, b: unknown): boolean {
  return JSON.stringify(a) === JSON.stringify(b);
}

function isAbort(error: unknown): boolean {
  return error instanceof Error && error.name === 'AbortError';
}

export function pageError(error: unknown): PageError {
  if (isPageError(error)) return error;
  return { title: 'Something went wrong', detail: error instanceof Error ? error.message : String(error) };
}

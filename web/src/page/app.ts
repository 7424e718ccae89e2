// The actions on the state of the page. Panels call them and read the state.
import { batch } from '@preact/signals';
import { presetOf, withoutPreset } from '../model/gallery/preset';
import type { Model } from '../model/cut_model';
import type { Engine, MeshInfo } from '../model/engine';
import { isAbort, pageError, type PageError } from '../model/failure';
import type { GridSettings } from '../model/grid_around';
import { defaultSettings, defaultSource, type Cutting, type Settings, type Source } from '../model/settings';
import { axes, axisNormal, type Axis, type SliceName, type SliceSettings } from '../model/slices';
import type { View } from '../model/view';
import { isOutside } from '../model/inside';
import { same } from '../model/same';
import { isSheet, usualColoring } from '../model/shown';
import type { Pose } from '../model/motion';
import { ask } from './ask';
import { Checking } from './checking';
import { Comparing } from './compare';
import { asPageError } from './failure';
import { Inspector } from './inspector';
import { Measuring } from './measuring';
import { Meshes } from './meshes';
import { Player } from './player';
import type { State } from './state';
import { WindTunnel } from './wind';
import { Work } from './work';

export class App {
  readonly player: Player;
  readonly windTunnel: WindTunnel;
  readonly checking: Checking;
  readonly comparing: Comparing;
  readonly inspector: Inspector;
  readonly measuring: Measuring;
  readonly meshes: Meshes;
  private readonly work: Work;
  /** Whether the next model needs a camera that sees all of it, or a look that suits it. */
  private frameNext = false;
  private fitNext = false;
  /** The colours that suited the last model, until others are chosen. */
  private usual = defaultSettings().colorBy;
  /** What the model was made of. */
  private shown: { cutting: Cutting; mesh: MeshInfo | null } = { cutting: defaultSettings(), mesh: null };

  constructor(
    private readonly engine: Engine,
    readonly view: View,
    readonly state: State,
  ) {
    this.player = new Player(this);
    this.work = new Work(state);
    this.meshes = new Meshes(engine, state, this.work);
    this.inspector = new Inspector(engine, view, state);
    engine.onProgress = (progress) => (state.progress.value = progress);
    view.onHover = (cell) => (state.hovered.value = cell);
    view.onPick = (cell) => void this.inspector.pin(cell);
    view.onSpent = (model) => engine.reuse(model);
    view.onTurned = (axes) => (state.axesSeen.value = axes);
    view.onCamera = (camera) => this.change({ camera }, false);
    this.windTunnel = new WindTunnel(state, engine, view);
    this.checking = new Checking(state, engine);
    this.comparing = new Comparing(state, engine, view);
    this.measuring = new Measuring(state, view);
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

  /** Loads a mesh and cuts it, with a file's bytes. If it can't be loaded, the page keeps the previous one. */
  async open(source: Source, bytes?: ArrayBuffer): Promise<void> {
    await this.work.during(async () => {
      const outcome = await this.meshes.load(source, bytes && new Blob([bytes]));
      if (outcome === 'failed') await this.cutAfterAll();
      if (outcome !== 'loaded') return;
      this.fitNext = true;
      this.change({ ...this.settingsToKeep(), source, snapTolerance: 0, pose: null, up: 'auto', camera: null }, false);
      await this.recut(true);
    });
  }

  /** Loading has ended the cut that was under way, so the picture may not be what the settings ask for. What is said of the mesh stays. */
  private async cutAfterAll(): Promise<void> {
    if (!this.mesh || this.isCut() || this.work.isDoing('cutting')) return;
    await this.recut(false);
    this.work.fail();
  }

  /** Another mesh is seen whole: its regions are others, and planes that sliced the last one are off. It has cubic cells. */
  private settingsToKeep(): Settings {
    this.usual = presetOf(this.settings.source)?.colorBy ?? this.usual;
    const { slices, show, grid, ...others } = withoutPreset(this.settings);
    const { x, y, z, free } = slices;
    const off = (slice: SliceSettings) => ({ ...slice, on: false });
    return {
      ...others,
      slices: { x: off(x), y: off(y), z: off(z), free: off(free) },
      show: { ...show, region: null },
      volumes: defaultSettings().volumes,
      grid: { cells: 'min' in grid ? Math.max(...grid.cells) : grid.cells },
    };
  }

  /** Applies all settings of a link. If its mesh can't be loaded, the previous or the default one takes its place. */
  async restore(settings: Settings): Promise<void> {
    await this.work.during(async () => {
      let source = this.meshes.canOpen(settings.source) ? settings.source : defaultSource;
      let outcome = this.isOpen(source) ? 'loaded' : await this.meshes.load(source);
      if (outcome === 'failed' || outcome === 'cancelled') {
        source = this.model ? this.settings.source : defaultSource;
        outcome = this.model ? 'loaded' : await this.meshes.load(source);
      }
      if (outcome !== 'loaded') return;
      this.change({ ...settings, source }, false);
      if (this.isCut()) return this.showAgain();
      const error = await this.recut(settings.camera === null);
      if (error && !this.model) await this.fallBack(error);
      else if (!error) this.showSomething();
    });
  }

  private isOpen(source: Source): boolean {
    return this.mesh !== null && !this.work.isDoing('loading') && same(source, this.settings.source);
  }

  /** Whether the model is what the settings ask for. */
  private isCut(): boolean {
    const { grid, snapTolerance, pose } = this.settings;
    return (
      this.model !== null &&
      !this.work.isDoing('cutting') &&
      this.shown.mesh === this.mesh &&
      same(this.shown.cutting, { grid, snapTolerance, pose })
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
    if (!model || this.shown.mesh !== this.mesh || settings.show.outside) return;
    if (isSheet(model) && same(settings.show, defaultSettings().show)) this.fitLook();
    else if (model.regions.every(({ id }) => isOutside(model, id))) this.changeShow({ outside: true });
  }

  /** Back to the look in which this mesh was first shown. */
  resetLook(): void {
    const { slices, sliceMode, explode, colorBy, show, volumes, up } = defaultSettings();
    this.usual = colorBy;
    this.change({ slices, sliceMode, explode, colorBy, show, volumes, up, camera: null }, false);
    this.fitLook();
  }

  private fitLook(): void {
    if (this.model) this.change(this.lookFor(this.model));
    if (!this.settings.camera) this.view.frame();
  }

  /**
   * The look to start with: a sheet with the edges of the cells around it, but without their grid-faces, which would hide it; several
   * regions in their colours. Colours that were chosen stay.
   */
  private lookFor(model: Model): Pick<Settings, 'show' | 'colorBy'> {
    const sheet = isSheet(model);
    const { show, colorBy } = this.settings;
    const isChosen = colorBy !== this.usual;
    this.usual = usualColoring(model);
    return {
      show: { ...show, gridFaces: !sheet, untouched: !sheet, outside: sheet },
      colorBy: isChosen ? colorBy : this.usual,
    };
  }

  /** Shows the default mesh, since a page without a picture is no use. */
  private async fallBack(error: PageError): Promise<void> {
    this.work.alertInTheEnd(error);
    if ((await this.meshes.load(defaultSource)) !== 'loaded') return;
    const { source, grid, snapTolerance, pose } = defaultSettings();
    this.change({ source, grid, snapTolerance, pose, camera: null }, false);
    await this.recut(true);
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

  /** Stands the model upright along another axis. */
  changeUp(up: Settings['up']): void {
    this.change({ up, camera: null });
    this.view.frame();
  }

  /** Flies the camera to where it looks from an axis, or from its other end if it does so already. */
  lookAlong(axis: Axis): void {
    const d = axes.indexOf(axis);
    const isThere = (this.state.axesSeen.value?.[d][2] ?? 0) > 0.999;
    this.view.lookFrom(axisNormal(axis, isThere ? -1 : 1));
  }

  changeShow(part: Partial<Settings['show']>): void {
    this.change({ show: { ...this.settings.show, ...part } });
  }

  /** Where a wind blows nothing is pulled apart, unless the person does so then. */
  changeWind(part: Partial<Settings['wind']>): void {
    const wind = { ...this.settings.wind, ...part };
    this.change({ wind, ...(part.on ? { explode: { cells: 0, regions: 0 } } : {}) });
  }

  /** Other ways than cut-cells can't be pulled apart: nothing is, unless the person does so then. */
  changeCompare(part: Partial<Settings['compare']>): void {
    const compare = { ...this.settings.compare, ...part };
    const isBegun = this.settings.compare.way === 'none' && compare.way !== 'none';
    this.change({ compare, ...(isBegun ? { explode: { cells: 0, regions: 0 } } : {}) });
  }

  /** A distance between cells that are pulled apart would look longer than it is. */
  toggleMeasure(): void {
    if (this.state.measurement.value) return this.measuring.end();
    if (!this.model) return;
    this.change({ explode: { cells: 0, regions: 0 } });
    this.measuring.begin();
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
    const { grid, snapTolerance, pose, slices, sliceMode } = this.settings;
    const cutting = { grid, snapTolerance, pose };
    const cut = async () => {
      try {
        this.takeModel(await this.engine.cut(cutting, { slices, sliceMode }));
        this.work.succeed();
        this.shown = { mesh: this.mesh, cutting };
        this.state.cutError.value = null;
        this.state.clearAlerts('mesh', 'answer');
      } catch (error) {
        if (isAbort(error)) return;
        this.work.fail();
        problem = asPageError(error);
        this.giveUp(problem);
      }
    };
    await this.work.doing('cutting', () => this.work.during(cut));
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
    void this.inspector.pin(null);
    this.view.setModel(model, this.frameNext);
    this.fitNext = this.frameNext = false;
    this.view.setLook(this.settings);
    this.inspector.renew(this.shown.mesh === this.mesh);
  }

  /** There is no cut with these settings. A picture of the same mesh stays; one of another mesh would be mistaken for this one. */
  private giveUp(problem: PageError): void {
    if (this.model && this.shown.mesh !== this.mesh) {
      this.state.model.value = null;
      void this.inspector.pin(null);
      this.inspector.showModel();
      this.view.clear();
    }
    this.state.cutError.value = problem;
  }

  /** Stops what is under way and goes back to the settings of the picture, if that is of the same mesh. */
  cancel(): void {
    this.engine.cancel();
    const { mesh, cutting } = this.shown;
    if (this.mesh === mesh) this.change(cutting, false);
    else this.giveUp(pageError('Cancelled', 'This mesh has not been cut yet. Change its grid to cut it.'));
  }

  countEdges(): Promise<number | null> {
    return ask(this.state, this.engine.countEdges());
  }

  write(format: 'json' | 'vtu' | 'obj'): Promise<Uint8Array | null> {
    return ask(this.state, this.engine.write(format));
  }

  writeMesh(): Promise<Uint8Array | null> {
    return ask(this.state, this.engine.writeMesh());
  }
}

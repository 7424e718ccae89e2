// The 3D view: puts the layers together, and draws when something has changed.
import { Group, Scene, type Object3D, type WebGLRenderer } from 'three';
import type { Engine, Instead, Model, PageError, Recording, Settings, View } from '../../model/types';
import type { Comparison } from '../../model/comparison';
import type { Wind } from '../../model/wind';
import { Camera } from './camera';
import { exportGlb } from './export';
import { FlatCuts } from './flat_cuts';
import { Framing } from './framing';
import { Halves } from './halves';
import type { Layer, Look } from './layer';
import { Caps } from './layers/caps';
import { CrossingCurves } from './layers/crossings';
import { CutCells } from './layers/cut_cells';
import { Frames } from './layers/frames';
import { Gizmo } from './layers/gizmo';
import { Shadow } from './layers/shadow';
import { Step } from './layers/step';
import { Untouched } from './layers/untouched';
import { regionShifts, shownRegions } from './look';
import { Loop } from './loop';
import { makeUniforms } from './material';
import { Picker } from './picking';
import { Pointer } from './pointer';
import { record } from './recorder';
import { makeRenderer } from './renderer';
import { setScheme } from './scheme';
import { keepCamera, sceneScale } from './scene_space';
import { WindTunnel } from './wind';
import { setUniforms } from './uniforms';

export interface ViewOptions {
  /** Makes the caps of flat cuts. */
  slice: Engine['slice'];
  /** Called when drawing fails: the graphics context is lost, or caps can't be made. */
  onError?: (error: PageError) => void;
}

/** In ms. */
const compileTime = 100;

/** Draws into the canvas, which fills its parent by CSS. Throws a PageError where there is no WebGL 2. */
export function createView(canvas: HTMLCanvasElement, options: ViewOptions): View {
  return new ThreeView(canvas, options);
}

class ThreeView implements View {
  onHover: View['onHover'] = () => {};
  onPick: View['onPick'] = () => {};
  onCamera: View['onCamera'] = () => {};
  onFreePlane: View['onFreePlane'] = () => {};
  onWind: View['onWind'] = () => {};
  private readonly renderer: WebGLRenderer;
  private readonly scene = new Scene();
  /** From the model's units to scene units. */
  private readonly root = new Group();
  private readonly uniforms = makeUniforms();
  private readonly cells = new CutCells(this.uniforms);
  private readonly untouched = new Untouched(this.uniforms);
  private readonly caps = new Caps(this.uniforms, this.cells);
  private readonly frames = new Frames();
  private readonly gizmo: Gizmo;
  private readonly shadow: Shadow;
  /** What is seen of the model, and what is seen instead of it. */
  private readonly ofModel: readonly Layer[] = [this.cells, this.untouched, this.caps, this.frames];
  private readonly ofInsteads: readonly Layer[] = [new Step(), new CrossingCurves(this.uniforms)];
  private readonly windTunnel: WindTunnel;
  private readonly layers: readonly Layer[];
  private readonly halves = new Halves(this.uniforms, objectsOf(this.ofModel));
  private readonly modelGroup = new Group().add(this.halves.object);
  private readonly insteadGroup = new Group().add(this.cells.ghost, ...objectsOf(this.ofInsteads));
  private readonly camera: Camera;
  private readonly framing: Framing;
  private readonly picker: Picker;
  private readonly loop: Loop;
  private readonly flatCuts: FlatCuts;
  private model: Model | null = null;
  private shifts: Float32Array = new Float32Array(0);
  private settings: Settings | null = null;
  private instead: Instead | null = null;
  private wind: Wind | null = null;
  private comparison: Comparison | null = null;
  private look: Look | null = null;
  /** What the looks of layers were made of. */
  private readonly made = new Map<Layer, readonly unknown[]>();
  private framesDrawn = 0;

  constructor(
    private readonly canvas: HTMLCanvasElement,
    private readonly options: ViewOptions,
  ) {
    this.renderer = makeRenderer(canvas);
    this.camera = new Camera(canvas, matchMedia('(prefers-reduced-motion: reduce)'));
    this.framing = new Framing(this.camera, () => {
      const { model, settings, shifts, instead } = this;
      return model && settings && { model, settings, shifts, instead };
    });
    this.gizmo = new Gizmo(this.camera.camera, canvas);
    this.windTunnel = new WindTunnel(this.uniforms, this.camera.camera, canvas);
    this.shadow = new Shadow(
      this.renderer,
      this.uniforms,
      this.ofModel.flatMap(({ caster }) => caster ?? []),
    );
    this.modelGroup.add(this.shadow.object);
    this.layers = [...this.ofModel, this.halves.otherWay, this.shadow, ...this.ofInsteads, this.windTunnel, this.gizmo];
    this.picker = new Picker(
      this.renderer,
      this.layers.flatMap(({ pick }) => pick ?? []),
    );
    this.flatCuts = new FlatCuts(options.slice);
    this.loop = new Loop(this.renderer.getContext() as WebGL2RenderingContext, {
      prepare: () => this.prepare(),
      isWaiting: () => this.flatCuts.isAwaited,
      draw: (seconds, share) => this.draw(seconds, share),
    });
    this.root.add(this.modelGroup, this.insteadGroup, this.windTunnel.object);
    this.scene.add(this.root, this.gizmo.object);
    this.modelGroup.visible = this.insteadGroup.visible = false;
    this.setScheme(matchMedia('(prefers-color-scheme: dark)').matches);
    this.listen();
    this.resize();
    this.warmUp();
  }

  /** Compiles all shaders while the first mesh is being cut: the compiler runs beside the page, then an empty draw picks up the results. */
  private warmUp(): void {
    this.renderer.compile(this.scene, this.camera.camera);
    this.shadow.compile();
    const takeOver = () => {
      if (this.model) return;
      this.modelGroup.visible = this.insteadGroup.visible = true;
      this.halves.render(this.renderer, this.scene, this.camera.camera);
      this.modelGroup.visible = this.insteadGroup.visible = false;
      void this.picker.pick(this.camera.camera, 0, 0);
      this.loop.invalidate();
    };
    setTimeout(takeOver, compileTime);
  }

  private listen(): void {
    for (const part of [this.camera, this.gizmo, this.shadow, this.frames]) part.onChange = () => this.loop.invalidate();
    this.framing.onMoved = (camera) => this.onCamera(camera);
    this.gizmo.onDragging = (isDragging) => (this.camera.controls.enabled = !isDragging);
    this.gizmo.onMoved = (free) => {
      if (!this.settings) return;
      this.settings = { ...this.settings, slices: { ...this.settings.slices, free } };
      this.loop.changed();
      this.onFreePlane(free);
    };
    this.windTunnel.onChange = () => this.loop.invalidate();
    this.windTunnel.onDragging = (isDragging) => (this.camera.controls.enabled = !isDragging);
    this.windTunnel.onTurned = (direction) => this.onWind(direction);
    this.flatCuts.onMade = () => this.loop.changed();
    this.flatCuts.onError = (error) => this.options.onError?.(error);
    const pointer = new Pointer(this.canvas, () => this.gizmo.isTouched || this.windTunnel.isTouched);
    // A GPU that is behind is asked once it has caught up.
    pointer.onHover = (at) => {
      this.loop.soon(at && (() => void this.cellAt(at).then((cell) => this.setHovered(cell))));
      if (!at) this.setHovered(null);
    };
    pointer.onTap = (at) => void this.cellAt(at).then((cell) => this.onPick(cell));
    pointer.onDoubleTap = (at) => void this.cellAt(at).then((cell) => this.framing.flyToCell(cell));
    this.canvas.addEventListener('keydown', (event) => {
      if (event.key === 'Escape') this.onPick(null);
    });
    new ResizeObserver(() => this.resize()).observe(this.canvas);
    this.canvas.addEventListener('webglcontextlost', () => this.tellContextLost());
    this.canvas.addEventListener('webglcontextrestored', () => this.loop.invalidate());
  }

  private tellContextLost(): void {
    this.loop.reset();
    const why = 'The browser dropped the graphics context, perhaps because memory ran low.';
    const detail = `${why} If the picture does not come back, reload the page.`;
    this.options.onError?.({ title: 'The picture is lost for now', detail });
  }

  setModel(model: Model, frame: boolean): void {
    this.loop.finish();
    if (frame) this.framing.forget();
    else if (this.model) keepCamera(this.camera, this.model, model);
    this.model = model;
    this.shifts = regionShifts(model);
    this.root.scale.setScalar(sceneScale(model));
    this.picker.root.scale.setScalar(sceneScale(model));
    this.uniforms.hovered.value = this.uniforms.pinned.value = -1;
    this.flatCuts.setModel(model);
    for (const layer of this.layers) layer.setModel?.(model);
    this.loop.changed();
  }

  clear(): void {
    this.model = null;
    this.look = null;
    this.uniforms.hovered.value = this.uniforms.pinned.value = -1;
    this.modelGroup.visible = this.insteadGroup.visible = this.windTunnel.object.visible = false;
    this.gizmo.hide();
    Object.assign(this.canvas.dataset, { model: '', cells: '0', untouched: '0', caps: '0' });
    this.onHover(null);
    this.loop.draw(); // At once: the previous model must not stay behind the words that replace it.
  }

  setLook(settings: Settings): void {
    this.settings = settings;
    this.framing.follow(settings);
    this.uniforms.up.value.copy(this.camera.camera.up);
    this.loop.changed();
  }

  setInstead(instead: Instead | null): void {
    const former = this.instead;
    this.instead = instead;
    this.framing.visitInstead(instead, former);
    this.loop.changed();
  }

  setWind(wind: Wind | null): void {
    this.wind = wind;
    this.loop.changed();
  }

  setComparison(comparison: Comparison | null): void {
    this.comparison = comparison;
    this.loop.changed();
  }

  setPinned(cell: number | null): void {
    this.uniforms.pinned.value = cell ?? -1;
    this.loop.invalidate();
  }

  setScheme(dark: boolean): void {
    setScheme(dark, this.scene, this.uniforms);
    this.gizmo.setColor(this.uniforms.accent.value);
    this.loop.invalidate();
  }

  frame(): void {
    this.framing.frame();
  }

  async png(): Promise<Blob> {
    const hadGizmo = this.gizmo.object.visible;
    this.loop.prepare();
    this.shadow.redraw();
    this.gizmo.object.visible = this.windTunnel.hasHandle = false;
    this.loop.draw();
    const blob = await new Promise<Blob | null>((resolve) => this.canvas.toBlob(resolve, 'image/png'));
    this.gizmo.object.visible = hadGizmo;
    this.windTunnel.hasHandle = true;
    this.loop.invalidate();
    if (blob) return blob;
    throw pictureError('The browser could not capture the picture, perhaps because memory ran low.');
  }

  async glb(): Promise<Blob> {
    this.loop.prepare();
    if (!this.look) throw pictureError('Nothing is shown yet.');
    return exportGlb(this.look, this.ofModel);
  }

  record(): Recording {
    return record(this.canvas);
  }

  private setHovered(cell: number | null): void {
    if (this.uniforms.hovered.value === (cell ?? -1)) return;
    this.uniforms.hovered.value = cell ?? -1;
    this.onHover(cell);
    this.loop.invalidate();
  }

  private async cellAt({ x, y }: { x: number; y: number }): Promise<number | null> {
    this.loop.prepare();
    if (!this.modelGroup.visible || this.halves.isOther(x, this.canvas)) return null;
    return this.picker.pick(this.camera.camera, x, y);
  }

  private resize(): void {
    const { clientWidth, clientHeight } = this.canvas;
    if (clientWidth === 0 || clientHeight === 0) return;
    this.renderer.setSize(clientWidth, clientHeight, false);
    this.camera.resize(clientWidth, clientHeight);
    this.loop.changed();
    this.loop.draw();
  }

  private setPixelRatio(ratio: number): void {
    if (this.renderer.getPixelRatio() === ratio) return;
    this.renderer.setPixelRatio(ratio);
    for (const layer of this.layers) layer.setPixelRatio?.(ratio);
  }

  private draw(seconds: number, share: number): boolean {
    this.setPixelRatio(share * Math.min(devicePixelRatio, 2));
    this.camera.update();
    const moving = this.layers.filter((layer) => layer.animate?.(seconds));
    this.halves.render(this.renderer, this.scene, this.camera.camera);
    this.canvas.dataset.frames = String(++this.framesDrawn);
    this.shadow.tellTests(this.canvas.dataset);
    return moving.length > 0;
  }

  /** Brings what is drawn up to date with the settings. Explosions and slices of whole cells only change uniforms. */
  private prepare(): void {
    const { model, settings, shifts, instead, wind, comparison } = this;
    if (!model || !settings) return;
    const look = {
      model,
      settings,
      regions: shownRegions(model, settings),
      shifts,
      instead,
      wind,
      comparison,
      ...this.flatCuts.choose(model, settings),
    };
    this.look = look;
    for (const layer of this.layers) {
      const needs = layer.dependsOn(look);
      const had = this.made.get(layer);
      if (had && needs.every((value, at) => Object.is(value, had[at]))) continue;
      this.made.set(layer, needs);
      layer.setLook(look);
    }
    this.halves.divider = comparison && settings.compare.divider;
    setUniforms(this.uniforms, look, this.canvas.clientHeight);
    this.modelGroup.visible = instead === null && !this.windTunnel.hidesModel;
    this.insteadGroup.visible = instead !== null;
    this.tellTests(look);
  }

  /** Says what is drawn, in data attributes of the canvas. */
  private tellTests(look: Look): void {
    const { dataset } = this.canvas;
    dataset.model = String(look.model.id);
    dataset.cells = String(this.cells.count(look));
    dataset.untouched = String(this.untouched.count);
    dataset.caps = String(this.caps.count);
    this.windTunnel.tellTests(dataset);
    this.shadow.tellTests(dataset);
    dataset.compare = look.comparison ? look.settings.compare.way : '';
    dataset.instead = look.instead?.kind ?? '';
  }
}

function objectsOf(layers: readonly Layer[]): Object3D[] {
  return layers.map(({ object }) => object);
}

function pictureError(detail: string): PageError {
  return { title: "The picture can't be saved", detail };
}

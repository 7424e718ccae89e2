// The 3D view: puts the layers together, and draws when something has changed.
import { Group, Scene, Vector3, type Object3D, type WebGLRenderer } from 'three';
import { shownRegions } from '../../model/shown';
import type { Model } from '../../model/cut_model';
import type { Engine } from '../../model/engine';
import type { PageError } from '../../model/failure';
import type { Instead } from '../../model/instead';
import type { Settings } from '../../model/settings';
import type { View } from '../../model/view';
import type { Comparison } from '../../model/comparison';
import type { Vector3 as ModelVector } from '../../model/vector';
import type { Measurement } from '../../model/measurement';
import type { SmokeSource, Wind } from '../../model/wind';
import { Camera } from './camera';
import { regionShifts } from './explosion';
import { Files } from './files';
import { FlatCuts } from './flat_cuts';
import { Framing } from './framing';
import { Halves } from './halves';
import { Inset } from './inset';
import type { Layer, Look } from './layer';
import { Caps } from './layers/caps';
import { CrossingCurves } from './layers/crossings';
import { CutCells } from './layers/cut_cells';
import { Frames } from './layers/frames';
import { Gizmo } from './layers/gizmo';
import { Marks } from './layers/marks';
import { Ruler } from './layers/ruler';
import { Shadow } from './layers/shadow';
import { Step } from './layers/step';
import { Untouched } from './layers/untouched';
import { Loop } from './loop';
import { makeUniforms } from './material';
import { Occlusion } from './occlusion';
import { Picker } from './picking';
import { reducedMotion } from './reduced_motion';
import { contextLost, makeRenderer } from './renderer';
import { setScheme } from './scheme';
import { Shaders } from './shaders';
import { sceneScale } from './scene_space';
import { Touch } from './touch';
import { WindTunnel } from './wind';
import { setUniforms } from './uniforms';

interface ViewOptions {
  /** Makes the caps of flat cuts. */
  slice: Engine['slice'];
  /** Called when drawing fails: caps can't be made. */
  onError?: (error: PageError) => void;
  /** Called when the graphics context is lost, and with null when it is there again. */
  onContext?: (problem: PageError | null) => void;
}

/** Draws into the canvas, which fills its parent by CSS. Throws a PageError where there is no WebGL 2. */
export function createView(canvas: HTMLCanvasElement, options: ViewOptions): View {
  return new ThreeView(canvas, options);
}

class ThreeView implements View {
  onHover: View['onHover'] = () => {};
  onPick: View['onPick'] = () => {};
  pictures = 0;
  onSpent: View['onSpent'] = () => {};
  onTurned: View['onTurned'] = () => {};
  onCamera: View['onCamera'] = () => {};
  onFreePlane: View['onFreePlane'] = () => {};
  onWind: View['onWind'] = () => {};
  onMeasured: View['onMeasured'] = () => {};
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
  private readonly ofModel: readonly Layer[] = [this.cells, this.untouched, this.caps, this.frames, new Marks(this.uniforms, this.cells)];
  private readonly step = new Step(this.uniforms);
  private readonly ofInsteads: readonly Layer[] = [this.step, new CrossingCurves(this.uniforms)];
  private readonly windTunnel: WindTunnel;
  private readonly ruler = new Ruler(this.uniforms);
  private readonly touch: Touch;
  private readonly inset: Inset;
  private readonly layers: readonly Layer[];
  private readonly halves = new Halves(this.uniforms, objectsOf(this.ofModel));
  private readonly modelGroup = new Group();
  private readonly insteadGroup = new Group().add(this.cells.ghost, ...objectsOf(this.ofInsteads));
  private readonly camera: Camera;
  private readonly framing: Framing;
  private readonly picker: Picker;
  private readonly occlusion: Occlusion;
  private readonly shaders: Shaders;
  private readonly loop: Loop;
  private readonly flatCuts: FlatCuts;
  readonly files: Files;
  private model: Model | null = null;
  /** Models before it that touches and files may still ask for. */
  private former: Model[] = [];
  private shifts: Float32Array = new Float32Array(0);
  private settings: Settings | null = null;
  private instead: Instead | null = null;
  private wind: Wind | null = null;
  private smoke: SmokeSource | null = null;
  private comparison: Comparison | null = null;
  private measurement: Measurement | null = null;
  private look: Look | null = null;
  /** What the looks of layers were made of. */
  private readonly made = new Map<Layer, readonly unknown[]>();

  constructor(
    private readonly canvas: HTMLCanvasElement,
    private readonly options: ViewOptions,
  ) {
    this.renderer = makeRenderer(canvas);
    this.inset = new Inset(this.renderer, this.scene, this.uniforms, this.step);
    this.camera = new Camera(canvas, reducedMotion());
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
    // What is transparent is drawn in this order: the shadow lies below all of the model.
    this.modelGroup.add(this.shadow.object, this.halves.object);
    this.layers = [...this.ofModel, this.halves.otherWay, this.shadow, ...this.ofInsteads, this.windTunnel, this.gizmo, this.ruler];
    this.picker = new Picker(
      this.renderer,
      this.layers.flatMap(({ pick }) => pick ?? []),
    );
    this.occlusion = new Occlusion(this.renderer, this.picker, this.camera.camera);
    this.flatCuts = new FlatCuts(options.slice);
    this.loop = new Loop(this.renderer.getContext() as WebGL2RenderingContext, {
      warmUp: () => !this.shaders.areReadyAhead(this.pictures > 0),
      hasShaders: () => this.shaders.areReady(),
      hasShadersBeside: () => this.shaders.areReadyToPick(),
      prepare: () => this.prepare(),
      isWaiting: () => this.flatCuts.isAwaited,
      draw: (seconds, share) => this.draw(seconds, share),
      stand: (took) => {
        this.occlusion.stand(this.look, took);
        return this.look !== null;
      },
    });
    const { renderer, scene, loop, ofModel, caps, shadow, gizmo, windTunnel, uniforms, camera, framing, picker, halves } = this;
    this.touch = new Touch({
      ...{ canvas, uniforms, camera, framing, loop, picker, halves, ofModel },
      look: () => (this.modelGroup.visible && this.pictures > 0 ? this.look : null),
      isTaken: () => gizmo.isTouched || windTunnel.isTouched,
    });
    this.files = new Files({
      ...{ renderer, scene, loop, ofModel, caps, shadow, gizmo, windTunnel },
      slice: options.slice,
      look: () => this.look,
      draw: (times) => this.draw(performance.now() / 1000, times),
    });
    this.root.add(this.modelGroup, this.insteadGroup, this.occlusion.object, this.windTunnel.object, this.ruler.object);
    this.scene.add(this.root, this.gizmo.object);
    this.shaders = new Shaders(renderer, camera.camera, { scene, first: objectsOf([this.cells, this.untouched, shadow]), shadow, picker });
    this.modelGroup.visible = this.insteadGroup.visible = this.ruler.object.visible = false;
    this.setScheme(matchMedia('(prefers-color-scheme: dark)').matches);
    this.listen();
    this.resize();
  }

  private listen(): void {
    for (const part of [this.camera, this.gizmo, this.shadow, this.frames, this.occlusion]) part.onChange = () => this.loop.invalidate();
    this.camera.onTurned = (axes) => this.onTurned(axes);
    this.framing.onMoved = (camera) => this.onCamera(camera);
    this.gizmo.onDragging = (isDragging) => (this.camera.controls.enabled = !isDragging);
    this.gizmo.onMoved = (free) => {
      if (!this.settings) return;
      this.settings = { ...this.settings, slices: { ...this.settings.slices, free } };
      this.loop.changed();
      this.onFreePlane(free);
    };
    this.windTunnel.onChange = () => this.loop.changed();
    this.windTunnel.onDragging = (isDragging) => (this.camera.controls.enabled = !isDragging);
    this.windTunnel.onTurned = (direction) => this.onWind(direction);
    this.flatCuts.onMade = () => this.loop.changed();
    this.flatCuts.onError = (error) => this.options.onError?.(error);
    this.touch.onHover = (cell) => this.onHover(cell);
    this.touch.onPick = (cell) => this.onPick(cell);
    this.touch.onMeasured = (place) => this.onMeasured(place);
    new ResizeObserver(() => this.resize()).observe(this.canvas);
    this.canvas.addEventListener('webglcontextlost', () => {
      this.shaders.forget();
      this.options.onContext?.(contextLost());
    });
    this.canvas.addEventListener('webglcontextrestored', () => {
      this.loop.reset();
      this.shadow.forget();
      this.options.onContext?.(null);
      this.loop.changed();
    });
  }

  setModel(model: Model, frame: boolean): void {
    this.loop.finish();
    if (frame) this.framing.forget();
    else if (this.model) this.framing.keep(this.model, model);
    if (this.model) this.former.push(this.model);
    this.model = model;
    this.shifts = regionShifts(model);
    this.root.scale.setScalar(sceneScale(model));
    this.picker.root.scale.setScalar(sceneScale(model));
    this.forgetCells();
    this.flatCuts.setModel(model);
    for (const layer of this.layers) layer.setModel?.(model);
    this.loop.changed();
  }

  clear(): void {
    this.model = this.look = null;
    this.former = [];
    this.forgetCells();
    for (const object of [this.modelGroup, this.insteadGroup, this.windTunnel.object, this.ruler.object]) object.visible = false;
    this.gizmo.hide();
    Object.assign(this.canvas.dataset, { model: '', cells: '0', untouched: '0', caps: '0' });
    this.onHover(null);
    this.loop.draw(); // At once: the previous model must not stay behind the words that replace it.
  }

  private forgetCells(): void {
    this.touch.forget();
    this.uniforms.pinned.value = -1;
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

  setSmoke(smoke: SmokeSource | null): void {
    this.smoke = smoke;
    this.loop.changed();
  }

  setMeasurement(measurement: Measurement | null): void {
    this.measurement = measurement;
    this.touch.isMeasuring = measurement !== null;
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

  lookFrom(direction: ModelVector): void {
    this.camera.lookFrom(new Vector3(...direction));
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
    if (this.renderer.getContext().isContextLost()) return false;
    this.setPixelRatio(share * Math.min(devicePixelRatio, 2));
    this.camera.update();
    const moving = this.layers.filter((layer) => layer.animate?.(seconds));
    const isAppearing = this.occlusion.animate(this.look);
    this.halves.render(this.renderer, this.scene, this.camera.camera);
    this.inset.render(this.look, this.camera.camera);
    if (this.look) ++this.pictures;
    this.canvas.dataset.frames = String(Number(this.canvas.dataset.frames ?? 0) + 1);
    this.shadow.tellTests(this.canvas.dataset);
    return isAppearing || moving.length > 0;
  }

  /** Brings what is drawn up to date with the settings. Explosions and slices of whole cells only change uniforms. */
  private prepare(): void {
    const { model, settings, shifts, instead, wind, smoke, comparison, measurement } = this;
    if (!model || !settings) return;
    const look = {
      model,
      settings,
      regions: shownRegions(model, settings),
      shifts,
      instead,
      wind,
      smoke,
      comparison,
      measurement,
      ...this.flatCuts.choose(model, settings),
    };
    this.look = look;
    for (const former of this.former.splice(0)) this.onSpent(former);
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

// The 3D view: puts the parts together and draws when something has changed.
import { Color, Group, Scene, Vector3, Vector4, WebGLRenderer } from 'three';
import type { Slice } from 'mandoline-wasm';
import type { Engine, Model, PageError, Settings, StepPicture, View } from '../../model/types';
import { Camera } from './camera';
import { Caps } from './caps';
import { CutCells } from './cut_cells';
import { exportGlb } from './export';
import { shownBall } from './extent';
import { Frames } from './frames';
import { Gizmo } from './gizmo';
import { GpuPace } from './gpu_pace';
import { shownRegions } from './look';
import { makeUniforms } from './material';
import type { Piece } from './piece';
import { Picker } from './picking';
import { activePlanes, planeOf, reach, type ViewPlane } from './planes';
import { Pointer } from './pointer';
import { Step } from './step';
import { Untouched } from './untouched';

export interface ViewOptions {
  /** Makes the caps of flat cuts. */
  slice: Engine['slice'];
  /** Called when drawing fails: the graphics context is lost, or caps can't be made. */
  onError?: (error: PageError) => void;
}

/** The answer to a request for slices. */
interface Slices {
  count: number;
  model: number;
  planes: ViewPlane[];
  slices: Slice[];
}

const noSlices: Slices = { count: 0, model: 0, planes: [], slices: [] };

/** In ms. */
const longestWait = 400;
const compileTime = 100;

/** About so many cells share an edge, each of which draws it. */
const cellsPerEdge = 2.8;

const schemes = {
  light: { background: '#f3f1ec', line: '#1c2430', accent: '#e0218a' },
  dark: { background: '#14181e', line: '#5b6675', accent: '#ff4fa8' },
};

/** Draws into the canvas, which fills its parent by CSS. Throws a PageError where there is no WebGL 2. */
export function createView(canvas: HTMLCanvasElement, options: ViewOptions): View {
  return new ThreeView(canvas, options);
}

class ThreeView implements View {
  onHover: View['onHover'] = () => {};
  onPick: View['onPick'] = () => {};
  onCamera: View['onCamera'] = () => {};
  onFreePlane: View['onFreePlane'] = () => {};
  private readonly renderer: WebGLRenderer;
  private readonly pace: GpuPace;
  private readonly scene = new Scene();
  /** From the model's units to scene units. */
  private readonly root = new Group();
  private readonly modelGroup = new Group();
  private readonly uniforms = makeUniforms();
  private readonly cells = new CutCells(this.uniforms);
  private readonly untouched = new Untouched(this.uniforms);
  private readonly caps = new Caps(this.uniforms);
  private readonly frames = new Frames();
  private readonly stepPicture = new Step();
  private readonly camera: Camera;
  private readonly gizmo: Gizmo;
  private readonly picker: Picker;
  private model: Model | null = null;
  private settings: Settings | null = null;
  private step: StepPicture | null = null;
  private regions: Uint8Array = new Uint8Array(0);
  /** The planes that cut what is drawn. A flat cut keeps the previous ones until new caps arrive, so that no picture lacks them. */
  private planes: ViewPlane[] = [];
  private slices: Slices | null = null;
  private slicesMade = 0;
  private modelSince = 0;
  private readonly keys = new Map<string, string>();
  private isSlicing = false;
  private cameraKnown = '';
  private cameraBeforeStep: { position: Vector3; target: Vector3; isFramed: boolean } | null = null;
  private isFramed = false;
  private hoverAt: { x: number; y: number } | null = null;
  private isLookStale = true;
  /** Whether the look is up to date and waits to be drawn. */
  private isLookNew = false;
  private frameAsked = 0;
  private framesDrawn = 0;

  constructor(
    private readonly canvas: HTMLCanvasElement,
    private readonly options: ViewOptions,
  ) {
    this.renderer = makeRenderer(canvas);
    this.pace = new GpuPace(this.renderer.getContext() as WebGL2RenderingContext);
    this.camera = new Camera(canvas, matchMedia('(prefers-reduced-motion: reduce)'));
    this.gizmo = new Gizmo(this.camera.camera, canvas);
    this.picker = new Picker(this.renderer, [this.cells.pick, this.untouched.pick, this.caps.pick]);
    this.modelGroup.add(this.cells.group, this.untouched.group, this.caps.group, this.frames.group);
    this.root.add(this.modelGroup, this.cells.ghost, this.stepPicture.group);
    this.scene.add(this.root, this.gizmo.group);
    this.cells.ghost.visible = this.stepPicture.group.visible = this.modelGroup.visible = false;
    this.setScheme(matchMedia('(prefers-color-scheme: dark)').matches);
    this.listen();
    this.resize();
    this.warmUp();
  }

  /** Compiles all shaders while the first mesh is being cut: the compiler runs beside the page, then an empty draw picks up the results. */
  private warmUp(): void {
    this.renderer.compile(this.scene, this.camera.camera);
    const takeOver = () => {
      if (this.model) return;
      const hidden = [this.modelGroup, this.cells.ghost, this.stepPicture.group];
      for (const object of hidden) object.visible = true;
      this.renderer.render(this.scene, this.camera.camera);
      for (const object of hidden) object.visible = false;
      void this.picker.pick(this.camera.camera, 0, 0);
      this.invalidate();
    };
    setTimeout(takeOver, compileTime);
  }

  private listen(): void {
    this.camera.onChange = () => this.invalidate();
    this.camera.onMoved = () => this.tellCamera();
    this.gizmo.onChange = () => this.invalidate();
    this.gizmo.onDragging = (isDragging) => (this.camera.controls.enabled = !isDragging);
    this.gizmo.onMoved = (normal, point) => this.moveFreePlane(normal, point);
    const pointer = new Pointer(this.canvas, () => this.gizmo.isTouched);
    pointer.onHover = (at) => this.hover(at);
    pointer.onTap = (at) => void this.cellAt(at).then((cell) => this.onPick(cell));
    this.canvas.addEventListener('keydown', (event) => {
      if (event.key === 'Escape') this.onPick(null);
    });
    new ResizeObserver(() => this.resize()).observe(this.canvas);
    this.canvas.addEventListener('webglcontextlost', () => this.tellContextLost());
    this.canvas.addEventListener('webglcontextrestored', () => this.invalidate());
  }

  private tellContextLost(): void {
    this.pace.reset();
    const why = 'The browser dropped the graphics context, perhaps because memory ran low.';
    const detail = `${why} If the picture does not come back, reload the page.`;
    this.options.onError?.({ title: 'The picture is lost for now', detail });
  }

  setModel(model: Model, frame: boolean): void {
    const scale = 2 / model.diagonal;
    if (this.model && !frame) this.keepCamera(this.model, model);
    this.model = model;
    this.root.scale.setScalar(scale);
    this.picker.root.scale.setScalar(scale);
    this.cells.setModel(model);
    this.uniforms.hovered.value = this.uniforms.pinned.value = -1;
    this.lookChanged();
    this.modelSince = performance.now();
    this.isLookNew = false; // The former model's look would hide this one.
    // At once, so that it runs before the next cut.
    if (this.settings?.sliceMode === 'flat' && activePlanes(model, this.settings).length > 0) void this.requestSlices();
    if (frame) this.isFramed = false;
  }

  clear(): void {
    this.model = null;
    this.uniforms.hovered.value = this.uniforms.pinned.value = -1;
    this.modelGroup.visible = this.cells.ghost.visible = this.stepPicture.group.visible = false;
    this.gizmo.hide();
    Object.assign(this.canvas.dataset, { model: '', cells: '0', untouched: '0', caps: '0' });
    this.onHover(null);
    this.draw(); // At once: the previous model must not stay behind the words that replace it.
  }

  /** Another grid has another centre and size; the camera keeps looking at the same place. */
  private keepCamera(from: Model, to: Model): void {
    const move = (point: Vector3) => {
      const world = point.clone().multiplyScalar(from.diagonal / 2);
      return world
        .add(new Vector3(...from.origin))
        .sub(new Vector3(...to.origin))
        .multiplyScalar(2 / to.diagonal);
    };
    const isSame = from.diagonal === to.diagonal && from.origin.every((x, d) => x === to.origin[d]);
    if (!isSame) this.camera.transform(move, from.diagonal / to.diagonal);
  }

  setLook(settings: Settings): void {
    this.settings = settings;
    const { camera } = settings;
    if (camera && this.model && JSON.stringify(camera) !== this.cameraKnown) {
      this.cameraKnown = JSON.stringify(camera);
      this.isFramed = true;
      this.camera.place(this.toScene(camera.position), this.toScene(camera.target));
    }
    const isPulled = this.hasChanged('explosion', [settings.explode, settings.explode.regions > 0 && this.model?.id]);
    if (!this.isFramed) this.frame();
    // Until the person moves the camera, exploded parts stay in view.
    else if (isPulled && this.camera.isFramed && !this.step) this.frameShown(true);
    this.lookChanged();
  }

  private lookChanged(): void {
    this.isLookStale = true;
    this.invalidate();
  }

  setStep(picture: StepPicture | null): void {
    const isNew = JSON.stringify(picture?.choices.request) !== JSON.stringify(this.step?.choices.request);
    this.step = picture;
    if (picture) {
      this.stepPicture.set(picture);
      const { camera, controls } = this.camera;
      this.cameraBeforeStep ??= { position: camera.position.clone(), target: controls.target.clone(), isFramed: this.camera.isFramed };
      if (isNew) this.camera.frame(this.fromModel(picture.center), picture.radius * this.root.scale.x * 1.2, true);
    } else if (this.cameraBeforeStep) {
      const { position, target, isFramed } = this.cameraBeforeStep;
      this.camera.place(position, target);
      if (isFramed) this.frameShown(true);
      this.cameraBeforeStep = null;
    }
    this.lookChanged();
  }

  setPinned(cell: number | null): void {
    this.uniforms.pinned.value = cell ?? -1;
    this.invalidate();
  }

  setScheme(dark: boolean): void {
    const scheme = dark ? schemes.dark : schemes.light;
    this.scene.background = new Color(scheme.background);
    this.uniforms.lineColor.value.set(scheme.line);
    this.uniforms.accent.value.set(scheme.accent);
    this.invalidate();
  }

  frame(): void {
    if (!this.model) return;
    this.isFramed = true;
    this.cameraKnown = '';
    this.frameShown(false);
  }

  private frameShown(keepDirection: boolean): void {
    const { model, settings } = this;
    if (!model || !settings) return;
    const { center, radius } = shownBall(model, settings, this.cells.shifts);
    this.camera.frame(this.fromModel(center), radius * this.root.scale.x, keepDirection);
  }

  async png(): Promise<Blob> {
    const hadGizmo = this.gizmo.group.visible;
    this.gizmo.group.visible = false;
    this.draw();
    const blob = await new Promise<Blob | null>((resolve) => this.canvas.toBlob(resolve, 'image/png'));
    this.gizmo.group.visible = hadGizmo;
    this.invalidate();
    if (blob) return blob;
    throw pictureError('The browser could not capture the picture, perhaps because memory ran low.');
  }

  async glb(): Promise<Blob> {
    const { model, settings, cells } = this;
    if (!model || !settings) throw pictureError('Nothing is shown yet.');
    this.updateLook();
    const cutCells = { forEachPiece: (take: (piece: Piece) => void) => cells.forEachPiece(model, settings, take) };
    return exportGlb({ model, settings, planes: this.planes, shifts: cells.shifts, parts: [cutCells, this.untouched, this.caps] });
  }

  private fromModel(point: readonly number[]): Vector3 {
    return new Vector3(point[0], point[1], point[2]).multiplyScalar(this.root.scale.x);
  }

  private toScene(world: readonly number[]): Vector3 {
    return this.fromModel(world.map((x, d) => x - (this.model?.origin[d] ?? 0)));
  }

  private tellCamera(): void {
    const { model } = this;
    if (!model || this.step) return;
    const toWorld = (point: Vector3) => {
      const [x, y, z] = point.toArray().map((value, d) => value / this.root.scale.x + model.origin[d]);
      return [x, y, z] as const;
    };
    const camera = { position: toWorld(this.camera.camera.position), target: toWorld(this.camera.controls.target) };
    this.cameraKnown = JSON.stringify(camera);
    this.onCamera(camera);
  }

  private moveFreePlane(normal: Vector3, point: Vector3): void {
    const { model, settings } = this;
    if (!model || !settings) return;
    const scale = this.root.scale.x * (1 + settings.explode.cells);
    const position = (normal.dot(point) / scale / reach(model, normal.toArray()) + 1) / 2;
    const free = { on: true, position: Math.max(0, Math.min(1, position)), normal: normal.toArray() };
    this.settings = { ...settings, slices: { ...settings.slices, free } };
    this.lookChanged();
    this.onFreePlane(free);
  }

  private hover(at: { x: number; y: number } | null): void {
    this.hoverAt = at;
    if (!at) return this.setHovered(null);
    // A GPU that is behind is asked once it has caught up.
    if (this.pace.isBehind) return this.invalidate();
    this.hoverAt = null;
    void this.cellAt(at).then((cell) => this.setHovered(cell));
  }

  private setHovered(cell: number | null): void {
    if (this.uniforms.hovered.value === (cell ?? -1)) return;
    this.uniforms.hovered.value = cell ?? -1;
    this.onHover(cell);
    this.invalidate();
  }

  private async cellAt({ x, y }: { x: number; y: number }): Promise<number | null> {
    if (!this.model || this.step) return null;
    this.updateLook();
    return this.picker.pick(this.camera.camera, x, y);
  }

  private invalidate(): void {
    if (this.frameAsked === 0) this.frameAsked = requestAnimationFrame(() => this.drawInTime());
  }

  private drawInTime(): void {
    this.frameAsked = 0;
    if (this.pace.isBehind) this.invalidate();
    else if (this.hoverAt) {
      this.hover(this.hoverAt);
      this.invalidate();
    } else if (this.isLookStale && !this.isLookNew) this.prepare();
    else if (this.lacksCaps) this.invalidate();
    else this.render();
  }

  /** Preparing and drawing are separate tasks, so that the page never waits for both at once. */
  private prepare(): void {
    this.updateLook();
    this.isLookNew = true;
    this.invalidate();
  }

  /** The previous picture stays while the caps of a new model are on their way, but not for long. */
  private get lacksCaps(): boolean {
    return this.isSlicing && this.slices?.model !== this.model?.id && performance.now() - this.modelSince < longestWait;
  }

  private resize(): void {
    const { clientWidth, clientHeight } = this.canvas;
    if (clientWidth === 0 || clientHeight === 0) return;
    const ratio = Math.min(devicePixelRatio, 2);
    this.renderer.setPixelRatio(ratio);
    this.renderer.setSize(clientWidth, clientHeight, false);
    this.camera.resize(clientWidth, clientHeight);
    this.stepPicture.setPixelRatio(ratio);
    this.isLookStale = true;
    this.draw();
  }

  private draw(): void {
    cancelAnimationFrame(this.frameAsked);
    this.frameAsked = 0;
    this.updateLook();
    this.render();
  }

  private render(): void {
    this.isLookNew = false;
    this.camera.update();
    this.renderer.render(this.scene, this.camera.camera);
    this.pace.mark();
    this.canvas.dataset.frames = String(++this.framesDrawn);
    if (this.isLookStale) this.invalidate();
  }

  /** Brings what is drawn up to date with the settings. */
  private updateLook(): void {
    const { model, settings } = this;
    const wasStale = this.isLookStale;
    this.isLookStale = false;
    if (!model || !settings || !wasStale) return;
    this.regions = shownRegions(model, settings);
    const { show, colorBy, sliceMode } = settings;
    const isFlat = sliceMode === 'flat';
    // Explosions and slices of whole cells only change uniforms; other parts are computed again if something they depend on has changed.
    if (this.hasChanged('cells', [model.id, show, colorBy])) this.cells.setLook(model, settings, this.regions);
    const slices = this.choosePlanes(model, settings);
    if (this.hasChanged('caps', [model.id, show, colorBy, slices.count])) {
      this.caps.set(model, settings, this.regions, this.cells, slices.slices);
    }
    if (this.hasChanged('untouched', [model.id, show, colorBy, isFlat, this.planes, settings.explode.cells > 0])) {
      this.untouched.setLook(model, settings, this.regions, this.planes);
    }
    this.setUniforms(model, settings);
    this.modelGroup.visible = this.step === null;
    this.cells.ghost.visible = this.stepPicture.group.visible = this.step !== null;
    this.frames.set(model, this.planes);
    this.frames.group.scale.setScalar(1 + settings.explode.cells);
    this.placeGizmo(model, settings);
    this.tellTests(model, isFlat);
  }

  /** Sets the planes, and gives the slices to draw as caps. */
  private choosePlanes(model: Model, settings: Settings): Slices {
    const wanted = activePlanes(model, settings);
    const isFlat = settings.sliceMode === 'flat';
    const made = this.slices?.model === model.id ? this.slices : null;
    if (isFlat && wanted.length > 0 && !(made && samePlanes(made.planes, wanted))) void this.requestSlices();
    this.planes = isFlat && wanted.length > 0 && made ? made.planes : wanted;
    return isFlat && wanted.length > 0 && made ? made : noSlices;
  }

  /** Whether something that a part depends on has changed since the last call. */
  private hasChanged(part: string, dependsOn: unknown[]): boolean {
    const key = JSON.stringify(dependsOn);
    const isNew = this.keys.get(part) !== key;
    this.keys.set(part, key);
    return isNew;
  }

  /** One request at a time: after its answer, the planes wanted by then are asked for. */
  private async requestSlices(): Promise<void> {
    const { model, settings } = this;
    if (this.isSlicing || !model || !settings) return;
    this.isSlicing = true;
    const planes = activePlanes(model, settings);
    const toWorld = ({ normal, offset }: ViewPlane) => normal.reduce((sum, n, d) => sum + n * model.origin[d], offset);
    const inWorld = planes.map((plane) => ({ normal: plane.normal, offset: toWorld(plane) }));
    try {
      const slices = await this.options.slice(inWorld, true);
      this.slices = { count: ++this.slicesMade, model: model.id, planes, slices };
    } catch (error) {
      // Without caps, cells are seen cut open. The same planes aren't asked for again, or failures would go on for ever.
      this.slices = { count: ++this.slicesMade, model: model.id, planes, slices: [] };
      if (!(error instanceof DOMException)) this.options.onError?.(error as PageError);
    }
    this.isSlicing = false;
    this.lookChanged();
  }

  private setUniforms(model: Model, settings: Settings): void {
    const { uniforms, planes } = this;
    uniforms.explodeCells.value = settings.explode.cells;
    uniforms.explodeRegions.value = settings.explode.regions;
    uniforms.planeCount.value = planes.length;
    planes.forEach(({ normal, offset }, p) => (uniforms.planes.value[p] = new Vector4(...normal, offset)));
    uniforms.flatCut.value = settings.sliceMode === 'flat';
    uniforms.byKind.value = settings.colorBy === 'kind';
    // So many lines that they fill the picture would only darken it.
    const pixelsPerEdge = (this.canvas.clientWidth * this.canvas.clientHeight * cellsPerEdge) / (model.edges.index.length / 2);
    uniforms.lineOpacity.value = 0.5 * Math.min(1, Math.max(0.3, Math.sqrt(pixelsPerEdge / 20)));
  }

  private placeGizmo(model: Model, settings: Settings): void {
    if (!settings.slices.free.on || this.step) return this.gizmo.hide();
    const { normal, offset } = planeOf(model, settings, 'free');
    const direction = new Vector3(...normal);
    this.gizmo.show(direction, direction.clone().multiplyScalar(offset * this.root.scale.x * (1 + settings.explode.cells)));
  }

  /** Says what is drawn, in data attributes of the canvas. */
  private tellTests(model: Model, isFlat: boolean): void {
    const { dataset } = this.canvas;
    dataset.model = String(model.id);
    dataset.cells = String(this.cells.count(model, this.planes, isFlat));
    dataset.untouched = String(this.untouched.count);
    dataset.caps = String(this.caps.count);
    dataset.step = this.step?.kind ?? '';
  }
}

function samePlanes(a: readonly ViewPlane[], b: readonly ViewPlane[]): boolean {
  return JSON.stringify(a) === JSON.stringify(b);
}

function pictureError(detail: string): PageError {
  return { title: "The picture can't be saved", detail };
}

function makeRenderer(canvas: HTMLCanvasElement): WebGLRenderer {
  try {
    const renderer = new WebGLRenderer({ canvas, antialias: true, powerPreference: 'high-performance' });
    // Asking for errors would wait for the compiler.
    renderer.debug.checkShaderErrors = import.meta.env.DEV;
    // Transparent objects are drawn last anyway, and to sort them three.js would visit all vertices.
    renderer.sortObjects = false;
    return renderer;
  } catch {
    const why = 'This page draws with WebGL 2, which this browser lacks or has turned off.';
    const detail = `${why} Try another browser, or turn on hardware acceleration in its settings.`;
    const error: PageError = { title: 'This browser cannot draw the picture', detail };
    throw error;
  }
}

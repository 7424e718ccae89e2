// The page's half of the work: asks the package's worker, whose thread keeps meshes and cut-meshes. A new thread gets back what the former
// one had.
import { createWorker } from 'mandoline-wasm/worker';
import type { Slice } from 'mandoline-wasm';
import type { Vector3 } from '../model/vector';
import { isOutdated, type CallName, type Calls, type LoadedMesh, type Recipe } from '../model/calls';
import type { CellCard, Model } from '../model/cut_model';
import type { Engine, MeshInfo } from '../model/engine';
import { pageError, type PageError } from '../model/failure';
import type { Crossings, StepPicture, StepRequest } from '../model/instead';
import type { Cutting, Slicing, Source } from '../model/settings';
import type { Checks } from '../model/checks';
import type { Comparison, OtherGridWay } from '../model/comparison';
import type { Smoke, SmokeState, Wind, WindFormat } from '../model/wind';
import { abortError } from './failure';
import { Newest } from './newest';
import { Thread, type CallOptions } from './thread';
import { WindEngine } from './wind_engine';

/** Of those that share a large cut. One of the machine's is left for the page. */
const threads = Math.min(Math.max(navigator.hardwareConcurrency - 1, 1), 4);
/** Corners of triangles that are drawn of a cut whose memory is worth getting back. */
const largeCut = 3_000_000;

class WorkerEngine implements Engine {
  onProgress: Engine['onProgress'] = () => {};
  private readonly thread: Thread;
  private readonly tunnel: WindEngine;
  private readonly cuts = new Newest(this.cutNow.bind(this));
  private meshes = 0;
  private recipes = 0;
  /** The newest mesh, and that of the Model that is shown. */
  private readonly kept = new Map<number, LoadedMesh>();
  private mesh: LoadedMesh | null = null;
  private shown: Recipe | null = null;
  private loading: AbortController | null = null;
  /** Settles with the newest load. */
  private loaded: Promise<unknown> = Promise.resolve();
  /** Of all cuts by the present thread. */
  private largestCut = 0;

  constructor() {
    const meshOf = (id: number) => this.kept.get(id);
    const thread = () => new Worker(new URL('../worker/thread.ts', import.meta.url), { type: 'module' });
    this.thread = new Thread(() => createWorker({ thread, threads }), meshOf);
    this.tunnel = new WindEngine(meshOf);
    void this.thread.start().catch(() => {}); // The first call tries again and says what is wrong.
  }

  load(source: Source, bytes?: ArrayBuffer): Promise<MeshInfo> {
    this.cancel();
    this.loading = new AbortController();
    const mesh = this.loadNow({ id: ++this.meshes, source, bytes }, this.loading.signal);
    this.loaded = mesh.catch(() => {});
    return mesh;
  }

  private async loadNow(ask: Calls['load']['ask'], signal: AbortSignal): Promise<MeshInfo> {
    const mesh = await this.call('load', ask, { signal, transfer: ask.bytes ? [ask.bytes] : [] });
    this.mesh = mesh;
    this.keep(mesh);
    return { name: mesh.name, triangles: mesh.triangles.length / 3, bounds: mesh.bounds };
  }

  loadAhead(): Promise<void> {
    return Promise.all([this.call('loadAhead', null), this.tunnel.loadAhead()]).then(() => {});
  }

  private keep(mesh: LoadedMesh): void {
    this.kept.set(mesh.id, mesh);
    for (const id of this.kept.keys()) if (id !== this.mesh?.id && id !== this.shown?.mesh) this.kept.delete(id);
  }

  /** A running cut is finished, so that the picture keeps changing while a slider moves; then comes the newest of those that wait. */
  cut(cutting: Cutting, slicing: Slicing): Promise<Model> {
    return this.cuts.answer({ cutting, slicing });
  }

  private async cutNow({ cutting, slicing }: { cutting: Cutting; slicing: Slicing }, signal: AbortSignal): Promise<Model> {
    try {
      await this.loaded;
      const { mesh } = this;
      if (!mesh) throw noMesh();
      const recipe: Recipe = { id: ++this.recipes, mesh: mesh.id, ...cutting };
      const model = await this.call('cut', { recipe, slicing }, { signal, progress: (progress) => this.onProgress(progress) });
      this.shown = recipe;
      this.keep(mesh);
      this.giveBackMemory(model.triangles.index.length);
      return model;
    } finally {
      this.onProgress(null);
    }
  }

  reuse({ isMoving, triangles, edges }: Model): void {
    if (!isMoving) return;
    const arrays = [triangles.position, triangles.normal, triangles.cell, triangles.index, edges.index];
    const buffers = arrays.map(({ buffer }) => buffer as ArrayBuffer);
    this.call('reuse', buffers, { transfer: buffers }).catch(() => {}); // then the next cut tells what is wrong
  }

  /** WebAssembly's memory never shrinks: after a cut far smaller than one before, another thread goes on. */
  private giveBackMemory(size: number): void {
    const isFarSmaller = this.largestCut > largeCut && size < this.largestCut / 8;
    this.largestCut = isFarSmaller ? size : Math.max(size, this.largestCut);
    if (isFarSmaller) this.thread.end();
  }

  /** Without shared memory the thread can't be told to stop, so it is ended with its call. */
  cancel(): void {
    this.loading?.abort();
    this.cuts.cancel();
  }

  slice(planes: readonly { normal: Vector3; offset: number }[], untouched: boolean): Promise<Slice[]> {
    return this.aboutShown((recipe) => this.call('slice', { recipe, planes, untouched }));
  }

  card(cell: number): Promise<CellCard> {
    return this.aboutShown((recipe) => this.call('card', { recipe, cell }));
  }

  validate(): Promise<Checks> {
    return this.aboutNewest((recipe) => this.call('validate', { recipe }));
  }

  countEdges(): Promise<number> {
    return this.aboutShown((recipe) => this.call('edges', { recipe }));
  }

  crossings(): Promise<Crossings> {
    return this.aboutShown((recipe) => this.call('crossings', { recipe }));
  }

  step(request: StepRequest): Promise<StepPicture> {
    return this.aboutNewest((recipe) => this.call('step', { recipe, request }));
  }

  compare(way: OtherGridWay | null): Promise<Comparison> {
    return this.aboutShown((recipe) => this.call('compare', { recipe, way }));
  }

  write(format: 'json' | 'vtu' | 'obj'): Promise<Uint8Array> {
    return this.aboutNewest((recipe) => this.call('write', { recipe, format }));
  }

  writeMesh(): Promise<Uint8Array> {
    return this.aboutShown((recipe) => this.call('writeMesh', { recipe }));
  }

  async wind(request: Parameters<Engine['wind']>[0], isTurned = true): Promise<Wind> {
    return this.tunnel.flow({ mesh: this.meshShown(), ...request }, isTurned);
  }

  async windAhead(request: Parameters<Engine['wind']>[0]): Promise<void> {
    return this.tunnel.flowAhead({ mesh: this.meshShown(), ...request });
  }

  cancelWind(): void {
    this.tunnel.cancel();
  }

  async smoke(request: Parameters<Engine['smoke']>[0]): Promise<Smoke> {
    return this.tunnel.smoke({ mesh: this.meshShown(), ...request });
  }

  smokeStep(): Promise<SmokeState> {
    return this.tunnel.smokeStep();
  }

  endSmoke(): void {
    this.tunnel.endSmoke();
  }

  async writeWind(request: Parameters<Engine['wind']>[0], format: WindFormat): Promise<Uint8Array> {
    return this.tunnel.write({ mesh: this.meshShown(), ...request }, format);
  }

  private meshShown(): number {
    if (!this.shown) throw noMesh();
    return this.shown.mesh;
  }

  /** Calls about planes or cells of the cut that is shown, which mean nothing for another cut. */
  private async aboutShown<T>(ask: (recipe: Recipe) => Promise<T>): Promise<T> {
    if (!this.shown) throw noMesh();
    try {
      return await ask(this.shown);
    } catch (error) {
      throw isOutdated(error) ? abortError() : error;
    }
  }

  /** If another cut came in between, the call is about that one. */
  private async aboutNewest<T>(ask: (recipe: Recipe) => Promise<T>): Promise<T> {
    for (;;) {
      const { shown } = this;
      if (!shown) throw noMesh();
      try {
        return await ask(shown);
      } catch (error) {
        if (!isOutdated(error)) throw error;
        if (this.shown === shown) throw abortError();
      }
    }
  }

  private call<K extends CallName>(name: K, ask: Calls[K]['ask'], options?: CallOptions): Promise<Calls[K]['answer']> {
    return this.thread.call(name, ask, options);
  }
}

function noMesh(): PageError {
  return pageError('There is no mesh', 'Choose a mesh first.');
}

export function createEngine(): Engine {
  return new WorkerEngine();
}

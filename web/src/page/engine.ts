// The page's half of the work: asks the package's worker, whose thread keeps meshes and cut-meshes. A new thread gets back what the former
// one had.
import { createWorker, type MandolineWorker } from 'mandoline-wasm/worker';
import type { Slice, Validation } from 'mandoline-wasm';
import type { Vector3 } from '../model/vector';
import { isLack, isOutdated, type CallName, type CallProgress, type Calls, type LoadedMesh, type Recipe } from '../model/calls';
import type { CellCard, Crossings, Cutting, Engine, MeshInfo, Model, PageError } from '../model/types';
import type { Slicing, Source, StepPicture, StepRequest } from '../model/types';
import type { Comparison } from '../model/comparison';
import type { Wind, WindFormat } from '../model/wind';
import { pageError } from '../model/failure';
import { WindEngine } from './wind_engine';
import { abortError, isCancellation, toPageError } from './failure';

interface CallOptions {
  signal?: AbortSignal;
  transfer?: ArrayBuffer[];
  progress?: (progress: CallProgress) => void;
}

/** A cut that waits for the one under way. */
interface WaitingCut {
  cutting: Cutting;
  slicing: Slicing;
  resolve(model: Promise<Model>): void;
  reject(error: unknown): void;
}

class WorkerEngine implements Engine {
  onProgress: Engine['onProgress'] = () => {};
  private worker: Promise<MandolineWorker> | null = null;
  private readonly tunnel = new WindEngine();
  private meshes = 0;
  private cuts = 0;
  /** The newest mesh, and that of the Model that is shown. */
  private readonly kept = new Map<number, LoadedMesh>();
  private mesh: LoadedMesh | null = null;
  private shown: Recipe | null = null;
  private loading: AbortController | null = null;
  /** Settles with the newest load. */
  private loaded: Promise<unknown> = Promise.resolve();
  private cutting: AbortController | null = null;
  private waiting: WaitingCut | null = null;

  constructor() {
    void this.start().catch(() => {}); // The first call tries again and says what is wrong.
  }

  private start(): Promise<MandolineWorker> {
    const worker = createWorker({ thread: () => new Worker(new URL('../worker/thread.ts', import.meta.url), { type: 'module' }) });
    worker.catch(() => (this.worker = null));
    this.worker = worker;
    return worker;
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
    if (!this.cutting) return this.cutNow(cutting, slicing);
    this.waiting?.reject(abortError());
    return new Promise((resolve, reject) => (this.waiting = { cutting, slicing, resolve, reject }));
  }

  private async cutNow(how: Cutting, slicing: Slicing): Promise<Model> {
    const cutting = new AbortController();
    this.cutting = cutting;
    try {
      await this.loaded;
      const { mesh } = this;
      if (!mesh) throw noMesh();
      const recipe: Recipe = { id: ++this.cuts, mesh: mesh.id, ...how };
      const options: CallOptions = { signal: cutting.signal, progress: (progress) => this.onProgress(progress) };
      const model = await this.call('cut', { recipe, slicing }, options);
      this.shown = recipe;
      this.keep(mesh);
      return model;
    } finally {
      if (this.cutting === cutting) this.finishCut();
    }
  }

  private finishCut(): void {
    const { waiting } = this;
    this.cutting = this.waiting = null;
    this.onProgress(null);
    waiting?.resolve(this.cutNow(waiting.cutting, waiting.slicing));
  }

  /** Without shared memory the thread can't be told to stop, so it is ended with its call. */
  cancel(): void {
    this.loading?.abort();
    this.waiting?.reject(abortError());
    this.waiting = null;
    this.cutting?.abort();
  }

  slice(planes: readonly { normal: Vector3; offset: number }[], untouched: boolean): Promise<Slice[]> {
    return this.aboutShown((recipe) => this.call('slice', { recipe, planes, untouched }));
  }

  card(cell: number): Promise<CellCard> {
    return this.aboutShown((recipe) => this.call('card', { recipe, cell }));
  }

  validate(): Promise<Validation> {
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

  compare(): Promise<Comparison> {
    return this.aboutShown((recipe) => this.call('compare', { recipe }));
  }

  write(format: 'json' | 'vtu' | 'obj'): Promise<Uint8Array> {
    return this.aboutNewest((recipe) => this.call('write', { recipe, format }));
  }

  wind(request: Parameters<Engine['wind']>[0]): Promise<Wind> {
    const mesh = this.meshShown();
    return this.tunnel.flow(mesh, { mesh: mesh.id, ...request });
  }

  cancelWind(): void {
    this.tunnel.cancel();
  }

  writeWind(request: Parameters<Engine['wind']>[0], format: WindFormat): Promise<Uint8Array> {
    const mesh = this.meshShown();
    return this.tunnel.write(mesh, { mesh: mesh.id, ...request }, format);
  }

  private meshShown(): LoadedMesh {
    const mesh = this.kept.get(this.shown?.mesh ?? 0);
    if (!mesh) throw noMesh();
    return mesh;
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

  private async call<K extends CallName>(name: K, ask: Calls[K]['ask'], options: CallOptions = {}): Promise<Calls[K]['answer']> {
    try {
      const worker = await (this.worker ?? this.start());
      const run = () => worker.call<Calls[K]['answer']>(name, [ask], options);
      return await run().catch(async (error: unknown) => {
        const mesh = isLack(error) ? this.kept.get(error.lacksMesh) : undefined;
        if (!mesh) throw error;
        await worker.call('keep', [mesh]);
        return run();
      });
    } catch (error) {
      if (isCancellation(error)) throw abortError();
      throw isOutdated(error) ? error : toPageError(error, name);
    }
  }
}

function noMesh(): PageError {
  return pageError('There is no mesh', 'Choose a mesh first.');
}

export function createEngine(): Engine {
  return new WorkerEngine();
}

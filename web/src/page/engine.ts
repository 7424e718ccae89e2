// The main thread's half of the engine: hands calls to the worker one by one, and replaces a worker that is in the way of newer ones.
import type { Slice, Validation, Vector3 } from 'mandoline-wasm';
import type { CellCard, Engine, GridSettings, Model, PageError, Source, StepPicture, StepRequest } from '../model/types';
import { abortError } from '../model/failure';
import type { Call, CallName, Calls, CutRecipe, EngineMesh, FromWorker, Start } from '../model/protocol';

/** A cut that a newer one waits for may take so long in all, in ms: most are drawn, so that dragging shows pictures all along. */
const patience = 500;

interface Job {
  call: Call;
  transfer: ArrayBuffer[];
  resolve(answer: unknown): void;
  reject(error: unknown): void;
}

export class WorkerEngine implements Engine {
  onProgress: Engine['onProgress'] = () => {};
  private worker: Worker | null = null;
  private wasm: WebAssembly.Module | null = null;
  private mesh: EngineMesh | null = null;
  private shown: CutRecipe | null = null;
  private waiting: Job[] = [];
  private running: Job | null = null;
  private started = 0;
  private ids = 0;
  private models = 0;

  constructor() {
    this.startWorker();
  }

  async load(source: Source, bytes?: ArrayBuffer): Promise<{ name: string; triangles: number }> {
    this.abort('cut');
    this.abort('load');
    const mesh = await this.call('load', { source, bytes }, bytes ? [bytes] : []);
    this.mesh = mesh;
    return { name: mesh.name, triangles: mesh.triangles.length / 3 };
  }

  async cut(grid: GridSettings, snapTolerance: number): Promise<Model> {
    this.abortWaiting('cut');
    if (this.running?.call.name === 'cut') this.stopLater(this.running);
    const model = await this.call('cut', { model: ++this.models, grid, snapTolerance });
    if (this.mesh) this.shown = { model: model.id, mesh: this.mesh, grid, snapTolerance };
    return model;
  }

  cancel(): void {
    this.abort('cut');
  }

  slice(planes: { normal: Vector3; offset: number }[], untouched: boolean): Promise<Slice[]> {
    return this.call('slice', { planes, untouched });
  }

  validate(): Promise<Validation> {
    return this.call('validate', null);
  }

  card(cell: number): Promise<CellCard> {
    return this.call('card', { cell });
  }

  step(request: StepRequest): Promise<StepPicture> {
    return this.call('step', request);
  }

  write(format: 'json' | 'vtu' | 'obj'): Promise<Uint8Array> {
    return this.call('write', format);
  }

  private call<K extends CallName>(name: K, ask: Calls[K]['ask'], transfer: ArrayBuffer[] = []): Promise<Calls[K]['answer']> {
    return new Promise((resolve, reject) => {
      const call = { kind: 'call', id: ++this.ids, name, ask } as Call;
      this.waiting.push({ call, transfer, resolve: resolve as (answer: unknown) => void, reject });
      this.next();
    });
  }

  private next(): void {
    if (this.running) return;
    this.running = this.waiting.shift() ?? null;
    if (!this.running) return;
    const worker = this.worker ?? this.startWorker();
    this.started = performance.now();
    worker.postMessage(this.running.call, this.running.transfer);
  }

  private startWorker(): Worker {
    const worker = new Worker(new URL('../worker/engine.worker.ts', import.meta.url), { type: 'module' });
    worker.onmessage = (event: MessageEvent<FromWorker>) => this.take(event.data);
    worker.onerror = (event) => this.fail(event.message);
    worker.onmessageerror = () => this.fail('');
    const start: Start = { kind: 'start', wasm: this.wasm, mesh: this.mesh, shown: this.shown };
    worker.postMessage(start);
    this.worker = worker;
    return worker;
  }

  private take(message: FromWorker): void {
    if (message.kind === 'ready') this.wasm = message.wasm;
    else if (message.kind === 'progress') this.onProgress({ stage: message.stage, fraction: message.fraction });
    else if (message.id === this.running?.call.id) {
      const job = this.finish();
      if (message.kind === 'answer') job?.resolve(message.answer);
      else job?.reject(message.error);
      // After whoever waited for this answer had its turn: a newer Model is known before the next call.
      queueMicrotask(() => this.next());
    }
  }

  private finish(): Job | null {
    const job = this.running;
    this.running = null;
    if (job?.call.name === 'cut') this.onProgress(null);
    return job;
  }

  /** The worker is gone: nobody waits for it any longer, and the next call starts another. */
  private fail(message: string): void {
    const why = `The part of the page that works in the background has failed${message ? `: ${message}` : ''}.`;
    const detail = `${why} Try again, or reload the page.`;
    const error: PageError = { title: 'The page lost its worker', detail };
    this.worker?.terminate();
    this.worker = null;
    const jobs = [this.finish(), ...this.waiting];
    this.waiting = [];
    for (const job of jobs) job?.reject(error);
  }

  private abort(name: CallName): void {
    this.abortWaiting(name);
    if (this.running?.call.name === name) this.stop();
  }

  private abortWaiting(name: CallName): void {
    const aborted = this.waiting.filter((job) => job.call.name === name);
    this.waiting = this.waiting.filter((job) => job.call.name !== name);
    for (const job of aborted) job.reject(abortError());
  }

  private stopLater(job: Job): void {
    const stop = () => {
      if (this.running === job) this.stop();
    };
    setTimeout(stop, this.started + patience - performance.now());
  }

  /** Nothing else ends a call that runs: without shared memory the worker can't be told. */
  private stop(): void {
    this.worker?.terminate();
    this.finish()?.reject(abortError());
    this.startWorker();
    this.next();
  }
}

export function createEngine(): Engine {
  return new WorkerEngine();
}

// Asks the thread of the wind tunnel, which is started when it is first needed.
import { createWorker } from 'mandoline-wasm/physics/worker';
import { isLack, type LoadedMesh, type WindCallName, type WindCalls } from '../model/calls';
import type { Shape, Wind, WindFormat, WindRequest } from '../model/wind';
import { abortError, isCancellation, toPageError } from './failure';

type Worker = Awaited<ReturnType<typeof createWorker>>;

type Request = Omit<WindRequest, 'known'>;

/** A flow that waits for the one under way. */
interface Waiting {
  mesh: LoadedMesh;
  request: Request;
  resolve(wind: Promise<Wind>): void;
  reject(error: unknown): void;
}

export class WindEngine {
  private worker: Promise<Worker> | null = null;
  private running: AbortController | null = null;
  private waiting: Waiting | null = null;
  /** The surface that came last: the same one is not sent again. */
  private surface: { tunnel: string; shape: Shape } | null = null;

  /** Loads what the first flow would else wait for. */
  async loadAhead(): Promise<void> {
    await this.call('windAhead', null);
  }

  /** Of several requests under way the newest wins: those before it reject with an AbortError, except the running one. */
  flow(mesh: LoadedMesh, request: Request): Promise<Wind> {
    if (!this.running) return this.flowNow(mesh, request);
    this.waiting?.reject(abortError());
    return new Promise((resolve, reject) => (this.waiting = { mesh, request, resolve, reject }));
  }

  private async flowNow(mesh: LoadedMesh, request: Request): Promise<Wind> {
    const running = new AbortController();
    this.running = running;
    try {
      const known = this.surface?.tunnel ?? '';
      return this.withSurface(await this.call('wind', { ...request, known }, { mesh, signal: running.signal }));
    } finally {
      if (this.running === running) this.next();
    }
  }

  private withSurface(wind: Wind): Wind {
    const { tunnel, surface } = wind;
    if (surface?.shape) this.surface = { tunnel, shape: surface.shape };
    else if (surface) surface.shape = this.surface?.shape ?? null;
    return wind;
  }

  private next(): void {
    const { waiting } = this;
    this.running = this.waiting = null;
    if (waiting) waiting.resolve(this.flowNow(waiting.mesh, waiting.request));
    else void this.solveAhead();
  }

  /** Until the wind can be turned at once, or is asked for. */
  private async solveAhead(): Promise<void> {
    while (!this.running && (await this.call('windAhead', null).catch(() => false)));
  }

  write(mesh: LoadedMesh, request: Request, format: WindFormat): Promise<Uint8Array> {
    return this.call('writeWind', { request, format }, { mesh });
  }

  /** Ends what is under way: it rejects with an AbortError. */
  cancel(): void {
    this.waiting?.reject(abortError());
    this.waiting = null;
    this.running?.abort();
  }

  private start(): Promise<Worker> {
    const worker = createWorker({ thread: () => new Worker(new URL('../worker/wind/thread.ts', import.meta.url), { type: 'module' }) });
    worker.catch(() => (this.worker = null));
    this.worker = worker;
    return worker;
  }

  private async call<K extends WindCallName>(
    name: K,
    ask: WindCalls[K]['ask'],
    { mesh, signal }: { mesh?: LoadedMesh; signal?: AbortSignal } = {},
  ): Promise<WindCalls[K]['answer']> {
    try {
      const worker = await (this.worker ?? this.start());
      const run = () => worker.call<WindCalls[K]['answer']>(name, [ask], { signal });
      return await run().catch(async (error: unknown) => {
        if (!isLack(error) || !mesh) throw error;
        await worker.call('keep', [mesh], { signal });
        return run();
      });
    } catch (error) {
      throw isCancellation(error) ? abortError() : toPageError(error, name);
    }
  }
}

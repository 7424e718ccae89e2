// Asks the thread of the wind tunnel, which is started when it is first needed.
import { createWorker } from 'mandoline-wasm/physics/worker';
import type { LoadedMesh, WindCallName, WindCalls } from '../model/calls';
import type { Shape, Wind, WindFormat, WindRequest } from '../model/wind';
import { Newest } from './newest';
import { Thread } from './thread';

type Request = Omit<WindRequest, 'known'>;

export class WindEngine {
  private readonly flows = new Newest<Request, Wind>(
    (request, signal) => this.flowNow(request, signal),
    () => void this.solveAhead(),
  );
  private readonly thread: Thread;
  /** The surface that came last: the same one is not sent again. */
  private surface: { tunnel: string; shape: Shape } | null = null;
  /** Whether the newest flow may be turned. */
  private isTurned = false;

  constructor(meshOf: (id: number) => LoadedMesh | undefined) {
    const thread = () => new Worker(new URL('../worker/wind/thread.ts', import.meta.url), { type: 'module' });
    this.thread = new Thread(() => createWorker({ thread }), meshOf);
  }

  /** Loads what the first flow would else wait for. */
  async loadAhead(): Promise<void> {
    await this.call('windAhead', null);
  }

  /** Of several requests under way the newest wins: those before it reject with an AbortError, except the running one. */
  flow(request: Request, isTurned: boolean): Promise<Wind> {
    this.isTurned = isTurned;
    return this.flows.answer(request);
  }

  private async flowNow(request: Request, signal: AbortSignal): Promise<Wind> {
    const known = this.surface?.tunnel ?? '';
    return this.withSurface(await this.call('wind', { ...request, known }, signal));
  }

  private withSurface(wind: Wind): Wind {
    const { tunnel, surface } = wind;
    if (surface?.shape) this.surface = { tunnel, shape: surface.shape };
    else if (surface) surface.shape = this.surface?.shape ?? null;
    return wind;
  }

  /** Until the wind can be turned at once, or is asked for. */
  private async solveAhead(): Promise<void> {
    while (this.isTurned && !this.flows.isRunning && (await this.call('windAhead', null).catch(() => false)));
  }

  write(request: Request, format: WindFormat): Promise<Uint8Array> {
    return this.call('writeWind', { request, format });
  }

  /** Ends what is under way: it rejects with an AbortError. */
  cancel(): void {
    this.isTurned = false;
    this.flows.cancel();
  }

  private call<K extends WindCallName>(name: K, ask: WindCalls[K]['ask'], signal?: AbortSignal): Promise<WindCalls[K]['answer']> {
    return this.thread.call(name, ask, { signal });
  }
}

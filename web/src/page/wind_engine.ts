// Asks the thread of the wind tunnel, which is started when it is first needed.
import type { LoadedMesh, WindCallName, WindCalls } from '../model/calls';
import type { Shape, Smoke, SmokeRequest, SmokeState, Wind, WindFormat, WindRequest } from '../model/wind';
import { Newest } from './newest';
import { Thread } from './thread';

type Request = Omit<WindRequest, 'known'>;

export class WindEngine {
  private readonly flows = new Newest<Request, Wind>(
    (request, signal) => this.flowNow(request, signal),
    () => void this.turnAhead(),
  );
  private readonly smokes = new Newest<SmokeRequest, Smoke>((request, signal) => this.call('smoke', request, signal));
  /** Whether the thread may have some. */
  private hasSmoke = false;
  private readonly thread: Thread;
  /** The surface that came last: the same one is not sent again. */
  private surface: { tunnel: string; shape: Shape } | null = null;
  /** Whether the newest flow may be turned. */
  private isTurned = false;

  constructor(meshOf: (id: number) => LoadedMesh | undefined) {
    const thread = () => new Worker(new URL('../worker/wind/thread.ts', import.meta.url), { type: 'module' });
    // What the package has for it is loaded with it.
    this.thread = new Thread(async () => (await import('mandoline-wasm/physics/worker')).createWorker({ thread }), meshOf);
  }

  loadAhead(): Promise<void> {
    return this.call('loadWind', null);
  }

  /** What the first flow would else wait for. */
  flowAhead(request: Request): Promise<void> {
    return this.call('windAhead', { ...request, known: '' });
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
  private async turnAhead(): Promise<void> {
    while (this.isTurned && !this.flows.isRunning && (await this.call('turnAhead', null).catch(() => false)));
  }

  write(request: Request, format: WindFormat): Promise<Uint8Array> {
    return this.call('writeWind', { request, format });
  }

  smoke(request: SmokeRequest): Promise<Smoke> {
    this.hasSmoke = true;
    return this.smokes.answer(request);
  }

  smokeStep(): Promise<SmokeState> {
    return this.call('smokeStep', null);
  }

  /** WebAssembly's memory never shrinks: another thread takes its place. */
  endSmoke(): void {
    if (!this.hasSmoke) return;
    this.hasSmoke = false;
    this.smokes.cancel();
    this.thread.end();
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

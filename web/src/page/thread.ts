import { isLack, isOutdated, type CallName, type CallProgress, type LoadedMesh, type WindCallName } from '../model/calls';
import { abortError, isCancellation, toPageError } from './failure';

export interface CallOptions {
  signal?: AbortSignal;
  transfer?: ArrayBuffer[];
  progress?: (progress: CallProgress) => void;
}

/** What both workers of the package are. */
interface Callable {
  call<T>(name: string, parameters: unknown[], options?: CallOptions): Promise<T>;
  terminate(): void;
}

/** A worker that is started when it is needed, again if it can't be, and that gets the meshes which it lacks. */
export class Thread {
  private worker: Promise<Callable> | null = null;

  constructor(
    private readonly open: () => Promise<Callable>,
    private readonly meshOf: (id: number) => LoadedMesh | undefined,
  ) {}

  start(): Promise<Callable> {
    const worker = this.open();
    worker.catch(() => {
      if (this.worker === worker) this.worker = null;
    });
    this.worker = worker;
    return worker;
  }

  /** Once it has answered what was asked so far. The next call starts another one. */
  end(): void {
    const { worker } = this;
    this.worker = null;
    // If it can't be started or can't answer, there is nothing left to end.
    worker?.then((former) => former.call('end', [null]).finally(() => former.terminate())).catch(() => {});
  }

  async call<T>(name: CallName | WindCallName, ask: unknown, options: CallOptions = {}): Promise<T> {
    try {
      const worker = await (this.worker ?? this.start());
      const run = () => worker.call<T>(name, [ask], options);
      return await run().catch(async (error: unknown) => {
        const mesh = isLack(error) ? this.meshOf(error.lacksMesh) : undefined;
        if (!mesh) throw error;
        await worker.call('keep', [mesh], { signal: options.signal });
        return run();
      });
    } catch (error) {
      if (isCancellation(error)) throw abortError();
      throw isOutdated(error) ? error : toPageError(error, name);
    }
  }
}

// What is under way, and what became of it.
import type { PageError } from '../model/failure';
import type { State } from './state';

type Kind = NonNullable<State['work']['value']>;

export class Work {
  private tasks = 0;
  private readonly counts: Record<Kind, number> = { loading: 0, cutting: 0 };
  private failed = false;
  /** Alerts to be shown in the end: a fallback that succeeds must not clear them. */
  private troubles: PageError[] = [];

  constructor(private readonly state: State) {}

  /** The page is busy until this and everything else is done. */
  async during(task: () => Promise<void>): Promise<void> {
    if (this.tasks++ === 0) this.state.status.value = 'busy';
    this.failed = false;
    try {
      await task();
    } catch (error) {
      this.failed = true;
      throw error;
    } finally {
      this.done();
    }
  }

  private done(): void {
    if (--this.tasks > 0) return;
    for (const error of this.troubles.splice(0)) this.state.alert(error, 'mesh');
    this.state.status.value = this.failed ? 'error' : 'ready';
  }

  /** The page says meanwhile what it is doing. */
  async doing<T>(kind: Kind, task: () => Promise<T>): Promise<T> {
    this.count(kind, 1);
    try {
      return await task();
    } finally {
      this.count(kind, -1);
    }
  }

  isDoing(kind: Kind): boolean {
    return this.counts[kind] > 0;
  }

  private count(kind: Kind, change: number): void {
    this.counts[kind] += change;
    this.state.work.value = this.isDoing('loading') ? 'loading' : this.isDoing('cutting') ? 'cutting' : null;
    this.state.progress.value = null;
  }

  succeed(): void {
    this.failed = false;
  }

  fail(): void {
    this.failed = true;
  }

  alertInTheEnd(error: PageError): void {
    this.troubles.push(error);
  }
}

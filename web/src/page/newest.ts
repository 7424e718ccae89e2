import { abortError } from './failure';

interface Waiting<Ask, Answer> {
  ask: Ask;
  resolve(answer: Promise<Answer>): void;
  reject(error: unknown): void;
}

/** Answers one at a time: what is under way is finished, and then comes the newest of those that wait. The others reject with an AbortError. */
export class Newest<Ask, Answer> {
  private running: AbortController | null = null;
  private waiting: Waiting<Ask, Answer> | null = null;

  constructor(
    private readonly run: (ask: Ask, signal: AbortSignal) => Promise<Answer>,
    /** Called when none waits any more. */
    private readonly onIdle = () => {},
  ) {}

  get isRunning(): boolean {
    return this.running !== null;
  }

  answer(ask: Ask): Promise<Answer> {
    if (!this.running) return this.answerNow(ask);
    this.dropWaiting();
    return new Promise((resolve, reject) => (this.waiting = { ask, resolve, reject }));
  }

  private async answerNow(ask: Ask): Promise<Answer> {
    this.running = new AbortController();
    try {
      return await this.run(ask, this.running.signal);
    } finally {
      this.next();
    }
  }

  private next(): void {
    const { waiting } = this;
    this.running = this.waiting = null;
    if (waiting) waiting.resolve(this.answerNow(waiting.ask));
    else this.onIdle();
  }

  /** Ends what is under way, too: it rejects as its run does when it is aborted. */
  cancel(): void {
    this.dropWaiting();
    this.running?.abort();
  }

  private dropWaiting(): void {
    this.waiting?.reject(abortError());
    this.waiting = null;
  }
}

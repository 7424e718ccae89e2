// Smoke that is carried by a flow in time. The flow is stepped ahead of what is drawn, as fast as that needs; without frames there are no
// steps.
import type { Engine } from '../model/engine';
import type { Smoke, SmokeMoment, SmokeSource, SmokeState } from '../model/wind';

/** In seconds: how far ahead states are wanted, and how soon the pace follows them. */
const ahead = 0.45;
const settling = 0.5;
/** The wind covers this in a second at most, in longest sides of the mesh: where steps are slow, so is the smoke. */
const fastest = 0.7;
/** Of a step, in the mean of those before. */
const newest = 0.15;

export class SmokeClock implements SmokeSource {
  private states: SmokeState[];
  private time: number;
  private pace = 0;
  private isStepping = false;
  private isEnded = false;
  private stepTime = 0;

  constructor(
    private readonly engine: Pick<Engine, 'smokeStep'>,
    readonly smoke: Smoke,
    private readonly on: { state(state: SmokeState, stepsPerSecond: number): void; error(error: unknown): void },
  ) {
    this.states = [smoke.begin];
    this.time = smoke.begin.time;
  }

  end(): void {
    this.isEnded = true;
  }

  advance(seconds: number): SmokeMoment {
    const there = this.ahead();
    const wanted = Math.min(there / ahead, fastest * this.smoke.size);
    this.pace += (wanted - this.pace) * (1 - Math.exp(-seconds / settling));
    this.time += Math.min(this.pace * seconds, there);
    while (this.states.length > 2 && this.states[1].time <= this.time) this.states.shift();
    void this.stepAhead();
    return this.moment();
  }

  private moment(): SmokeMoment {
    const [from, to = from] = this.states;
    return { from, to, time: this.time, share: to === from ? 0 : Math.min(1, (this.time - from.time) / (to.time - from.time)) };
  }

  private ahead(): number {
    return this.states[this.states.length - 1].time - this.time;
  }

  /** After an error there are no more. */
  private async stepAhead(): Promise<void> {
    if (this.isStepping) return;
    this.isStepping = true;
    try {
      while (!this.isEnded && this.ahead() < ahead * fastest * this.smoke.size) await this.step();
      this.isStepping = false;
    } catch (error) {
      if (!this.isEnded) this.on.error(error);
    }
  }

  private async step(): Promise<void> {
    const begin = performance.now();
    const state = await this.engine.smokeStep();
    if (this.isEnded) return;
    const took = performance.now() - begin;
    this.stepTime = this.stepTime === 0 ? took : this.stepTime + newest * (took - this.stepTime);
    this.states.push(state);
    this.on.state(state, 1000 / this.stepTime);
  }
}

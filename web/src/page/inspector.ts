// What is looked at closely: a pinned cell, or what is drawn instead of the model.
import type { Engine } from '../model/engine';
import type { Instead, StepRequest } from '../model/instead';
import type { View } from '../model/view';
import { ask } from './ask';
import type { State } from './state';

export class Inspector {
  private pins = 0;
  private pinned = false;
  private insteads = 0;
  private insteadKind: Instead['kind'] | null = null;

  constructor(
    private readonly engine: Engine,
    private readonly view: View,
    private readonly state: State,
  ) {}

  /** Pins a cell and fetches its card, or unpins it. */
  async pin(cell: number | null): Promise<void> {
    const pin = ++this.pins;
    this.pinned = cell !== null;
    this.view.setPinned(cell);
    const card = cell === null ? null : await ask(this.state, this.engine.card(cell));
    if (pin === this.pins && (card || cell === null)) this.state.pinned.value = card;
  }

  /** Shows a step of the algorithm instead of the model, or the model again. */
  async step(request: StepRequest | null): Promise<void> {
    if (request) await this.showInstead(request.kind, this.engine.step(request));
    else this.showModel();
  }

  /** Shows where the surface meets itself, instead of the model. */
  showCrossings(): Promise<void> {
    return this.showInstead('crossings', this.engine.crossings());
  }

  showModel(): void {
    this.insteads++;
    this.insteadKind = null;
    this.takeInstead(null);
  }

  /** Shows the same of a new cut; of another mesh, where that meets itself is another matter. */
  renew(isSameMesh: boolean): void {
    if (this.insteadKind !== 'crossings') {
      if (this.insteadKind) void this.step({ kind: this.insteadKind });
    } else if (isSameMesh) void this.showCrossings();
    else this.showModel();
  }

  private async showInstead(kind: Instead['kind'], answer: Promise<Instead>): Promise<void> {
    const asked = ++this.insteads;
    this.insteadKind = kind;
    const instead = await ask(this.state, answer);
    if (instead && asked === this.insteads) this.takeInstead(instead);
  }

  private takeInstead(instead: Instead | null): void {
    this.view.setInstead(instead);
    this.state.instead.value = instead;
  }

  /** Unpins the cell, or else goes back to the model. */
  leave(): void {
    if (this.pinned) void this.pin(null);
    else if (this.insteadKind) this.showModel();
  }
}

// Shows the comparison that the settings ask for, of every new cut.
import { effect } from '@preact/signals';
import type { Comparison } from '../model/comparison';
import { isOutside } from '../model/inside';
import type { Engine, Model, View } from '../model/types';
import { ask } from './ask';
import type { State } from './state';
import { isSheet } from './view/look';

export class Comparing {
  /** A model of the former mesh, which is shown until there is one of the new mesh. */
  private former: Model | null = null;
  /** What was asked about last. */
  private asked: Model | null = null;

  constructor(
    private readonly state: State,
    private readonly engine: Engine,
    view: View,
  ) {
    effect(() => this.forget(state.mesh.value));
    effect(() => void this.update(state.model.value, state.settings.value.compare.way !== 'none'));
    effect(() => view.setComparison(state.divided.value));
  }

  /** The comparison of the former mesh. */
  private forget(mesh: unknown): void {
    this.former = mesh ? this.state.model.peek() : null;
    this.show(null, null);
  }

  private show(asked: Model | null, comparison: Comparison | null): void {
    this.asked = asked;
    this.state.comparison.value = comparison;
  }

  private async update(model: Model | null, isOn: boolean): Promise<void> {
    if (!isOn || !model || model === this.former || !hasInside(model)) {
      this.show(null, null);
      return;
    }
    if (model === this.asked) return;
    this.asked = model;
    const comparison = await ask(this.state, this.engine.compare());
    // Until there is one of the newest cut, the one before is shown.
    if (this.asked && (comparison || this.asked === model)) this.show(this.asked, comparison);
  }
}

/** What an estimate makes of the cells at a sheet is no inside. */
export function hasInside(model: Model): boolean {
  return !isSheet(model) && model.regions.some(({ id }) => !isOutside(model, id));
}

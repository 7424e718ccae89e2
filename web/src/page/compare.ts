// Shows the comparison that the settings ask for, of every new cut.
import { computed, effect } from '@preact/signals';
import { otherGridWay, type Comparison, type OtherGridWay } from '../model/comparison';
import { isOutside } from '../model/inside';
import { isSheet } from '../model/shown';
import type { Model } from '../model/cut_model';
import type { Engine } from '../model/engine';
import type { View } from '../model/view';
import { ask } from './ask';
import type { State } from './state';

interface Asked {
  model: Model;
  way: OtherGridWay | null;
}

export class Comparing {
  /** A model of the former mesh, which is shown until there is one of the new mesh. */
  private former: Model | null = null;
  /** What was asked about last. */
  private asked: Asked | null = null;

  constructor(
    private readonly state: State,
    private readonly engine: Engine,
    view: View,
  ) {
    const way = computed(() => state.settings.value.compare.way);
    const otherGrid = computed(() => otherGridWay(way.value));
    const isOn = computed(() => way.value !== 'none');
    effect(() => this.forget(state.mesh.value));
    effect(() => void this.update(state.model.value, isOn.value, otherGrid.value));
    effect(() => view.setComparison(state.divided.value));
  }

  /** The comparison of the former mesh. */
  private forget(mesh: unknown): void {
    this.former = mesh ? this.state.model.peek() : null;
    this.show(null, null);
  }

  private show(asked: Asked | null, comparison: Comparison | null): void {
    this.asked = asked;
    this.state.comparison.value = comparison;
    this.state.isComparisonAwaited.value = false;
  }

  private async update(model: Model | null, isOn: boolean, way: OtherGridWay | null): Promise<void> {
    if (!isOn || !model || model === this.former || !hasInside(model)) {
      this.show(null, null);
      return;
    }
    const isKnown = way === null || (this.asked && way === this.asked.way);
    if (model === this.asked?.model && isKnown) return;
    const asked = { model, way };
    this.asked = asked;
    this.state.isComparisonAwaited.value = true;
    const comparison = await ask(this.state, this.engine.compare(way));
    // Until there is one of the newest cut, the one before is shown.
    if (this.asked === asked) this.show(comparison && asked, comparison);
    else if (this.asked && comparison) this.state.comparison.value = comparison;
  }
}

/** What an estimate makes of the cells at a sheet is no inside. */
export function hasInside(model: Model): boolean {
  return !isSheet(model) && model.regions.some(({ id }) => !isOutside(model, id));
}

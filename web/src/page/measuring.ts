// Measures a distance between two places of the model, which are touched in the picture, typed, or the middle of the pinned cell.
import { effect } from '@preact/signals';
import type { Measurement, MeasuredPlace } from '../model/measurement';
import type { Model } from '../model/cut_model';
import type { View } from '../model/view';
import type { Vector3 } from '../model/vector';
import type { State } from './state';

const nothing: Measurement = { from: null, to: null };

export class Measuring {
  constructor(
    private readonly state: State,
    view: View,
  ) {
    view.onMeasured = (place) => this.take(place);
    // What has been measured is of another model.
    effect(() => this.forget(state.model.value));
    effect(() => view.setMeasurement(state.measurement.value));
  }

  begin(): void {
    this.state.measurement.value = nothing;
    this.state.sections.uncover();
  }

  end(): void {
    this.state.measurement.value = null;
  }

  private forget(model: Model | null): void {
    if (this.state.measurement.peek()) this.state.measurement.value = model && nothing;
  }

  /** The place that is missing; after two, a new distance begins. */
  private take(place: MeasuredPlace): void {
    const { measurement } = this.state;
    if (!measurement.value) return;
    const { from, to } = measurement.value;
    measurement.value = from && !to ? { from, to: place } : { from: place, to: from ? null : to };
  }

  /** A point in world units, which moves as a cell of its region in its place does when cells are pulled apart. */
  set(end: 'from' | 'to', point: Vector3, region: number | null = null): void {
    const { model } = this.state;
    if (!model.value) return;
    const { origin } = model.value;
    const place = { point, middle: point.map((x, d) => x - origin[d]), region };
    this.state.measurement.value = { ...(this.state.measurement.value ?? nothing), [end]: place };
  }
}

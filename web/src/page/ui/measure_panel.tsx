import { useEffect, useState } from 'preact/hooks';
import type { App } from '../app';
import type { MeasuredPlace } from '../../model/measurement';
import { axes } from '../../model/slices';
import { NumberField } from './controls/number_field';
import { Section } from './controls/section';

type End = 'from' | 'to';

/** A distance between two places: touched in the picture, typed, or the middle of the pinned cell. */
export function MeasurePanel({ app }: { app: App }) {
  const measurement = app.state.measurement.value;
  return (
    <Section app={app} id="measure" title="Measure">
      <p class="hint">The distance between two places of the model, in its units. Nearby corners are snapped to.</p>
      <div class="row">
        <button type="button" id="measure-on" disabled={!app.model} aria-pressed={measurement !== null} onClick={() => app.toggleMeasure()}>
          {measurement ? 'End measuring' : 'Choose in the picture'}
        </button>
      </div>
      <div class="custom-grid" role="group" aria-label="Ends of the distance">
        <span />
        {axes.map((axis) => (
          <span key={axis} class="axis" aria-hidden="true">
            {axis}
          </span>
        ))}
        {(['from', 'to'] as const).map((end) => (
          <Place key={end} app={app} end={end} place={measurement?.[end] ?? null} />
        ))}
      </div>
      <div class="row">
        {(['from', 'to'] as const).map((end) => (
          <PinnedCell key={end} app={app} end={end} />
        ))}
      </div>
    </Section>
  );
}

/** A place is there once all of its coordinates are. */
function Place({ app, end, place }: { app: App; end: End; place: MeasuredPlace | null }) {
  const [typed, setTyped] = useState<readonly (number | null)[]>([null, null, null]);
  useEffect(() => setTyped(place ? place.point : [null, null, null]), [place]);
  const type = (d: number, value: number) => {
    const next = typed.map((x, e) => (e === d ? value : x));
    setTyped(next);
    const point = next.filter((x) => x !== null);
    if (point.length === 3) app.measuring.set(end, point);
  };
  return (
    <>
      <span class="hint" aria-hidden="true">
        {end}
      </span>
      {axes.map((axis, d) => (
        <NumberField
          key={axis}
          id={`measure-${end}-${axis}`}
          label={`Distance ${end}, ${axis}`}
          hideLabel
          step="any"
          optional
          disabled={!app.model}
          value={typed[d] === null ? null : Number(typed[d].toPrecision(5))}
          onChange={(value) => type(d, value)}
        />
      ))}
    </>
  );
}

function PinnedCell({ app, end }: { app: App; end: End }) {
  const pinned = app.state.pinned.value;
  return (
    <button
      type="button"
      id={`measure-${end}-pinned`}
      disabled={!pinned}
      onClick={() => pinned && app.measuring.set(end, pinned.centroid, pinned.region)}
    >
      {end === 'from' ? 'From' : 'To'} the pinned cell
    </button>
  );
}

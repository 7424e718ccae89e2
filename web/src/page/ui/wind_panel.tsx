import type { App } from '../app';
import { integer, milliseconds, real } from '../../model/format';
import { fromUpright, toUpright, upOf } from '../../model/up';
import type { Vector3 } from '../../model/vector';
import { mostWindCells, type WindColoring, type WindStats } from '../../model/wind';
import { Choice } from './controls/choice';
import { NumberField } from './controls/number_field';
import { Section } from './controls/section';
import { Slider } from './controls/slider';
import { Terms } from './controls/terms';

/** The wind tunnel: where the wind blows, what the colours show, and the flow in numbers. */
export function WindPanel({ app }: { app: App }) {
  const { show, cells } = app.settings.wind;
  return (
    <Section app={app} id="wind" title="Wind">
      <Direction app={app} />
      <Choice
        name="wind-show"
        legend="Colours"
        options={colorings}
        value={show}
        onChange={(coloring) => app.changeWind({ show: coloring })}
      />
      <NumberField
        id="wind-cells"
        label="Cells along the wind tunnel"
        min={8}
        max={mostWindCells}
        value={cells}
        onChange={(count) => app.changeWind({ cells: count })}
      />
      <Numbers app={app} />
    </Section>
  );
}

const colorings: readonly (readonly [WindColoring, string])[] = [
  ['none', 'cells'],
  ['speed', 'speed'],
  ['pressure', 'pressure'],
];

const degrees = (x: number) => `${Math.round(x)}°`;

/** Arrow keys turn the wind here; in the picture, the arrow is dragged. */
function Direction({ app }: { app: App }) {
  const up = upOf(app.settings, app.model);
  const { heading, rise } = anglesOf(toUpright(app.settings.wind.direction, up));
  const turn = (to: { heading: number; rise: number }) => app.changeWind({ direction: fromUpright(directionOf(to), up) });
  return (
    <fieldset>
      <legend>Direction</legend>
      <Slider
        id="wind-heading"
        label="around"
        min={-180}
        max={180}
        step={1}
        value={heading}
        format={degrees}
        onInput={(value) => turn({ heading: value, rise })}
      />
      <Slider
        id="wind-rise"
        label="upward"
        min={-90}
        max={90}
        step={1}
        value={rise}
        format={degrees}
        onInput={(value) => turn({ heading, rise: value })}
      />
    </fieldset>
  );
}

/** In degrees: from the right towards the viewer, and upward. */
function anglesOf([x, y, z]: Vector3): { heading: number; rise: number } {
  const toDegrees = 180 / Math.PI;
  return { heading: toDegrees * Math.atan2(z, x), rise: toDegrees * Math.asin(Math.max(-1, Math.min(1, y))) };
}

/** Straight up and down it keeps a trace of where it was headed. */
function directionOf({ heading, rise }: { heading: number; rise: number }): Vector3 {
  const toRadians = Math.PI / 180;
  const [h, r] = [heading * toRadians, Math.max(-89.9, Math.min(89.9, rise)) * toRadians];
  const round = (x: number) => Number(x.toFixed(12));
  return [Math.cos(r) * Math.cos(h), Math.sin(r), Math.cos(r) * Math.sin(h)].map(round);
}

function Numbers({ app: { state } }: { app: App }) {
  const stats = state.wind.value?.stats;
  return (
    <div id="wind-numbers" aria-busy={state.isWindAwaited.value}>
      {state.isWindAwaited.value && !stats && <p class="hint">The flow is being computed.</p>}
      {stats && <Terms class="counts" list={termsOf(stats)} />}
      {stats?.isThrottled && <p class="hint">The surface divides the wind tunnel, and holds back the wind in parts of it.</p>}
    </div>
  );
}

function termsOf({ grid, cells, cutCells, largestSpeed, smallestPressure, times }: WindStats): [string, string][] {
  return [
    ['grid', grid.join(' × ')],
    ['cells', `${integer(cells)}, ${integer(cutCells)} of them cut`],
    ['largest speed', `${real(largestSpeed)} of the wind`],
    ['least pressure', real(smallestPressure).replace('-', '−')],
    ['time', milliseconds(times.cells + times.flow + times.picture)],
  ];
}

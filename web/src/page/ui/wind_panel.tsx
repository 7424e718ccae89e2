import type { App } from '../app';
import { integer, milliseconds, real } from '../../model/format';
import { upOf } from '../../model/shown';
import { mostWindCells, type SmokeNumbers, type WindColoring, type WindStats } from '../../model/wind';
import { Choice } from './controls/choice';
import { Direction } from './controls/direction';
import { NumberField } from './controls/number_field';
import { Section } from './controls/section';
import { Terms } from './controls/terms';

/** The wind tunnel: where the wind blows, what the colours show, and the flow in numbers. */
export function WindPanel({ app }: { app: App }) {
  const { direction, smoke, show, cells } = app.settings.wind;
  return (
    <Section app={app} id="wind" title="Wind">
      <Direction
        name="wind"
        legend="Direction"
        up={upOf(app.settings, app.model)}
        direction={direction}
        onTurn={(to) => app.changeWind({ direction: to })}
      />
      <Choice
        name="wind-flow"
        legend="Flow"
        options={flows}
        value={smoke ? 'smoke' : 'lines'}
        onChange={(flow) => app.changeWind({ smoke: flow === 'smoke' })}
      />
      {!smoke && (
        <>
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
        </>
      )}
      <Numbers app={app} />
    </Section>
  );
}

const flows = [
  ['lines', 'lines'],
  ['smoke', 'smoke'],
] as const;

const colorings: readonly (readonly [WindColoring, string])[] = [
  ['none', 'cells'],
  ['speed', 'speed'],
  ['pressure', 'pressure'],
];

function Numbers({ app: { state } }: { app: App }) {
  const stats = state.wind.value?.stats;
  const smoke = state.smoke.value;
  return (
    <div id="wind-numbers" aria-busy={state.isWindAwaited.value}>
      {state.isWindAwaited.value && !stats && !smoke && <p class="hint">The flow is being computed.</p>}
      {stats && <Terms class="counts" list={termsOf(stats)} />}
      {smoke && <Terms class="counts" list={smokeTermsOf(smoke)} />}
      {smoke && <p class="hint">The longest side of the mesh and the wind's speed are 1; drag and lift are those of ½ρv² on its square.</p>}
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

function smokeTermsOf({ counts, cells, stepsPerSecond, time, drag, lift }: SmokeNumbers): [string, string][] {
  return [
    ['grid', counts.join(' × ')],
    ['cells', integer(cells)],
    ['steps', stepsPerSecond > 0 ? `${stepsPerSecond.toFixed(1)} a second` : 'none yet'],
    ['time', time.toFixed(2)],
    ['drag', drag.toFixed(3)],
    ['lift', lift.toFixed(3)],
  ];
}

import { useState } from 'preact/hooks';
import type { Check } from 'mandoline-wasm';
import type { App } from '../app';
import { checksSentence } from '../../model/checks';
import { real, words } from '../../model/format';
import { Section } from './controls/section';

/** Lists every check of the cut-mesh, and has those made that were not made by themselves. */
export function ChecksPanel({ app }: { app: App }) {
  const { model } = app;
  const [isRunning, setRunning] = useState(false);
  const validate = async () => {
    setRunning(true);
    await app.checking.check();
    setRunning(false);
  };
  return (
    <Section app={app} id="checks" title="Checks">
      <p class="hint">
        Checks every invariant of the cut-mesh, from the result and the input alone: by itself where that takes hardly any time.
      </p>
      <div class="row">
        <button type="button" id="validate" disabled={isRunning || !model} onClick={() => void validate()}>
          {isRunning ? 'Validating…' : 'Validate'}
        </button>
      </div>
      <Result app={app} />
    </Section>
  );
}

function Result({ app }: { app: App }) {
  const { model, state } = app;
  const found = model && state.checked.value?.model === model.id ? state.checked.value : null;
  const { pass, checks } = found?.checks ?? { checks: [] };
  const failed = checks.filter((check) => !check.pass).length;
  const skipped = checks.filter((check) => check.skipped).length;
  const passed = checks.length - failed - skipped;
  const verdict = pass ? `All ${passed} checks pass.` : '';
  const notApplied = skipped > 0 ? ` ${skipped} skipped: ${skipped === 1 ? 'it does' : 'they do'} not apply to this mesh.` : '';
  const counts = found && {
    'data-model': found.model,
    'data-pass': String(pass),
    'data-passed': passed,
    'data-failed': failed,
    'data-skipped': skipped,
  };
  return (
    <div id="validation" aria-live="polite" {...counts}>
      {model && found && (
        <>
          <p class={pass ? 'verdict good' : 'verdict bad'}>{checksSentence(found.checks, model.counts.cutCells)}</p>
          <p class="hint">{verdict + notApplied}</p>
          <ul class="check-list">
            {checks.map((check) => (
              <Item key={check.name} check={check} app={app} />
            ))}
          </ul>
          <Deviations checks={checks.filter((check) => !check.skipped && check.tolerance > 0)} />
        </>
      )}
    </div>
  );
}

function Item({ check, app }: { check: Check; app: App }) {
  const state = check.skipped ? 'skipped' : check.pass ? 'pass' : 'fail';
  return (
    <li class={state} data-check={check.name} data-state={state}>
      <span class="mark">{state}</span>
      <strong>{words(check.name)}</strong>
      {state === 'pass' && <span class="hint">{check.tolerance === 0 ? 'no violations' : 'exact, up to rounding'}</span>}
      {check.message && <span class="message">{check.message}</span>}
      {!check.pass && check.elementKind === 'cell' && (
        <button type="button" class="quiet" onClick={() => void app.inspector.pin(check.element)}>
          Show cell {check.element}
        </button>
      )}
    </li>
  );
}

/** The raw numbers behind "up to rounding". */
function Deviations({ checks }: { checks: readonly Check[] }) {
  return (
    <details id="deviations">
      <summary>Deviations</summary>
      <div>
        <p class="hint">In roundings: half units in the last place of the largest coordinate.</p>
        <table class="deviations">
          <thead>
            <tr>
              <th scope="col">Check</th>
              <th scope="col">Largest</th>
              <th scope="col">Allowed</th>
            </tr>
          </thead>
          <tbody>
            {checks.map(({ name, worst, tolerance }) => (
              <tr key={name}>
                <th scope="row">{words(name)}</th>
                <td>{real(worst)}</td>
                <td>{real(tolerance)}</td>
              </tr>
            ))}
          </tbody>
        </table>
      </div>
    </details>
  );
}

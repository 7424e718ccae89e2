import { useState } from 'preact/hooks';
import type { Check, Validation } from 'mandoline-wasm';
import type { App } from '../app';
import type { Model } from '../../model/types';
import { integer, real, words } from '../../model/format';
import { Section } from './controls/section';

/** Validates the cut-mesh and lists every check. */
export function ChecksPanel({ app }: { app: App }) {
  const { model } = app;
  const [isRunning, setRunning] = useState(false);
  const [last, setLast] = useState<{ of: Model | null; validation: Validation } | null>(null);
  const validation = last && last.of === model ? last.validation : null;
  const validate = async () => {
    setRunning(true);
    const found = await app.validate();
    setRunning(false);
    if (found) setLast({ of: model, validation: found });
  };
  return (
    <Section app={app} id="checks" title="Checks">
      <p class="hint">Checks every invariant of the cut-mesh, from the result and the input alone.</p>
      <div class="row">
        <button type="button" id="validate" disabled={isRunning || !model} onClick={() => void validate()}>
          {isRunning ? 'Validating…' : 'Validate'}
        </button>
      </div>
      <Result app={app} validation={validation} />
    </Section>
  );
}

function Result({ app, validation }: { app: App; validation: Validation | null }) {
  const { pass, checks } = validation ?? { checks: [] };
  const failed = checks.filter((check) => !check.pass).length;
  const skipped = checks.filter((check) => check.skipped).length;
  const passed = checks.length - failed - skipped;
  const verdict = pass ? `All ${passed} checks pass.` : `${integer(failed)} of ${checks.length} checks failed.`;
  const notApplied = skipped > 0 ? ` ${integer(skipped)} skipped: ${skipped === 1 ? 'it does' : 'they do'} not apply to this mesh.` : '';
  const counts = validation && { 'data-pass': String(pass), 'data-passed': passed, 'data-failed': failed, 'data-skipped': skipped };
  return (
    <div id="validation" aria-live="polite" {...counts}>
      {validation && (
        <>
          <p class={pass ? 'verdict good' : 'verdict bad'}>{verdict + notApplied}</p>
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

import type { App } from '../app';
import type { StepKind } from '../../model/instead';
import { Section } from './controls/section';
import { StepChoices } from './step_choices';

const steps: readonly [StepKind, string][] = [
  ['triEdges', 'Tri-edges'],
  ['hybridEdges', 'Hybrid edges'],
  ['triangleFaces', 'Cut-faces'],
  ['axialPlane', 'Axial plane'],
  ['gridCell', 'Grid cell'],
];

/** Walks through the algorithm on the current mesh. */
export function StepsPanel({ app }: { app: App }) {
  const picture = app.state.step.value;
  return (
    <Section app={app} id="steps" title="Steps">
      <p class="hint">How this mesh is cut, from edges to cells.</p>
      <Stepper app={app} />
      <div hidden={!picture}>
        <p id="step-text" class="step-text" aria-live="polite">
          {picture?.text}
        </p>
        <StepChoices app={app} />
        <div class="row">
          <button type="button" id="step-leave" onClick={() => void app.inspector.step(null)}>
            Back to the model
          </button>
        </div>
      </div>
    </Section>
  );
}

function Stepper({ app }: { app: App }) {
  const hasModel = app.model !== null;
  const current = steps.findIndex(([kind]) => kind === app.state.step.value?.kind);
  const go = (index: number) => {
    const [kind] = steps[Math.min(Math.max(index, 0), steps.length - 1)];
    void app.inspector.step({ kind });
  };
  const turn = (event: KeyboardEvent) => {
    if (event.key !== 'ArrowLeft' && event.key !== 'ArrowRight') return;
    event.preventDefault();
    go(current + (event.key === 'ArrowRight' ? 1 : -1));
  };
  return (
    <div role="group" aria-label="Steps of the algorithm" onKeyDown={turn}>
      <ol class="stepper">
        {steps.map(([kind, name], i) => (
          <li key={kind}>
            <button
              type="button"
              id={`step-${kind}`}
              class="step"
              disabled={!hasModel}
              aria-current={i === current ? 'step' : undefined}
              onClick={() => go(i)}
            >
              <span class="number">{i + 1}</span> {name}
            </button>
          </li>
        ))}
      </ol>
      <div class="row">
        <button type="button" id="step-previous" disabled={!hasModel || current <= 0} onClick={() => go(current - 1)}>
          ‹ Previous
        </button>
        <button type="button" id="step-next" disabled={!hasModel || current === steps.length - 1} onClick={() => go(current + 1)}>
          {current < 0 ? 'Start ›' : 'Next ›'}
        </button>
      </div>
    </div>
  );
}

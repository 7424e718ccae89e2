import type { App } from '../app';
import type { StepKind, StepPicture, StepRequest } from '../../model/types';
import { axes } from '../../model/settings';
import { button, choice, el, numberField, slider } from './dom';
import { section } from './section';

const steps: readonly [StepKind, string][] = [
  ['triEdges', 'Tri-edges'],
  ['hybridEdges', 'Hybrid edges'],
  ['triangleFaces', 'Cut-faces'],
  ['axialPlane', 'Axial plane'],
  ['gridCell', 'Grid cell'],
];

/** Walks through the algorithm on the current mesh. */
export function stepsPanel(app: App): HTMLElement {
  const intro = el('p', { class: 'hint' }, 'How this mesh is cut, from edges to cells.');
  const text = el('p', { id: 'step-text', class: 'step-text', 'aria-live': 'polite' });
  const back = button('Back to the model', () => void app.step(null), { id: 'step-leave' });
  const body = el('div', { hidden: true }, text, choices(app), el('div', { class: 'row' }, back));
  app.events.on('step', (picture) => {
    body.hidden = picture === null;
    text.textContent = picture?.text ?? '';
  });
  return section('steps', 'Steps', false, intro, stepper(app), body);
}

function stepper(app: App): HTMLElement {
  let current = -1;
  const go = (index: number) => {
    const step = steps[Math.min(Math.max(index, 0), steps.length - 1)];
    void app.step({ kind: step[0] });
  };
  const buttons = steps.map(([kind, name], i) => {
    const number = el('span', { class: 'number' }, String(i + 1));
    return el('button', { type: 'button', id: `step-${kind}`, class: 'step', click: () => go(i) }, number, ` ${name}`);
  });
  const previous = button('‹ Previous', () => go(current - 1), { id: 'step-previous' });
  const next = button('Next ›', () => go(current + 1), { id: 'step-next' });
  const keydown = (event: Event) => {
    const { key } = event as KeyboardEvent;
    if (key !== 'ArrowLeft' && key !== 'ArrowRight') return;
    event.preventDefault();
    go(current + (key === 'ArrowRight' ? 1 : -1));
  };
  const show = () => {
    for (const item of buttons) item.disabled = app.model === null;
    buttons.forEach((item, i) => (i === current ? item.setAttribute('aria-current', 'step') : item.removeAttribute('aria-current')));
    previous.disabled = app.model === null || current <= 0;
    next.disabled = app.model === null || current === steps.length - 1;
    next.textContent = current < 0 ? 'Start ›' : 'Next ›';
  };
  app.events.on('model', show);
  app.events.on('step', (picture) => {
    current = steps.findIndex(([kind]) => kind === picture?.kind);
    show();
  });
  show();
  const list = el('ol', { class: 'stepper' }, ...buttons.map((item) => el('li', {}, item)));
  return el('div', { role: 'group', 'aria-label': 'Steps of the algorithm', keydown }, list, el('div', { class: 'row' }, previous, next));
}

/** Which triangle, plane or grid cell to show, as far as it matters to the step. */
function choices(app: App): HTMLElement {
  let request: StepRequest = { kind: 'triEdges' };
  const ask = (part: Partial<StepRequest>) => {
    request = { ...request, ...part }; // The next choice may come before this one's picture.
    void app.step(request);
  };
  const triangle = numberSlider('step-triangle', 'Triangle', (value) => ask({ triangle: value }));
  const axis = choice(
    'step-axis',
    'Axis',
    [
      ['0', 'x'],
      ['1', 'y'],
      ['2', 'z'],
    ],
    (value) => {
      ask({ axis: Number(value) as 0 | 1 | 2, plane: undefined });
    },
  );
  const plane = numberSlider('step-plane', 'Plane', (value) => ask({ plane: value }));
  const cell = ([0, 1, 2] as const).map((d) =>
    numberSlider(`step-cell-${axes[d]}`, `Grid cell, ${axes[d]}`, (value) => {
      const [i, j, k] = request.gridCell ?? [0, 0, 0];
      ask({ gridCell: [d === 0 ? value : i, d === 1 ? value : j, d === 2 ? value : k] });
    }),
  );
  const planeChoice = el('div', {}, axis.element, plane.element);
  const cellChoice = el('div', {}, ...cell.map((item) => item.element));

  const show = ({ choices: { triangles, planes, request: shown } }: StepPicture) => {
    request = shown;
    triangle.element.hidden = shown.triangle === undefined;
    triangle.set(shown.triangle ?? 0, triangles - 1);
    planeChoice.hidden = shown.plane === undefined;
    axis.set(String(shown.axis ?? 0) as '0' | '1' | '2');
    plane.set(shown.plane ?? 0, planes[shown.axis ?? 0] - 1);
    cellChoice.hidden = shown.gridCell === undefined;
    cell.forEach((item, d) => item.set(shown.gridCell?.[d] ?? 0, planes[d] - 2));
  };
  app.events.on('step', (picture) => picture && show(picture));
  return el('div', { id: 'step-choices' }, triangle.element, planeChoice, cellChoice);
}

/** A slider from 0 with a number field beside it. */
function numberSlider(id: string, label: string, onInput: (value: number) => void) {
  const range = slider({ id, label, min: 0, max: 1, step: 1, onInput });
  const number = numberField({ id: `${id}-number`, label: `${label}, number`, hideLabel: true, min: 0, onChange: onInput });
  const set = (value: number, last: number) => {
    range.input.max = number.input.max = String(last);
    range.set(value);
    number.set(value);
  };
  return { element: el('div', { class: 'with-number' }, range.element, number.element), set };
}

import type { Check, Validation } from 'mandoline-wasm';
import type { App } from '../app';
import { button, el } from './dom';
import { integer, real, words } from '../../model/format';
import { section } from './section';

/** Validates the cut-mesh and lists every check. */
export function checksPanel(app: App): HTMLElement {
  const intro = el('p', { class: 'hint' }, 'Checks every invariant of the cut-mesh, from the result and the input alone.');
  const result = el('div', { id: 'validation', 'aria-live': 'polite' });
  const run = button('Validate', () => void validate(), { id: 'validate' });
  async function validate(): Promise<void> {
    run.disabled = true;
    run.textContent = 'Validating…';
    const model = app.model;
    const validation = await app.validate();
    run.disabled = app.model === null;
    run.textContent = 'Validate';
    if (validation && model === app.model) show(result, validation, app);
  }
  app.events.on('model', (model) => {
    run.disabled = model === null;
    result.replaceChildren();
    delete result.dataset.pass;
  });
  return section('checks', 'Checks', false, intro, el('div', { class: 'row' }, run), result);
}

function show(result: HTMLElement, { pass, checks }: Validation, app: App): void {
  const failed = checks.filter((check) => !check.pass).length;
  const skipped = checks.filter((check) => check.skipped).length;
  const passed = checks.length - failed - skipped;
  Object.assign(result.dataset, { pass, passed, failed, skipped });
  const verdict = pass ? `All ${passed} checks pass.` : `${integer(failed)} of ${checks.length} checks failed.`;
  const notApplied = skipped > 0 ? ` ${integer(skipped)} skipped: ${skipped === 1 ? 'it does' : 'they do'} not apply to this mesh.` : '';
  const head = el('p', { class: pass ? 'verdict good' : 'verdict bad' }, verdict + notApplied);
  const list = el('ul', { class: 'check-list' }, ...checks.map((check) => item(check, app)));
  result.replaceChildren(head, list, deviations(checks.filter((check) => !check.skipped && check.tolerance > 0)));
}

function item(check: Check, app: App): HTMLElement {
  const state = check.skipped ? 'skipped' : check.pass ? 'pass' : 'fail';
  const line = el('li', { class: state, 'data-check': check.name, 'data-state': state });
  line.append(el('span', { class: 'mark' }, state), el('strong', {}, words(check.name)));
  const verdict = check.tolerance === 0 ? 'no violations' : 'exact, up to rounding';
  if (check.pass && !check.skipped) line.append(el('span', { class: 'hint' }, verdict));
  if (check.message) line.append(el('span', { class: 'message' }, check.message));
  if (!check.pass && check.elementKind === 'cell') {
    line.append(button(`Show cell ${check.element}`, () => void app.pin(check.element), { class: 'quiet' }));
  }
  return line;
}

/** The raw numbers behind "up to rounding". */
function deviations(checks: readonly Check[]): HTMLElement {
  const rows = checks.map(({ name, worst, tolerance }) => {
    return el('tr', {}, el('th', { scope: 'row' }, words(name)), el('td', {}, real(worst)), el('td', {}, real(tolerance)));
  });
  const head = el('tr', {}, ...['Check', 'Largest', 'Allowed'].map((title) => el('th', { scope: 'col' }, title)));
  const unit = el('p', { class: 'hint' }, 'In roundings: half units in the last place of the largest coordinate.');
  const table = el('table', { class: 'deviations' }, el('thead', {}, head), el('tbody', {}, ...rows));
  return el('details', { id: 'deviations' }, el('summary', {}, 'Deviations'), el('div', {}, unit, table));
}

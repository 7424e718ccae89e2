import type { Check, Validation } from 'mandoline-wasm';
import type { App } from '../app';
import { button, el } from './dom';
import { integer, plural, real, words } from '../../model/format';
import { section } from './section';

/** Validates the cut-mesh from its arrays alone and lists every check. */
export function checksPanel(app: App): HTMLElement {
  const intro = el('p', { class: 'hint' }, 'Every invariant of the cut-mesh, worked out anew from the result and the input.');
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
  const verdict = pass ? `All ${passed} checks pass.` : `${plural(failed, 'check')} of ${checks.length} failed.`;
  const notApplied = skipped > 0 ? ` ${integer(skipped)} skipped: not for a mesh like this.` : '';
  const head = el('p', { class: pass ? 'verdict good' : 'verdict bad' }, verdict + notApplied);
  result.replaceChildren(head, el('ul', { class: 'check-list' }, ...checks.map((check) => item(check, app))));
}

function item(check: Check, app: App): HTMLElement {
  const state = check.skipped ? 'skipped' : check.pass ? 'pass' : 'fail';
  const line = el('li', { class: state, 'data-check': check.name, 'data-state': state });
  line.append(el('span', { class: 'mark' }, state), el('strong', {}, words(check.name)));
  if (!check.skipped) line.append(el('span', { class: 'hint' }, worst(check)));
  if (check.message) line.append(el('span', { class: 'message' }, check.message));
  if (check.elementKind !== '' && check.element >= 0) line.append(element(check, app));
  return line;
}

/** A check with a tolerance of 0 counts violations, the others measure in roundings. */
function worst({ worst: value, tolerance }: Check): string {
  if (tolerance === 0) return value === 0 ? 'no violation' : plural(value, 'violation');
  return `worst ${real(value)} of ${real(tolerance)} roundings allowed`;
}

function element({ elementKind, element: id }: Check, app: App): HTMLElement {
  const label = `at ${elementKind} ${id}`;
  return elementKind === 'cell' ? button(label, () => void app.pin(id), { class: 'quiet' }) : el('span', { class: 'hint' }, label);
}

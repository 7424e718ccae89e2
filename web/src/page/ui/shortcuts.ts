import type { App } from '../app';
import type { Axis } from '../../model/types';
import { button, el, terms } from './dom';

const help: [string, string][] = [
  ['F', 'frame the model'],
  ['X Y Z', 'slice along an axis, on and off'],
  ['Esc', 'unpin the cell, or leave the steps'],
  ['← →', 'previous and next step, in the steps'],
  ['?', 'this list'],
];
const mouse: [string, string][] = [
  ['drag', 'turn'],
  ['right drag, two fingers', 'move'],
  ['wheel, pinch', 'zoom'],
  ['click a cell', 'pin it and see its card'],
];

/** The shortcuts, and the button that lists them. */
export function shortcuts(app: App): HTMLElement {
  const dialog = el('dialog', { id: 'shortcuts', 'aria-labelledby': 'shortcuts-title' });
  dialog.append(
    el('h2', { id: 'shortcuts-title' }, 'Keyboard and pointer'),
    terms([...help, ...mouse].map(([keys, what]) => [keys, what])),
    button('Close', () => dialog.close()),
  );
  document.body.append(dialog);
  addEventListener('keydown', (event) => {
    if (event.ctrlKey || event.metaKey || event.altKey || dialog.open || isTyping(event.target)) return;
    act(app, dialog, event.key);
  });
  return button('?', () => dialog.showModal(), { id: 'help', class: 'quiet', 'aria-label': 'Keyboard and pointer' });
}

function act(app: App, dialog: HTMLDialogElement, key: string): void {
  if (key === '?') dialog.showModal();
  else if (key === 'Escape') app.leave();
  else if (key.toLowerCase() === 'f') app.frame();
  else if ('xyz'.includes(key.toLowerCase())) {
    const axis = key.toLowerCase() as Axis;
    app.changeSlice(axis, { on: !app.settings.slices[axis].on });
  }
}

function isTyping(target: EventTarget | null): boolean {
  if (target instanceof HTMLInputElement) return !['range', 'checkbox', 'radio'].includes(target.type);
  return target instanceof HTMLSelectElement || target instanceof HTMLTextAreaElement;
}

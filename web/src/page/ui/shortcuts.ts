import type { App } from '../app';
import type { Axis } from '../../model/types';
import { button, el, terms } from './dom';

const help: [string, string][] = [
  ['F', 'fit view'],
  ['X Y Z', 'slice along an axis, on or off'],
  ['Esc', 'unpin the cell, or leave the steps'],
  ['← →', 'in the steps: previous and next'],
  ['?', 'show this list'],
];
const mouse: [string, string][] = [
  ['drag, arrow keys', 'rotate'],
  ['right drag, two fingers, Shift + arrow keys', 'pan'],
  ['wheel, pinch, +\u00a0and\u00a0−', 'zoom'],
  ['click a cell', 'pin it and show its card'],
];

/** The shortcuts, and the button that lists them. */
export function shortcuts(app: App): HTMLElement {
  const dialog = el('dialog', { id: 'shortcuts', 'aria-labelledby': 'shortcuts-title' });
  dialog.append(
    el('h2', { id: 'shortcuts-title' }, 'Keyboard, mouse and touch'),
    terms([...help, ...mouse].map(([keys, what]) => [keys, what])),
    button('Close', () => dialog.close()),
  );
  document.body.append(dialog);
  addEventListener('keydown', (event) => {
    if (event.ctrlKey || event.metaKey || event.altKey || dialog.open || isTyping(event.target)) return;
    act(app, dialog, event.key);
  });
  return button('?', () => dialog.showModal(), { id: 'help', class: 'quiet', 'aria-label': 'Keyboard, mouse and touch' });
}

function act(app: App, dialog: HTMLDialogElement, key: string): void {
  if (key === '?') dialog.showModal();
  else if (key === 'Escape') app.leave();
  else if (key.toLowerCase() === 'f') app.fit();
  else if ('xyz'.includes(key.toLowerCase())) {
    const axis = key.toLowerCase() as Axis;
    app.changeSlice(axis, { on: !app.settings.slices[axis].on });
  }
}

function isTyping(target: EventTarget | null): boolean {
  if (target instanceof HTMLInputElement) return !['range', 'checkbox', 'radio'].includes(target.type);
  return target instanceof HTMLSelectElement || target instanceof HTMLTextAreaElement;
}

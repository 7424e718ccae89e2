import { useEffect, useRef } from 'preact/hooks';
import type { App } from '../app';
import { axes, type Axis } from '../../model/slices';
import { Terms } from './controls/terms';

const help: [string, string][] = [
  ['F', 'fit view'],
  ['X Y Z', 'slice along an axis, on or off'],
  ['1 2 3', 'look along x, y or z; again: from the other side'],
  ['M', 'measure a distance'],
  ['Esc', 'end measuring, unpin the cell, or go back to the model'],
  ['← →', 'in the steps: previous and next'],
  ['?', 'show this list'],
];
const mouse: [string, string][] = [
  ['drag, arrow keys', 'rotate'],
  ['right drag, two fingers, Shift + arrow keys', 'pan'],
  ['wheel, pinch, +\u00a0and\u00a0−', 'zoom'],
  ['click a cell', 'pin it and show its card'],
  ['double click a cell, or beside all', 'fly there, or back'],
  ['drag the arrow of the wind', 'turn the wind'],
  ['drag the divider of a comparison, arrow keys', 'show more of one side'],
];

/** The shortcuts, and the button that lists them. */
export function Shortcuts({ app }: { app: App }) {
  const dialog = useRef<HTMLDialogElement>(null);
  useEffect(() => {
    const press = (event: KeyboardEvent) => {
      const list = dialog.current;
      if (!list || event.ctrlKey || event.metaKey || event.altKey || list.open || isTyping(event.target)) return;
      if (event.key === '?') list.showModal();
      else act(app, event.key);
    };
    addEventListener('keydown', press);
    return () => removeEventListener('keydown', press);
  }, [app]);
  return (
    <>
      <button type="button" id="help" class="quiet" aria-label="Keyboard, mouse and touch" onClick={() => dialog.current?.showModal()}>
        ?
      </button>
      <dialog ref={dialog} id="shortcuts" aria-labelledby="shortcuts-title">
        <h2 id="shortcuts-title">Keyboard, mouse and touch</h2>
        <Terms list={[...help, ...mouse]} />
        <button type="button" onClick={() => dialog.current?.close()}>
          Close
        </button>
      </dialog>
    </>
  );
}

function act(app: App, key: string): void {
  if (key === 'Escape') leave(app);
  else if (key.toLowerCase() === 'm') app.toggleMeasure();
  else if (key.toLowerCase() === 'f') app.fit();
  else if ('123'.includes(key)) app.lookAlong(axes[Number(key) - 1]);
  else if ('xyz'.includes(key.toLowerCase())) {
    const axis = key.toLowerCase() as Axis;
    app.changeSlice(axis, { on: !app.settings.slices[axis].on });
  }
}

function leave(app: App): void {
  if (app.state.measurement.value) app.measuring.end();
  else app.inspector.leave();
}

function isTyping(target: EventTarget | null): boolean {
  if (target instanceof HTMLInputElement) return !['range', 'checkbox', 'radio'].includes(target.type);
  return target instanceof HTMLSelectElement || target instanceof HTMLTextAreaElement;
}

import type { App } from '../app';
import { button, el } from './dom';
import { words } from '../../model/format';

/** The progress of loading and cutting, on top of the picture; appears only if they take a while. */
export function progressLine(app: App): HTMLElement {
  const bar = el('progress', { max: 1, value: 0, 'aria-label': 'Progress' });
  const stage = el('span', { class: 'hint' });
  const cancel = button('Cancel', () => app.cancel(), { id: 'cancel', class: 'quiet' });
  const line = el('div', { class: 'progress', id: 'progress', hidden: true }, bar, stage, cancel);
  let timer = 0;
  app.events.on('work', (work) => {
    if (work === 'cutting') bar.value = 0;
    else bar.removeAttribute('value'); // nobody knows how much is left to load
    stage.textContent = work === 'loading' ? 'Loading' : '';
    if (work && line.hidden && timer === 0) timer = window.setTimeout(() => (line.hidden = false), 150);
    if (work) return;
    clearTimeout(timer);
    timer = 0;
    line.hidden = true;
  });
  app.events.on('progress', (progress) => {
    if (!progress) return;
    bar.value = progress.fraction;
    stage.textContent = words(progress.stage);
  });
  return line;
}

import type { App } from '../app';
import { button, el } from './dom';
import { words } from '../../model/format';

/** How far loading and cutting are, over the picture; seen only if they take long. */
export function progressLine(app: App): HTMLElement {
  const bar = el('progress', { max: 1, value: 0, 'aria-label': 'Progress' });
  const stage = el('span', { class: 'hint' });
  const line = el('div', { class: 'progress', id: 'progress', hidden: true }, bar, stage, button('Cancel', () => app.cancel(), { id: 'cancel', class: 'quiet' }));
  let timer = 0;
  app.events.on('work', (work) => {
    if (work === 'cutting') bar.value = 0;
    else bar.removeAttribute('value'); // how far loading is, nobody knows
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

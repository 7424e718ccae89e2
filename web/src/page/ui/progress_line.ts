import type { App } from '../app';
import { button, el } from './dom';
import { words } from '../../model/format';

/** How far the cut is, over the picture; seen only if it takes long. */
export function progressLine(app: App): HTMLElement {
  const bar = el('progress', { max: 1, value: 0, 'aria-label': 'Progress of the cut' });
  const stage = el('span', { class: 'hint' });
  const line = el('div', { class: 'progress', id: 'progress', hidden: true }, bar, stage, button('Cancel', () => app.cancel(), { id: 'cancel', class: 'quiet' }));
  let timer = 0;
  app.events.on('cutting', (cutting) => {
    clearTimeout(timer);
    line.hidden = true;
    if (cutting) timer = window.setTimeout(() => (line.hidden = false), 150);
  });
  app.events.on('progress', (progress) => {
    bar.value = progress?.fraction ?? 0;
    stage.textContent = progress ? words(progress.stage) : '';
  });
  return line;
}

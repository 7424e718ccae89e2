import type { App } from '../app';
import { legend as entriesOf } from '../view/colors';
import { insideWords } from '../../model/inside';
import type { Model } from '../../model/types';
import { el } from './dom';

/** What the colours mean, on top of the picture. */
export function legend(app: App): HTMLElement {
  const box = el('div', { class: 'legend', id: 'legend', role: 'group', 'aria-label': 'Colours' });
  const show = () => {
    const entries = app.model ? entriesOf(app.model, app.settings) : [];
    box.hidden = entries.length === 0 || box.dataset.step === 'true';
    box.replaceChildren(...entries.map(({ color, label }) => entry(color, label)), ...(app.model ? doubt(app.model) : []));
  };
  app.events.on('settings', show);
  app.events.on('step', (picture) => {
    box.dataset.step = String(picture !== null);
    show();
  });
  return box;
}

/** What tells the inside from the outside, unless winding numbers do. */
function doubt({ insideBy }: Model): HTMLElement[] {
  return insideBy === 'winding' ? [] : [el('span', { class: 'doubt' }, `inside ${insideWords[insideBy]}`)];
}

function entry(color: string, label: string): HTMLElement {
  const swatch = el('span', { class: 'swatch' });
  swatch.style.background = color;
  return el('span', { class: 'entry' }, swatch, label);
}

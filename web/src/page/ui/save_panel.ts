import type { App } from '../app';
import { toHash } from '../../model/settings';
import { button, el } from './dom';
import { section } from './section';

const writers = [
  ['json', 'JSON', 'all arrays', 'application/json'],
  ['vtu', 'VTU', 'cells for ParaView', 'application/xml'],
  ['obj', 'OBJ', 'surface by region', 'text/plain'],
] as const;

/** Saves the result and the view as files, or as a link. */
export function savePanel(app: App): HTMLElement {
  const files = writers.map(([format, label, what, type]) =>
    saver(app, format, label, what, async () => {
      const bytes = await app.write(format);
      return bytes && new Blob([bytes as Uint8Array<ArrayBuffer>], { type });
    }),
  );
  const seen = [
    saver(app, 'glb', 'GLB', 'visible geometry', () => app.ask(app.view.glb())),
    saver(app, 'png', 'PNG', 'screenshot', () => app.ask(app.view.png())),
  ];
  const list = el('ul', { class: 'savers' }, ...[...files, ...seen].map((item) => el('li', {}, item)));
  return section('save', 'Save', false, list, linkRow(app));
}

function saver(app: App, format: string, label: string, what: string, make: () => Promise<Blob | null>): HTMLElement {
  const text = [el('strong', {}, label), el('small', {}, what)];
  const item = el('button', { type: 'button', id: `save-${format}`, click: () => void save() }, ...text);
  async function save(): Promise<void> {
    if (!app.model) return;
    const name = `${app.model.name}-${app.model.grid.cells.join('x')}.${format}`.replaceAll(/[^\w.-]+/g, '-');
    item.disabled = true;
    const blob = await make();
    item.disabled = app.model === null;
    if (blob) download(blob, name);
  }
  app.events.on('model', (model) => (item.disabled = model === null));
  return item;
}

function download(blob: Blob, name: string): void {
  const url = URL.createObjectURL(blob);
  el('a', { href: url, download: name }).click();
  setTimeout(() => URL.revokeObjectURL(url), 10000);
}

function linkRow(app: App): HTMLElement {
  const link = el('input', { id: 'link', readonly: true, hidden: true, 'aria-label': 'Link to this view' });
  const status = el('span', { class: 'hint', 'aria-live': 'polite', id: 'link-status' });
  async function copy(): Promise<void> {
    const url = `${location.href.split('#')[0]}#${toHash(app.settings)}`;
    const fileNote = app.settings.source.kind === 'file' ? ' The file itself is not included.' : '';
    try {
      await navigator.clipboard.writeText(url);
      status.textContent = `Copied.${fileNote}`;
    } catch {
      link.hidden = false;
      link.value = url;
      link.select();
      status.textContent = `Copy it from the field below.${fileNote}`;
    }
  }
  return el(
    'div',
    { class: 'row' },
    button('Copy link', () => void copy(), { id: 'copy-link' }),
    status,
    link,
  );
}

import type { App } from '../app';
import { fileExtensions } from '../../model/formats';
import { fileError } from '../../model/failure';
import { gallery } from '../../model/gallery/list';
import { button, el } from './dom';
import { integer, plural } from '../../model/format';
import { section } from './section';

/** Pickers only look at the last extension. */
const fileTypes = [...fileExtensions, '.gz'].join();

/** Which mesh is cut: from the gallery, a file or a URL. */
export function meshPanel(app: App): HTMLElement {
  return section('mesh', 'Mesh', true, meshLine(app), galleryList(app), fileButton(app), urlForm(app));
}

function meshLine(app: App): HTMLElement {
  const line = el('p', { class: 'line', id: 'mesh-line', 'aria-live': 'polite' });
  app.events.on('mesh', ({ name, triangles }) => {
    Object.assign(line.dataset, { name, triangles });
    const title = gallery.find((entry) => entry.name === name)?.title ?? name;
    line.replaceChildren(el('strong', {}, title), ` ${plural(triangles, 'triangle')}`);
  });
  return line;
}

function galleryList(app: App): HTMLElement {
  const list = el('ul', { class: 'gallery', id: 'gallery', 'aria-label': 'Gallery' });
  const buttons = gallery.map(({ name, title, line, cells }) => {
    const open = el(
      'button',
      { type: 'button', 'data-name': name, 'aria-pressed': 'false', click: () => void app.open({ kind: 'gallery', name }, { cells }) },
      el('strong', {}, title),
      el('small', {}, line),
    );
    list.append(el('li', {}, open));
    return open;
  });
  let chosen: HTMLElement | undefined;
  const reveal = () => chosen?.scrollIntoView({ block: 'nearest' });
  app.events.on('settings', ({ source }) => {
    const former = chosen;
    chosen = buttons.find((item) => source.kind === 'gallery' && source.name === item.dataset.name);
    if (chosen === former) return;
    for (const item of buttons) item.setAttribute('aria-pressed', String(item === chosen));
    reveal();
  });
  let isHidden = true;
  const panelOpened = new ResizeObserver(() => {
    if (isHidden && list.clientHeight > 0) reveal();
    isHidden = list.clientHeight === 0;
  });
  panelOpened.observe(list);
  return list;
}

function fileButton(app: App): HTMLElement {
  const hidden = { class: 'visually-hidden', tabindex: '-1', 'aria-label': 'Mesh file' };
  const input = el('input', { type: 'file', id: 'file', accept: fileTypes, ...hidden });
  input.addEventListener('change', () => {
    const file = input.files?.[0];
    if (file) void openFile(app, file);
    input.value = '';
  });
  const hint = el('span', { class: 'hint' }, 'or drop one anywhere: OBJ, STL, PLY, OFF, GLB');
  return el(
    'div',
    { class: 'row' },
    button('Open a file…', () => input.click(), { id: 'open-file' }),
    input,
    hint,
  );
}

const unreadable = "The browser can't read it: it is a folder, or it was moved or changed meanwhile. Open a file that holds a mesh.";

async function openFile(app: App, file: File): Promise<void> {
  const bytes = await app.ask(file.arrayBuffer().catch(() => Promise.reject(fileError(file.name, unreadable))));
  if (bytes) await app.open({ kind: 'file', name: file.name }, { bytes });
}

function urlForm(app: App): HTMLElement {
  const plain = { autocomplete: 'off', spellcheck: 'false' };
  const input = el('input', { type: 'url', id: 'url', placeholder: 'https://…/mesh.obj', required: true, ...plain });
  const submit = (event: Event) => {
    event.preventDefault();
    void app.open({ kind: 'url', url: input.value });
  };
  const label = el('label', { for: 'url', class: 'visually-hidden' }, 'URL of a mesh');
  return el('form', { class: 'row', id: 'url-form', submit }, label, input, el('button', { id: 'open-url' }, 'Load'));
}

/** Of several files the one to open: the first that is a mesh by its name. */
function firstMesh(files: readonly File[]): File | undefined {
  const isMesh = ({ name }: File) => fileExtensions.some((extension) => name.toLowerCase().endsWith(extension));
  return files.find(isMesh) ?? files[0];
}

const mostNames = 5;

function namesOf(files: readonly File[]): string {
  const more = files.length > mostNames ? ` and ${integer(files.length - mostNames)} more` : '';
  const names = files.slice(0, mostNames).map(({ name }) => name);
  return names.join(', ') + more;
}

/** Files dropped anywhere on the page. */
export function acceptDrops(app: App, notice: (text: string) => void): void {
  const veil = el('div', { class: 'drop-veil', hidden: true }, 'Drop a mesh to cut it');
  document.body.append(veil);
  const hasFiles = (event: DragEvent) => event.dataTransfer?.types.includes('Files') ?? false;
  addEventListener('dragover', (event) => {
    if (!hasFiles(event)) return;
    event.preventDefault();
    veil.hidden = false;
  });
  addEventListener('dragleave', (event) => {
    if (!event.relatedTarget) veil.hidden = true;
  });
  addEventListener('drop', (event) => {
    veil.hidden = true;
    if (!hasFiles(event)) return;
    event.preventDefault();
    const files = Array.from(event.dataTransfer?.files ?? []);
    const file = firstMesh(files);
    if (!file) return;
    const others = files.filter((other) => other !== file);
    if (others.length > 0) notice(`The page shows one mesh at a time: ${file.name}. Not opened: ${namesOf(others)}.`);
    void openFile(app, file);
  });
}

import type { App } from '../app';
import { colorings, layers, sliceNames } from '../../model/settings';
import type { ColorBy, Model, SliceName } from '../../model/types';
import { button, checkbox, choice, el, numberField, select, slider } from './dom';
import { insideOf, isOutside } from '../../model/inside';
import { plural, real } from '../../model/format';
import { section } from './section';

const colorNames: Record<ColorBy, string> = {
  region: 'region',
  winding: 'winding number',
  cell: 'cell',
  volume: 'volume',
  kind: 'face type',
};
const layerNames: Record<(typeof layers)[number], string> = {
  surface: 'surface',
  gridFaces: 'grid-faces',
  edges: 'edges',
  untouched: 'untouched cells',
  cutCells: 'cut-cells',
  outside: 'outside',
};

/** How the cut-mesh is shown. */
export function viewPanel(app: App): HTMLElement {
  const parts = [slices, explosion, coloring, visibility, oneRegion, pinByNumber, resets];
  return section('view', 'View', true, ...parts.map((part) => part(app)));
}

function slices(app: App): HTMLElement {
  const mode = choice(
    'slice-mode',
    'Sliced cells',
    [
      ['whole', 'whole'],
      ['flat', 'cut flat'],
    ],
    (sliceMode) => app.change({ sliceMode }),
  );
  app.events.on('settings', ({ sliceMode }) => mode.set(sliceMode));
  return el('fieldset', { class: 'slices' }, el('legend', {}, 'Slice'), ...sliceNames.map((name) => sliceRow(app, name)), mode.element);
}

function sliceRow(app: App, name: SliceName): HTMLElement {
  const label = name === 'free' ? 'free' : name;
  const on = checkbox(`slice-${name}`, label, (checked) => app.changeSlice(name, { on: checked }));
  const position = slider({
    id: `slice-${name}-position`,
    label: `Position of the ${label} plane`,
    hideLabel: true,
    min: 0,
    max: 1,
    step: 0.002,
    onInput: (value) => app.changeSlice(name, { position: value, on: true }),
  });
  const flip = button('flip', () => app.flip(name), { id: `slice-${name}-flip`, class: 'quiet', 'aria-label': `Flip the ${label} plane` });
  app.events.on('settings', ({ slices: all }) => {
    on.input.checked = all[name].on;
    position.set(all[name].position);
    row.classList.toggle('off', !all[name].on);
  });
  const row = el('div', { class: 'slice' }, on.element, position.element, flip);
  return row;
}

function explosion(app: App): HTMLElement {
  const percent = (x: number) => `${Math.round(100 * x)}%`;
  const make = (key: 'cells' | 'regions', label: string) => {
    const control = slider({
      id: `explode-${key}`,
      label,
      min: 0,
      max: 1,
      step: 0.01,
      format: percent,
      onInput: (value) => app.change({ explode: { ...app.settings.explode, [key]: value } }),
    });
    app.events.on('settings', ({ explode }) => control.set(explode[key]));
    return control.element;
  };
  return el('fieldset', {}, el('legend', {}, 'Explode'), make('cells', 'by cell'), make('regions', 'by region'));
}

function coloring(app: App): HTMLElement {
  const control = select('color-by', 'Colour by', (value) => app.change({ colorBy: value as ColorBy }));
  control.input.append(...colorings.map((name) => el('option', { value: name }, colorNames[name])));
  app.events.on('settings', ({ colorBy }) => (control.input.value = colorBy));
  return control.element;
}

function visibility(app: App): HTMLElement {
  const boxes = layers.map((layer) => {
    const box = checkbox(`show-${layer}`, layerNames[layer], (checked) => app.changeShow({ [layer]: checked }));
    app.events.on('settings', ({ show }) => (box.input.checked = show[layer]));
    return box.element;
  });
  return el('fieldset', {}, el('legend', {}, 'Show'), el('div', { class: 'checks' }, ...boxes));
}

function oneRegion(app: App): HTMLElement {
  const control = select('region', 'Region', (value) => app.changeShow({ region: value === '' ? null : Number(value) }));
  app.events.on('model', (model) => control.input.replaceChildren(...(model ? regionOptions(model) : [])));
  app.events.on('settings', ({ show }) => (control.input.value = show.region === null ? '' : String(show.region)));
  return control.element;
}

function regionOptions(model: Model): HTMLElement[] {
  const { regions } = model;
  const options = regions.slice(0, 500).map(({ id, volume, cutCells }) => {
    const name = model.insideBy === 'winding' && isOutside(model, id) ? `${id}, outside` : String(id);
    return el('option', { value: id }, `${name} · ${insideOf(model, id)} · volume ${real(volume)} · ${plural(cutCells, 'cut-cell')}`);
  });
  return [el('option', { value: '' }, `all (${regions.length})`), ...options];
}

function pinByNumber(app: App): HTMLElement {
  const field = numberField({ id: 'pin-number', label: 'Pin cut-cell', min: 0, onChange: (cell) => void app.pin(cell) });
  field.input.required = false;
  app.events.on('model', (model) => {
    field.input.disabled = model === null;
    if (model) field.input.max = String(model.counts.cutCells - 1);
  });
  app.events.on('pinned', (card) => (field.input.value = card ? String(card.cell) : ''));
  return field.element;
}

function resets(app: App): HTMLElement {
  const reset = button('Reset view', () => app.resetLook(), { id: 'reset-look' });
  return el(
    'div',
    { class: 'row' },
    button('Fit view', () => app.fit(), { id: 'fit' }),
    reset,
  );
}

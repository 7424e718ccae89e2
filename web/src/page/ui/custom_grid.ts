import type { Vector3 } from '../../model/vector';
import type { App } from '../app';
import { gridAround } from '../../model/grid_around';
import { axes } from '../../model/settings';
import type { GridSettings } from '../../model/types';
import { button, el, numberField, type NumberInput } from './dom';

type CustomGrid = Extract<GridSettings, { min: Vector3 }>;
type Rows = Record<'cells' | 'min' | 'max', NumberInput[]>;

const rowLabels = { cells: 'cells', min: 'min', max: 'max' } as const;

/** Counts and box of the grid, starting from the current one, and the snap tolerance. */
export function customGrid(app: App): HTMLElement {
  const rows: Rows = { cells: [], min: [], max: [] };
  const table = el('div', { class: 'custom-grid', role: 'group', 'aria-label': 'Custom grid' }, el('span'));
  table.append(...axes.map((axis) => el('span', { class: 'axis', 'aria-hidden': 'true' }, axis)));
  const apply = () => app.setGrid({ min: read(rows.min), max: read(rows.max), cells: read(rows.cells) });
  for (const key of ['cells', 'min', 'max'] as const) {
    table.append(el('span', { class: 'hint', 'aria-hidden': 'true' }, rowLabels[key]));
    for (const axis of axes) {
      const limits = key === 'cells' ? { min: 1, max: 4096, step: 1 } : { step: 'any' as const };
      const label = `${rowLabels[key]}, ${axis}`;
      const field = numberField({ id: `grid-${key}-${axis}`, label, hideLabel: true, ...limits, onChange: apply });
      rows[key].push(field);
      table.append(field.element);
    }
  }
  const cubic = button('Use cubic cells', () => app.setGrid({ cells: Math.max(...read(rows.cells)) }), { id: 'grid-cubic' });
  app.events.on('settings', ({ grid }) => {
    const isCustom = 'min' in grid;
    cubic.disabled = !isCustom;
    // Not from the model, which may still be that of an earlier grid or mesh.
    if (isCustom) fill(rows, grid);
    else if (app.mesh) fill(rows, gridAround(app.mesh.bounds, grid.cells));
  });
  return el('div', {}, table, el('div', { class: 'row' }, cubic), snapField(app));
}

function read(row: NumberInput[]): Vector3 {
  return [row[0].input.valueAsNumber, row[1].input.valueAsNumber, row[2].input.valueAsNumber];
}

function fill(rows: Rows, grid: CustomGrid): void {
  for (const key of ['cells', 'min', 'max'] as const) rows[key].forEach((field, d) => field.set(grid[key][d]));
}

function snapField(app: App): HTMLElement {
  const field = numberField({
    id: 'snap',
    label: 'Snap tolerance (in cells)',
    min: 0,
    max: 0.49,
    step: 0.01,
    onChange: (tolerance) => app.setSnapTolerance(tolerance),
  });
  field.input.step = 'any';
  app.events.on('settings', ({ snapTolerance }) => field.set(snapTolerance));
  return field.element;
}

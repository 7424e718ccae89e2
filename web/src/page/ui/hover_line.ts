import type { App } from '../app';
import { el } from './dom';
import { milliseconds, plural, real } from '../../model/format';
import { insideOf } from '../../model/inside';

/** The line below the picture: the cell under the pointer, or else a summary of the cut. */
export function hoverLine(app: App): HTMLElement {
  const line = el('p', { class: 'hover-line', id: 'hover-line' });
  const show = (cell: number | null) => {
    line.dataset.cell = cell === null ? '' : String(cell);
    line.textContent = cell === null ? summary(app) : describeCell(app, cell);
  };
  app.events.on('hover', show);
  app.events.on('model', () => show(null));
  return line;
}

function describeCell({ model }: App, cell: number): string {
  if (!model || cell >= model.counts.cutCells) return '';
  const region = model.cells.region[cell];
  return `Cell ${cell} · region ${region} · ${insideOf(model, region)} · volume ${real(model.cells.volume[cell])}`;
}

function summary({ model }: App): string {
  if (!model) return '';
  const { name, grid, counts, stats, estimateMs } = model;
  return `${name} · ${grid.cells.join(' × ')} grid · ${plural(counts.cutCells, 'cut-cell')} in ${milliseconds(stats.totalMs + (estimateMs ?? 0))}`;
}

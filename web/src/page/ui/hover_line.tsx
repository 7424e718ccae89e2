import type { App } from '../app';
import type { Model } from '../../model/types';
import { milliseconds, plural, real } from '../../model/format';
import { insideOf } from '../../model/inside';

/** The line below the picture: the cell under the pointer, or else a summary of the cut. */
export function HoverLine({ app }: { app: App }) {
  const { model } = app;
  const cell = app.state.hovered.value;
  return (
    <p class="hover-line" id="hover-line" data-cell={cell ?? ''}>
      {model && (cell === null ? summary(model) : describeCell(model, cell))}
    </p>
  );
}

function describeCell(model: Model, cell: number): string {
  if (cell >= model.counts.cutCells) return '';
  const region = model.cells.region[cell];
  return `Cell ${cell} · region ${region} · ${insideOf(model, region)} · volume ${real(model.cells.volume[cell])}`;
}

function summary({ name, grid, counts, stats, estimateMs }: Model): string {
  return `${name} · ${grid.cells.join(' × ')} grid · ${plural(counts.cutCells, 'cut-cell')} in ${milliseconds(stats.totalMs + (estimateMs ?? 0))}`;
}

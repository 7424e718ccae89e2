import type { App } from '../app';
import type { Model } from '../../model/cut_model';
import { milliseconds, plural, real } from '../../model/format';
import { insideOf } from '../../model/inside';
import { CheckLine } from './check_line';

/** The line below the picture: the cell under the pointer, or else a summary of the cut; how often it is cut while something plays. */
export function HoverLine({ app }: { app: App }) {
  const { model } = app;
  const cell = app.state.hovered.value;
  const playing = app.state.playing.value;
  // Nobody could listen to twenty cuts a second, or to every cell that the pointer passes.
  const isSaid = cell === null && !playing;
  return (
    <div class="lines">
      <p class="hover-line" id="hover-line" aria-live={isSaid ? 'polite' : 'off'} data-cell={cell ?? ''}>
        {model && (cell === null ? summary(model) : describeCell(model, cell))}
      </p>
      <CheckLine app={app} />
      <p class="hover-line" id="play-rate">
        {playing?.rate ? `${plural(playing.rate, 'cut')} a second` : ''}
      </p>
    </div>
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

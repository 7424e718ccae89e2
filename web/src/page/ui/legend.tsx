import type { App } from '../app';
import { legend as entriesOf } from '../view/colors';
import { WindLegend } from './wind_legend';
import { insideWords } from '../../model/inside';
import { isAll, rangeWords } from '../../model/volumes';

/** What the colours mean, on top of the picture, and what tells the inside from the outside unless winding numbers do. */
export function Legend({ app: { model, settings, state } }: { app: App }) {
  const wind = state.instead.value ? null : state.wind.value;
  if (wind?.surface) return <WindLegend coloring={settings.wind.show} />;
  if (state.smoke.value && !state.instead.value) return <WindLegend coloring="speed" />;
  const isNarrowed = model !== null && !state.instead.value && !isAll(settings.volumes);
  const entries = model && !state.instead.value ? entriesOf(model, settings) : [];
  return (
    <div class="legend" id="legend" role="group" aria-label="Colours" hidden={entries.length === 0 && !isNarrowed}>
      {entries.map(({ color, label }) => (
        <span key={label} class="entry">
          <span class="swatch" style={{ background: color }} />
          {label}
        </span>
      ))}
      {isNarrowed && <span class="doubt">only cut-cells {rangeWords(settings.volumes)}</span>}
      {model && model.insideBy !== 'winding' && <span class="doubt">inside {insideWords[model.insideBy]}</span>}
    </div>
  );
}

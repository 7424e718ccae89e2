import { windLegend } from '../view/wind/colors';
import type { WindColoring } from '../../model/wind';

const titles: Record<WindColoring, string> = { none: '', speed: 'speed, wind = 1', pressure: 'pressure coefficient' };

/** The numbers that the colours of a flow stand for. */
export function WindLegend({ coloring }: { coloring: WindColoring }) {
  return (
    <div class="legend" id="legend" role="group" aria-label="Colours">
      <span>{titles[coloring]}</span>
      {windLegend(coloring).map(({ color, label }) => (
        <span key={label} class="entry">
          <span class="swatch" style={{ background: color }} />
          {label}
        </span>
      ))}
    </div>
  );
}

import type { App } from '../app';
import { otherGridWay } from '../../model/comparison';
import { deviation } from '../../model/format';
import { wayNames } from './way_names';

/** Between cut-cells and another way, on top of the picture: dragged, or moved with arrow keys. */
export function Divider({ app }: { app: App }) {
  const { way, divider } = app.settings.compare;
  const comparison = app.state.divided.value;
  const other = way === 'none' ? null : comparison?.ways[way];
  if (way === 'none' || !comparison || !other) return null;
  const { exact } = comparison;
  return (
    <div class="divider" id="divided">
      <input
        id="divider"
        type="range"
        min={0}
        max={1}
        step={0.01}
        value={divider}
        aria-label={`Divider between cut-cells and ${wayNames[way]}`}
        aria-valuetext={`cut-cells on ${Math.round(100 * divider)}% of the width`}
        onInput={({ currentTarget }) => app.changeCompare({ divider: currentTarget.valueAsNumber })}
      />
      <div class="divider-line" style={{ left: `${100 * divider}%` }} aria-hidden="true">
        <span class="side">
          cut-cells
          <small>exact</small>
        </span>
        <span class="knob">⇔</span>
        <span class="side">
          {wayNames[way]}
          {otherGridWay(way) && other.grid && <small>{other.grid.cells.join(' × ')} grid</small>}
          <small>volume {deviation(other.volume / exact.volume - 1)}</small>
          <small>area {deviation(other.area / exact.area - 1)}</small>
        </span>
      </div>
    </div>
  );
}

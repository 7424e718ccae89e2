import type { App } from '../app';
import { gridAround, type GridSettings } from '../../model/grid_around';
import { axes } from '../../model/slices';
import { NumberField } from './controls/number_field';

type Grid = Extract<GridSettings, { min: unknown }>;

const rows = ['cells', 'min', 'max'] as const;
type RowName = (typeof rows)[number];

/** Counts and box of the grid, starting from the current one, and the snap tolerance. */
export function CustomGrid({ app }: { app: App }) {
  const { grid, snapTolerance } = app.settings;
  const shown = shownGrid(app);
  const cells = 'min' in grid ? Math.max(...grid.cells) : grid.cells;
  // Of the grid at that time: what was entered just before is not drawn yet.
  const set = (row: RowName, axis: number, value: number) => {
    const now = shownGrid(app);
    if (now) app.setGrid({ ...now, [row]: now[row].map((x, d) => (d === axis ? value : x)) });
  };
  return (
    <div>
      <div class="custom-grid" role="group" aria-label="Custom grid">
        <span />
        {axes.map((axis) => (
          <span key={axis} class="axis" aria-hidden="true">
            {axis}
          </span>
        ))}
        {rows.map((row) => (
          <Row key={row} row={row} grid={shown} onChange={(axis, value) => set(row, axis, value)} />
        ))}
      </div>
      <div class="row">
        <button type="button" id="grid-cubic" disabled={!('min' in grid)} onClick={() => app.setGrid({ cells })}>
          Use cubic cells
        </button>
      </div>
      <NumberField
        id="snap"
        label="Snap tolerance (in cells)"
        min={0}
        max={0.49}
        step="any"
        value={snapTolerance}
        onChange={(tolerance) => app.setSnapTolerance(tolerance)}
      />
    </div>
  );
}

/** Not from the model, which may still be that of an earlier grid or mesh. */
function shownGrid({ settings: { grid }, mesh }: App): Grid | null {
  if ('min' in grid) return grid;
  return mesh && gridAround(mesh.bounds, grid.cells);
}

interface RowProps {
  row: RowName;
  grid: Grid | null;
  onChange: (axis: number, value: number) => void;
}

function Row({ row, grid, onChange }: RowProps) {
  const limits = row === 'cells' ? { min: 1, max: 4096, step: 1 } : { step: 'any' as const };
  return (
    <>
      <span class="hint" aria-hidden="true">
        {row}
      </span>
      {axes.map((axis, d) => (
        <NumberField
          key={axis}
          id={`grid-${row}-${axis}`}
          label={`${row}, ${axis}`}
          hideLabel
          {...limits}
          value={grid?.[row][d] ?? null}
          onChange={(value) => onChange(d, value)}
        />
      ))}
    </>
  );
}

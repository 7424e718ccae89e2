import { useMemo } from 'preact/hooks';
import type { App } from '../app';
import { integer, plural } from '../../model/format';
import type { Model } from '../../model/cut_model';
import {
  allVolumes,
  barWidth,
  histogram,
  isAll,
  isWithin,
  nextLarger,
  rangeWords,
  shareAt,
  shareOf,
  shareWords,
} from '../../model/volumes';
import { shownRegions } from '../../model/shown';
import { Section } from './controls/section';
import { Slider } from './controls/slider';

const [lowest, highest] = allVolumes;
/** Of the histogram, in its own units: a bar is one wide. */
const height = 20;

/** How large cut-cells are, as shares of their grid cells; those of a range alone are seen. */
export function VolumesPanel({ app }: { app: App }) {
  const { model, state } = app;
  return (
    <Section app={app} id="volumes" title="Volumes">
      <p class="hint">
        How much of a grid cell a cut-cell fills, on a logarithmic axis. Cells in the chosen range stay; others become faint.
      </p>
      {model && state.sections.isOpen('volumes') && <Histogram app={app} model={model} />}
    </Section>
  );
}

function Histogram({ app, model }: { app: App; model: Model }) {
  const { settings } = app;
  const { volumes, show } = settings;
  const regions = shownRegions(model, settings);
  const bars = useMemo(() => histogram(model, regions), [model, regions.join()]);
  const isLit = (bar: number) => isWithin(volumes, shareAt(bar));
  const cells = bars.reduce((sum, count) => sum + count, 0);
  const selected = bars.reduce((sum, count, bar) => sum + (isLit(bar) ? count : 0), 0);
  const whose = show.region === null ? (show.outside ? '' : ' that are inside') : ` of region ${show.region}`;
  const what = `${plural(cells, 'cut-cell')}${whose}`;
  return (
    <>
      <Bars bars={bars} isLit={isLit} />
      <Ends app={app} />
      <p id="volumes-count" aria-live="polite" data-selected={selected} data-cells={cells}>
        {isAll(volumes) ? `All ${what}.` : `${integer(selected)} of ${what}: ${rangeWords(volumes)}.`}
      </p>
      <Walk app={app} model={model} regions={regions} isEmpty={selected === 0} />
    </>
  );
}

/** A bar is as high as the root of its number of cells, so that few are seen beside many. */
function Bars({ bars, isLit }: { bars: Uint32Array; isLit: (bar: number) => boolean }) {
  const most = Math.max(...bars, 1);
  const label = `Number of cut-cells by volume, from ${shareWords(lowest)} to 1 of a grid cell`;
  return (
    <div class="histogram">
      <svg viewBox={`0 0 ${bars.length} ${height}`} preserveAspectRatio="none" role="img" aria-label={label}>
        {Array.from(bars, (count, bar) => {
          const size = count > 0 ? 1 + (height - 1) * Math.sqrt(count / most) : 0;
          return <rect key={bar} class={isLit(bar) ? 'lit' : ''} x={bar + 0.08} y={height - size} width={0.84} height={size} />;
        })}
      </svg>
      <p class="ticks" aria-hidden="true">
        {['10⁻¹²', '10⁻⁹', '10⁻⁶', '10⁻³', '1'].map((tick) => (
          <span key={tick}>{tick}</span>
        ))}
      </p>
    </div>
  );
}

/** The ends of the range stay a bar apart. */
function Ends({ app }: { app: App }) {
  const [from, to] = app.settings.volumes;
  return (
    <>
      <Slider
        id="volumes-from"
        label="Volume from"
        min={lowest}
        max={highest - barWidth}
        step={barWidth}
        value={from}
        format={(power) => (power <= lowest ? 'the smallest' : shareWords(power))}
        onInput={(power) => app.change({ volumes: [power, Math.max(to, power + barWidth)] })}
      />
      <Slider
        id="volumes-to"
        label="Volume to"
        min={lowest + barWidth}
        max={highest}
        step={barWidth}
        value={to}
        format={(power) => (power >= highest ? 'the largest' : shareWords(power))}
        onInput={(power) => app.change({ volumes: [Math.min(from, power - barWidth), power] })}
      />
    </>
  );
}

interface WalkProps {
  app: App;
  model: Model;
  regions: Uint8Array;
  isEmpty: boolean;
}

/** Goes through the selected cells, the smallest first. */
function Walk({ app, model, regions, isEmpty }: WalkProps) {
  const { volumes } = app.settings;
  const pinned = app.state.pinned.value;
  const isSelected = pinned !== null && regions[pinned.region] === 1 && isWithin(volumes, shareOf(model, pinned.cell));
  const pin = () => {
    const next = nextLarger(model, regions, volumes, isSelected ? pinned.cell : null);
    void app.inspector.pin(next);
  };
  return (
    <div class="row">
      <button type="button" id="pin-smallest" disabled={isEmpty} onClick={pin}>
        {isSelected ? 'Pin the next larger' : 'Pin the smallest'}
      </button>
      <button type="button" id="volumes-all" disabled={isAll(volumes)} onClick={() => app.change({ volumes: allVolumes })}>
        Select all
      </button>
    </div>
  );
}

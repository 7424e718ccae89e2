import { useEffect } from 'preact/hooks';
import type { App } from '../app';
import { integer, milliseconds } from '../../model/format';
import { insideWords } from '../../model/inside';
import { CustomGrid } from './custom_grid';
import { CutDetails } from './cut_details';
import { NumberField } from './controls/number_field';
import { Section } from './controls/section';
import { Slider } from './controls/slider';
import { Terms } from './controls/terms';

/** The grid that the mesh is cut with, and the result in numbers. */
export function CutPanel({ app }: { app: App }) {
  return (
    <Section app={app} id="cut" title="Cut">
      <Resolution app={app} />
      <CutError app={app} />
      <Counts app={app} />
      <div>
        <details id="custom-grid">
          <summary>Custom grid</summary>
          <CustomGrid app={app} />
        </details>
        <CutDetails app={app} />
      </div>
    </Section>
  );
}

function Resolution({ app }: { app: App }) {
  const { grid } = app.settings;
  const cells = 'min' in grid ? Math.max(...grid.cells) : grid.cells;
  const set = (value: number) => app.setGrid({ cells: value });
  return (
    <div class="with-number">
      <Slider id="cells" label="Cells along the longest side" min={1} max={128} step={1} value={cells} onInput={set} />
      <NumberField id="cells-number" label="Number of cells" hideLabel min={1} max={512} value={cells} onChange={set} />
    </div>
  );
}

/** Without a model, the stage shows what went wrong in place of the picture. */
function CutError({ app }: { app: App }) {
  const { sections, cutError } = app.state;
  const error = app.model && cutError.value;
  useEffect(() => {
    if (error) sections.set('cut', true);
  }, [error, sections]);
  return (
    <div class="alert inline" id="cut-error" role="alert" hidden={error === null}>
      {error && (
        <>
          <strong>{error.title}</strong>
          <p>{error.detail}</p>
          <p class="hint">The picture still shows the previous cut.</p>
        </>
      )}
    </div>
  );
}

function Counts({ app: { model, state } }: { app: App }) {
  // Nobody could listen to the counts of twenty cuts a second.
  const isPlaying = state.playing.value !== null;
  return (
    <div
      id="counts"
      aria-live={isPlaying ? 'off' : 'polite'}
      aria-atomic="true"
      data-model={model?.id}
      data-grid={model?.grid.cells.join('x')}
      data-cut-cells={model?.counts.cutCells}
      data-untouched-cells={model?.counts.untouchedCells}
      data-faces={model?.counts.faces}
      data-vertices={model?.counts.vertices}
      data-regions={model?.counts.regions}
    >
      {model && (
        <Terms
          class="counts"
          list={[
            ['grid', model.grid.cells.join(' × ')],
            ['cut-cells', integer(model.counts.cutCells)],
            ['untouched cells', integer(model.counts.untouchedCells)],
            ['regions', integer(model.counts.regions)],
            ['inside', insideWords[model.insideBy]],
            ['time', milliseconds(model.stats.totalMs + (model.estimateMs ?? 0))],
          ]}
        />
      )}
    </div>
  );
}

import { useEffect } from 'preact/hooks';
import type { App } from '../app';
import { integer, milliseconds } from '../../model/format';
import { insideWords } from '../../model/inside';
import { CustomGrid } from './custom_grid';
import { CutDetails } from './cut_details';
import { Section } from './controls/section';
import { Terms } from './controls/terms';

/** The result in numbers, and all about the grid but its resolution. */
export function CutPanel({ app }: { app: App }) {
  return (
    <Section app={app} id="cut" title="Cut">
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

/** Without a model, the stage shows what went wrong in place of the picture. */
function CutError({ app }: { app: App }) {
  const { sections, cutError } = app.state;
  const error = app.model && cutError.value;
  useEffect(() => {
    if (!error) return;
    sections.set('cut', true);
    sections.arePanelsOpen.value = true;
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

function Counts({ app: { model } }: { app: App }) {
  return (
    <div
      id="counts"
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

import type { InsideBy } from 'mandoline-wasm';
import type { App } from '../app';
import { hasInside } from '../compare';
import { otherWays, type CompareSettings, type Comparison, type Extent } from '../../model/comparison';
import { insideWords } from '../../model/inside';
import { deviation, real } from '../../model/format';
import { Choice } from './controls/choice';
import { Section } from './controls/section';
import { wayNames } from './way_names';

const options: readonly (readonly [CompareSettings['way'], string])[] = [
  ['none', 'nothing'],
  ['voxels', 'voxels'],
  ['cubes', 'marching cubes'],
];

const meanings: Record<CompareSettings['way'], string> = {
  none: 'What the same grid gives without cutting cells: drag the divider in the picture to see both.',
  voxels: 'Grid cells whose middle is inside. What is thinner than a cell goes missing, and slopes become stairs, which have more area.',
  cubes: 'A surface through the places where grid-edges cross the mesh. It rounds off what lies between: edges, corners, thin parts.',
};

/** What other ways make of the mesh with the same grid, beside the cut-cells. */
export function ComparePanel({ app }: { app: App }) {
  const { model, settings, state } = app;
  const { way } = settings.compare;
  const comparison = state.comparison.value;
  const isHollow = way !== 'none' && model !== null && !hasInside(model);
  return (
    <Section app={app} id="compare" title="Compare">
      <Choice
        name="compare"
        legend="Beside the cut-cells"
        options={options}
        value={way}
        onChange={(next) => app.changeCompare({ way: next })}
      />
      <p class="hint">{meanings[way]}</p>
      <div id="compare-note" aria-live="polite">
        {isHollow && <p>There is nothing to compare: this mesh has no inside.</p>}
        {way !== 'none' && !isHollow && !comparison && <p class="hint">The other ways are being computed.</p>}
      </div>
      {model && comparison && <Extents comparison={comparison} insideBy={model.insideBy} chosen={way} />}
    </Section>
  );
}

interface ExtentsProps {
  comparison: Comparison;
  insideBy: InsideBy;
  chosen: CompareSettings['way'];
}

function Extents({ comparison: { exact, ways }, insideBy, chosen }: ExtentsProps) {
  const doubt = insideBy === 'winding' ? '' : ` ${insideWords[insideBy]}`;
  return (
    <table class="extents">
      <caption>Of what is inside{doubt}, with the same grid</caption>
      <thead>
        <tr>
          <td />
          <th scope="col">Volume</th>
          <th scope="col">Area</th>
        </tr>
      </thead>
      <tbody>
        <Row name="cut-cells" id="cutCells" extent={exact} />
        {otherWays.map((way) => (
          <Row key={way} name={wayNames[way]} id={way} extent={ways[way]} exact={exact} isChosen={way === chosen} />
        ))}
      </tbody>
    </table>
  );
}

interface RowProps {
  name: string;
  id: string;
  extent: Extent;
  /** Left out for what is exact. */
  exact?: Extent;
  isChosen?: boolean;
}

function Row({ name, id, extent, exact, isChosen = false }: RowProps) {
  return (
    <tr class={isChosen ? 'chosen' : undefined} data-way={id} data-volume={extent.volume} data-area={extent.area}>
      <th scope="row">{name}</th>
      {(['volume', 'area'] as const).map((what) => (
        <td key={what}>
          {real(extent[what])}
          <small>{exact ? deviation(extent[what] / exact[what] - 1) : 'exact'}</small>
        </td>
      ))}
    </tr>
  );
}

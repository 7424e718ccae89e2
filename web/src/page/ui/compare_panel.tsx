import type { InsideBy } from 'mandoline-wasm';
import type { App } from '../app';
import { hasInside } from '../compare';
import { otherWays, type CompareSettings, type Comparison, type Inside } from '../../model/comparison';
import { insideWords } from '../../model/inside';
import { deviation, integer, real } from '../../model/format';
import { Choice } from './controls/choice';
import { Section } from './controls/section';
import { wayNames } from './way_names';

const options: readonly (readonly [CompareSettings['way'], string])[] = [
  ['none', 'nothing'],
  ['voxels', 'voxels'],
  ['cubes', 'marching cubes'],
  ['coarser', 'coarser'],
  ['finer', 'finer'],
];

const meanings: Record<CompareSettings['way'], string> = {
  none: 'What the same grid gives without cutting cells, or what another grid gives: drag the divider in the picture to see both.',
  voxels: 'Grid cells whose middle is inside. What is thinner than a cell goes missing, and slopes become stairs, which have more area.',
  cubes: 'A surface through the places where grid-edges cross the mesh. It rounds off what lies between: edges, corners, thin parts.',
  coarser: 'Cut-cells of a grid with half as many cells along each axis. The surface is the same, and so are its volume and area.',
  finer: 'Cut-cells of a grid with twice as many cells along each axis. The surface is the same, and so are its volume and area.',
};

/** What other ways, or another grid, make of the mesh, beside the cut-cells. */
export function ComparePanel({ app }: { app: App }) {
  const { model, settings, state } = app;
  const { way } = settings.compare;
  const comparison = state.comparison.value;
  const isAwaited = state.isComparisonAwaited.value && (!comparison || (way !== 'none' && !comparison.ways[way]));
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
        {isAwaited && <p class="hint">The other ways are being computed.</p>}
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
      <caption>Of what is inside{doubt}</caption>
      <thead>
        <tr>
          <td />
          <th scope="col">Volume</th>
          <th scope="col">Area</th>
          <th scope="col">Cells</th>
        </tr>
      </thead>
      <tbody>
        <Row name="cut-cells" id="cutCells" inside={exact} />
        {otherWays.map((way) => {
          const inside = ways[way];
          return inside && <Row key={way} name={wayNames[way]} id={way} inside={inside} exact={exact} isChosen={way === chosen} />;
        })}
      </tbody>
    </table>
  );
}

interface RowProps {
  name: string;
  id: string;
  inside: Inside;
  /** Left out for what is exact. */
  exact?: Inside;
  isChosen?: boolean;
}

function Row({ name, id, inside, exact, isChosen = false }: RowProps) {
  const { volume, area, cells } = inside;
  const data = { 'data-way': id, 'data-volume': volume, 'data-area': area, 'data-cut': cells?.cut, 'data-untouched': cells?.untouched };
  return (
    <tr class={isChosen ? 'chosen' : undefined} {...data}>
      <th scope="row">{name}</th>
      {(['volume', 'area'] as const).map((what) => (
        <td key={what}>
          {real(inside[what])}
          <small>{exact ? deviation(inside[what] / exact[what] - 1) : 'exact'}</small>
        </td>
      ))}
      <td>{cells ? <Cells {...cells} /> : '–'}</td>
    </tr>
  );
}

function Cells({ cut, untouched }: NonNullable<Inside['cells']>) {
  if (cut === 0) return <>{integer(untouched)}</>;
  return (
    <>
      {integer(cut)}
      <small>+ {integer(untouched)} whole</small>
    </>
  );
}

import { useEffect, useLayoutEffect, useRef } from 'preact/hooks';
import type { App } from '../app';
import type { CellCard as Card } from '../../model/cut_model';
import { CellViewer } from './cell_viewer';
import { Terms } from './controls/terms';
import { integer, plural, real, winding } from '../../model/format';
import { insideOf } from '../../model/inside';
import { gridCellVolume } from '../../model/volumes';

/** The card of the pinned cell: its properties, and a view of it on its own. */
export function CellCard({ app }: { app: App }) {
  const pinned = app.state.pinned.value;
  const card = useRef<HTMLElement>(null);
  const title = useRef<HTMLHeadingElement>(null);
  const hadFocus = card.current?.contains(document.activeElement) ?? false;
  useEffect(() => {
    if (pinned) app.state.sections.uncover();
  }, [pinned, app]);
  // What had the focus may be gone: the neighbours are other ones, or the card is hidden.
  useLayoutEffect(() => {
    if (!hadFocus || (pinned && card.current?.contains(document.activeElement))) return;
    if (pinned) title.current?.focus();
    else document.getElementById('canvas')?.focus();
  });
  return (
    <aside
      ref={card}
      class="card"
      id="cell-card"
      aria-labelledby="card-title"
      aria-live="polite"
      hidden={!pinned}
      data-cell={pinned?.cell ?? ''}
    >
      <header>
        <h2 ref={title} id="card-title" tabIndex={-1}>
          {pinned && `Cell ${pinned.cell}`}
        </h2>
        <button type="button" id="unpin" class="quiet" onClick={() => void app.inspector.pin(null)}>
          Unpin
        </button>
      </header>
      <CellCanvas card={pinned} />
      <div class="facts">
        {pinned && <Terms class="counts" list={facts(pinned, app)} />}
        {pinned && <Neighbours card={pinned} app={app} />}
      </div>
    </aside>
  );
}

const turns: Record<string, [number, number]> = { ArrowLeft: [-0.2, 0], ArrowRight: [0.2, 0], ArrowUp: [0, -0.2], ArrowDown: [0, 0.2] };

function CellCanvas({ card }: { card: Card | null }) {
  const canvas = useRef<HTMLCanvasElement>(null);
  const viewer = useRef<CellViewer>(null);
  useLayoutEffect(() => {
    if (!card || !canvas.current) return;
    viewer.current ??= new CellViewer(canvas.current);
    viewer.current.show(card);
  }, [card]);
  const turn = (event: KeyboardEvent) => {
    if (!turns[event.key]) return;
    event.preventDefault();
    viewer.current?.turn(...turns[event.key]);
  };
  const label = card ? `Cell ${card.cell} on its own; drag or use the arrow keys to rotate it` : undefined;
  return <canvas ref={canvas} class="cell-canvas" tabIndex={0} role="img" aria-label={label} onKeyDown={turn} />;
}

function facts(card: Card, app: App): [string, string][] {
  return [
    ['grid cell', card.gridCell.join(', ')],
    ['region', integer(card.region)],
    inside(card, app),
    ['volume', real(card.volume)],
    ['share of its grid cell', share(card, app)],
    ['faces', `${integer(card.faces)}, ${integer(card.surfaceFaces)} of them on the surface`],
    ['vertices', integer(card.vertices)],
    ['cavities', integer(card.cavities)],
  ];
}

/** The winding number, or what tells that the cell is inside. */
function inside({ region }: Card, { model }: App): [string, string] {
  const number = model?.regions[region].winding ?? null;
  if (number !== null || !model) return ['winding number', winding(number)];
  return ['side', insideOf(model, region)];
}

function share(card: Card, { model }: App): string {
  return model ? `${real((100 * card.volume) / gridCellVolume(model, card.gridCell))}%` : '';
}

const shownNeighbours = 60;

function Neighbours({ card, app }: { card: Card; app: App }) {
  const more = card.neighbours.length - shownNeighbours;
  const untouched = card.untouchedNeighbours > 0 ? `, ${plural(card.untouchedNeighbours, 'untouched cell')}` : '';
  return (
    <>
      <h3>{`Neighbours: ${plural(card.neighbours.length, 'cut-cell')}${untouched}`}</h3>
      <ul class="neighbours" aria-label="Neighbouring cut-cells">
        {card.neighbours.slice(0, shownNeighbours).map((cell) => (
          <li key={`${card.cell} ${cell}`}>
            <button type="button" class="quiet" aria-label={`Pin cell ${cell}`} onClick={() => void app.inspector.pin(cell)}>
              {cell}
            </button>
          </li>
        ))}
        {more > 0 && <li>and {integer(more)} more</li>}
      </ul>
    </>
  );
}

import type { App } from '../app';
import type { CellCard } from '../../model/types';
import { gridCellVolume } from '../view/colors';
import { CellViewer } from './cell_viewer';
import { button, el, terms } from './dom';
import { integer, plural, real, winding } from '../../model/format';
import { insideOf } from '../../model/inside';

/** The card of the pinned cell: its properties, and a view of it on its own. */
export function cellCard(app: App): HTMLElement {
  const title = el('h2', { id: 'card-title', tabindex: '-1' });
  const canvas = el('canvas', { class: 'cell-canvas', tabindex: '0', role: 'img' });
  const facts = el('div', { class: 'facts' });
  const close = button('Unpin', () => void app.pin(null), { id: 'unpin', class: 'quiet' });
  const card = el('aside', { class: 'card', id: 'cell-card', 'aria-labelledby': 'card-title', 'aria-live': 'polite', hidden: true });
  card.append(el('header', {}, title, close), canvas, facts);

  let viewer: CellViewer | null = null;
  canvas.addEventListener('keydown', (event) => viewer && turnByKey(viewer, event));
  app.events.on('pinned', (pinned) => {
    if (!pinned && card.contains(document.activeElement)) document.getElementById('canvas')?.focus();
    card.hidden = pinned === null;
    card.dataset.cell = pinned ? String(pinned.cell) : '';
    if (!pinned) return;
    title.textContent = `Cell ${pinned.cell}`;
    canvas.setAttribute('aria-label', `Cell ${pinned.cell} on its own; drag or use the arrow keys to rotate it`);
    const focused = facts.contains(document.activeElement);
    facts.replaceChildren(factList(pinned, app), ...neighbours(pinned, app));
    if (focused) title.focus();
    viewer ??= new CellViewer(canvas);
    viewer.show(pinned);
  });
  return card;
}

function turnByKey(viewer: CellViewer, event: KeyboardEvent): void {
  const turns: Record<string, [number, number]> = { ArrowLeft: [-0.2, 0], ArrowRight: [0.2, 0], ArrowUp: [0, -0.2], ArrowDown: [0, 0.2] };
  const turn = turns[event.key];
  if (!turn) return;
  event.preventDefault();
  viewer.turn(...turn);
}

function factList(card: CellCard, app: App): HTMLElement {
  return terms(
    [
      ['grid cell', card.gridCell.join(', ')],
      ['region', integer(card.region)],
      inside(card, app),
      ['volume', real(card.volume)],
      ['share of its grid cell', share(card, app)],
      ['faces', `${integer(card.faces)}, ${integer(card.surfaceFaces)} of them on the surface`],
      ['vertices', integer(card.vertices)],
      ['cavities', integer(card.cavities)],
    ],
    { class: 'counts' },
  );
}

/** The winding number, or what tells that the cell is inside. */
function inside({ region }: CellCard, { model }: App): [string, string] {
  const number = model?.regions[region].winding ?? null;
  if (number !== null || !model) return ['winding number', winding(number)];
  return ['side', insideOf(model, region)];
}

function share(card: CellCard, app: App): string {
  if (!app.model) return '';
  return `${real((100 * card.volume) / gridCellVolume(app.model, card.gridCell))}%`;
}

const shownNeighbours = 60;

function neighbours(card: CellCard, app: App): HTMLElement[] {
  const list = el('ul', { class: 'neighbours', 'aria-label': 'Neighbouring cut-cells' });
  for (const cell of card.neighbours.slice(0, shownNeighbours)) {
    list.append(
      el(
        'li',
        {},
        button(String(cell), () => void app.pin(cell), { class: 'quiet', 'aria-label': `Pin cell ${cell}` }),
      ),
    );
  }
  const more = card.neighbours.length - shownNeighbours;
  if (more > 0) list.append(el('li', {}, `and ${integer(more)} more`));
  const untouched = card.untouchedNeighbours > 0 ? `, ${plural(card.untouchedNeighbours, 'untouched cell')}` : '';
  return [el('h3', {}, `Neighbours: ${plural(card.neighbours.length, 'cut-cell')}${untouched}`), list];
}

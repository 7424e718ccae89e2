import type { App } from '../app';
import type { Model } from '../../model/types';
import { el, numberField, slider, terms } from './dom';
import { integer, milliseconds, plural, real, words } from '../../model/format';
import { insideWords } from '../../model/inside';
import { customGrid } from './custom_grid';
import { openSection, section } from './section';

/** The grid that the mesh is cut with, and the result in numbers. */
export function cutPanel(app: App): HTMLElement {
  return section('cut', 'Cut', true, resolution(app), errorBox(app), counts(app), finePrint(app));
}

function resolution(app: App): HTMLElement {
  const label = 'Cells along the longest side';
  const set = (cells: number) => app.setGrid({ cells });
  const range = slider({ id: 'cells', label, min: 1, max: 128, step: 1, onInput: set });
  const number = numberField({ id: 'cells-number', label: 'Number of cells', hideLabel: true, min: 1, max: 512, onChange: set });
  app.events.on('settings', ({ grid }) => {
    const cells = 'min' in grid ? Math.max(...grid.cells) : grid.cells;
    range.set(cells);
    number.set(cells);
  });
  return el('div', { class: 'with-number' }, range.element, number.element);
}

function errorBox(app: App): HTMLElement {
  const box = el('div', { class: 'alert inline', id: 'cut-error', role: 'alert', hidden: true });
  app.events.on('cutError', (error) => {
    // Without a model, the stage shows it in place of the picture.
    box.hidden = error === null || app.model === null;
    if (!error || box.hidden) return box.replaceChildren();
    openSection('cut');
    const hint = el('p', { class: 'hint' }, 'The picture still shows the previous cut.');
    box.replaceChildren(el('strong', {}, error.title), el('p', {}, error.detail), hint);
  });
  return box;
}

function counts(app: App): HTMLElement {
  const box = el('div', { id: 'counts', 'aria-live': 'polite', 'aria-atomic': 'true' });
  app.events.on('model', (model) => {
    for (const key of Object.keys(box.dataset)) delete box.dataset[key];
    if (!model) return box.replaceChildren();
    const { cutCells, untouchedCells, regions } = model.counts;
    Object.assign(box.dataset, model.counts, { model: model.id, grid: model.grid.cells.join('x') });
    box.replaceChildren(
      terms(
        [
          ['grid', model.grid.cells.join(' × ')],
          ['cut-cells', integer(cutCells)],
          ['untouched cells', integer(untouchedCells)],
          ['regions', integer(regions)],
          ['inside', insideWords[model.insideBy]],
          ['time', milliseconds(model.stats.totalMs + (model.estimateMs ?? 0))],
        ],
        { class: 'counts' },
      ),
    );
  });
  return box;
}

/** For the curious: custom grids, stage times, what was left out. */
function finePrint(app: App): HTMLElement {
  const body = el('div', { id: 'cut-details' });
  const times = el('details', {}, el('summary', {}, 'Stages and details'), body);
  const showEdges = async () => {
    const { model } = app;
    const edges = times.open && model ? await app.countEdges() : null;
    const place = body.querySelector('.edges');
    if (edges !== null && place && model === app.model) place.textContent = integer(edges);
  };
  times.addEventListener('toggle', () => void showEdges());
  app.events.on('model', (model) => {
    body.replaceChildren(...(model ? [moreCounts(model), stageTimes(model), leftOut(model)] : []));
    void showEdges();
  });
  return el('div', {}, el('details', { id: 'custom-grid' }, el('summary', {}, 'Custom grid'), customGrid(app)), times);
}

/** The edges are counted when they are seen. */
function moreCounts({ counts: { faces, vertices }, stats }: Model): HTMLElement {
  return terms(
    [
      ['faces', integer(faces)],
      ['edges', el('span', { class: 'edges' }, '…')],
      ['vertices', integer(vertices)],
      ['signs decided by exact arithmetic', integer(stats.exactFallbacks)],
    ],
    { class: 'counts' },
  );
}

function stageTimes({ stats, estimateMs }: Model): HTMLElement {
  const stages = [...stats.stages, ...(estimateMs === null ? [] : [{ stage: 'estimateOfInside', ms: estimateMs }])];
  const longest = Math.max(...stages.map(({ ms }) => ms), Number.MIN_VALUE);
  const rows = stages.map(({ stage, ms }) => {
    const bar = el('span', { class: 'bar' });
    bar.style.width = `${(100 * ms) / longest}%`;
    return el('tr', {}, el('th', { scope: 'row' }, words(stage)), el('td', { class: 'bar-cell' }, bar), el('td', {}, milliseconds(ms)));
  });
  return el('table', { class: 'times', id: 'stage-times' }, el('caption', {}, 'Time per stage'), el('tbody', {}, ...rows));
}

/** Pairs of triangles that meet other than in shared vertices and edges, which the cut has resolved. */
function meetings({ intersections, intersectionCurves }: Model['stats']): string[] {
  const { crossing, touching, overlapping, folded, identical } = intersections;
  const kinds = { crossing, touching, overlapping, folded, identical };
  const facts = Object.entries(kinds).flatMap(([kind, count]) => (count > 0 ? [`${plural(count, 'pair')} of triangles ${kind}`] : []));
  return intersectionCurves > 0 ? [...facts, `${plural(intersectionCurves, 'curve')} along which triangles meet`] : facts;
}

/** Parts of the mesh that have no winding numbers, in the words of the command line. */
function withoutWinding({ parts }: Model['stats']): string[] {
  const { winding, parity, open, openEdges, holes } = parts;
  const all = plural(winding + parity + open, 'part');
  const edges = `${plural(openEdges, 'open edge')} around ${plural(holes, 'hole')}`;
  return [
    ...(parity > 0 ? [`${integer(parity)} of ${all} not consistently oriented: inside by parity`] : []),
    ...(open > 0 ? [`${integer(open)} of ${all} open, with ${edges}: inside by an estimate`] : []),
  ];
}

function leftOut({ stats }: Model): HTMLElement {
  const facts = [
    stats.zeroAreaTriangles && `${plural(stats.zeroAreaTriangles, 'degenerate triangle')} dropped`,
    stats.outsideTriangles && `${plural(stats.outsideTriangles, 'triangle')} outside the grid dropped`,
    ...meetings(stats),
    ...withoutWinding(stats),
    stats.weldedVertices && `${plural(stats.weldedVertices, 'vertex', 'vertices')} welded to another at the same position`,
    stats.snappedVertices && `${plural(stats.snappedVertices, 'vertex', 'vertices')} snapped, by up to ${real(stats.largestSnap)} cells`,
    stats.flushedCoordinates && `${plural(stats.flushedCoordinates, 'tiny coordinate')} set to 0`,
  ].filter((fact) => typeof fact === 'string');
  if (facts.length === 0) return el('p', { id: 'left-out' }, 'Nothing dropped, welded or moved.');
  return el('ul', { id: 'left-out' }, ...facts.map((fact) => el('li', {}, fact)));
}

import type { App } from '../app';
import type { Model, PageError } from '../../model/types';
import { el } from './dom';
import { plural } from '../../model/format';
import { isOutside } from '../../model/inside';

/** Says why the stage is empty. */
export function stageNote(app: App): HTMLElement {
  const note = el('div', { class: 'stage-note', id: 'stage-note', role: 'status', hidden: true });
  const show = (what: PageError | null) => {
    note.hidden = what === null;
    note.replaceChildren(...(what ? [el('strong', {}, what.title), el('p', {}, what.detail)] : []));
  };
  app.events.on('model', (model) => show(model && emptiness(model)));
  app.events.on('cutError', (error) => error && !app.model && show(error));
  return note;
}

/** Why a cut left nothing to see, if it did. */
function emptiness(model: Model): PageError | null {
  const { counts, regions, stats, triangleCount } = model;
  if (counts.cutCells > 0 || !regions.every(({ id }) => isOutside(model, id))) return null;
  const title = 'Nothing to show';
  if (stats.outsideTriangles > 0) return { title, detail: 'The mesh lies outside the grid.' };
  const which = triangleCount === 1 ? 'The only triangle is' : `All ${plural(triangleCount, 'triangle')} are`;
  return { title, detail: `${which} degenerate (of zero area).` };
}

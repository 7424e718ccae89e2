import type { App } from '../app';
import type { Model } from '../../model/cut_model';
import type { PageError } from '../../model/failure';
import { plural } from '../../model/format';
import { isOutside } from '../../model/inside';

/** Says why the stage is empty. */
export function StageNote({ app: { model, state } }: { app: App }) {
  const reason = model ? emptiness(model) : state.cutError.value;
  return (
    <div class="stage-note" id="stage-note" role="status" hidden={reason === null}>
      {reason && (
        <>
          <strong>{reason.title}</strong>
          <p>{reason.detail}</p>
        </>
      )}
    </div>
  );
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

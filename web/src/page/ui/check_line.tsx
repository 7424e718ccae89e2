import type { App } from '../app';
import { checksSentence } from '../../model/checks';

/** What the checks of the cut-mesh have found, below the picture. */
export function CheckLine({ app }: { app: App }) {
  const { checked, playing } = app.state;
  const found = playing.value ? null : checked.value;
  const { model } = app;
  if (!model || found?.model !== model.id) return null;
  const { checks } = found;
  return (
    <p class={checks.pass ? 'hover-line' : 'hover-line bad'} id="check-line" data-model={model.id}>
      {checksSentence(checks, model.counts.cutCells)}
    </p>
  );
}

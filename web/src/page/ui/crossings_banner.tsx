import { useState } from 'preact/hooks';
import type { App } from '../app';
import { crossingsSentence } from '../../model/crossings';
import { integer } from '../../model/format';

/** Says that the mesh meets itself, and shows where. */
export function CrossingsBanner({ app }: { app: App }) {
  const { model } = app;
  const shown = app.state.crossings.value;
  const [dismissed, setDismissed] = useState('');
  const sentence = model && crossingsSentence(model.crossings);
  const mesh = model ? `${model.name} ${model.triangleCount}` : '';
  const total = model ? Object.values(model.crossings).reduce((sum, count) => sum + count, 0) : 0;
  const dismiss = () => {
    setDismissed(mesh);
    if (shown) app.inspector.showModel();
  };
  return (
    <div class="banner" id="crossings" hidden={!sentence || mesh === dismissed}>
      <p role="status">
        {sentence}
        {shown && shown.pairs < total && ` The first ${integer(shown.pairs)} are shown.`}
      </p>
      <button
        type="button"
        id="show-crossings"
        aria-pressed={shown !== null}
        onClick={() => (shown ? app.inspector.showModel() : void app.inspector.showCrossings())}
      >
        Show
      </button>
      <button type="button" class="quiet" id="dismiss-crossings" aria-label="Dismiss" onClick={dismiss}>
        ×
      </button>
    </div>
  );
}

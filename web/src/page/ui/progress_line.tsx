import { useEffect, useState } from 'preact/hooks';
import type { App } from '../app';
import { words } from '../../model/format';

/** The progress of loading and cutting, on top of the picture; appears only if they take a while. */
export function ProgressLine({ app }: { app: App }) {
  const work = app.state.work.value;
  const progress = app.state.progress.value;
  const isWorking = work !== null && app.state.playing.value === null;
  const [isLong, setLong] = useState(false);
  useEffect(() => {
    if (!isWorking) return;
    const timer = setTimeout(() => setLong(true), 150);
    return () => {
      clearTimeout(timer);
      setLong(false);
    };
  }, [isWorking]);
  // Nobody knows how much is left to load.
  const fraction = progress?.fraction ?? (work === 'loading' ? undefined : 0);
  return (
    <div class="progress" id="progress" hidden={!(isWorking && isLong)}>
      <progress max={1} value={fraction} aria-label="Progress" />
      <span class="hint">{progress ? words(progress.stage) : work === 'loading' ? 'Loading' : ''}</span>
      <button type="button" id="cancel" class="quiet" onClick={() => app.cancel()}>
        Cancel
      </button>
    </div>
  );
}

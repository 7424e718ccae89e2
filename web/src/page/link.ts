import type { App } from './app';
import { fromHash, toHash } from '../model/settings';

/** Keeps the URL in step with the settings, and the settings with a URL that the person has changed. */
export async function followLink(app: App): Promise<void> {
  let timer = 0;
  const write = () => {
    const hash = toHash(app.settings);
    history.replaceState(null, '', hash ? `#${hash}` : location.pathname + location.search);
  };
  const read = () => {
    const { settings, problems } = fromHash(location.hash);
    if (problems.length > 0) app.state.notice(`Parts of the link were not understood (${problems.join(', ')}); the rest is shown.`);
    if (settings.source.kind === 'file') {
      app.state.notice(
        `The link was made from the file ${settings.source.name}, which it does not contain. Open that file to see the same view.`,
      );
    }
    return app.restore(settings);
  };
  addEventListener('hashchange', () => void read());
  await read();
  app.state.settings.subscribe(() => {
    clearTimeout(timer);
    timer = window.setTimeout(write, 300);
  });
}

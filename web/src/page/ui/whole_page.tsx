import type { App } from '../app';
import { addressOf } from '../link';

/** From the picture in another page to the same view with all controls. */
export function WholePage({ app }: { app: App }) {
  return (
    <a class="whole-page" id="whole-page" href={addressOf(app.settings)} target="_blank" rel="noopener">
      Open in Mandoline
    </a>
  );
}

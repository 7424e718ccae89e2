import { App } from './app';
import { loadAhead } from './ahead';
import { createEngine } from './engine';
import { asPageError } from './failure';
import { followLink } from './link';
import { playOpening } from './opening';
import { State } from './state';
import { showAlerts, showEmbedded, showPanels } from './ui';
import { createView } from './view/view';

const element = (id: string) => document.getElementById(id) as HTMLElement;

const state = new State();
showAlerts(state);
state.status.subscribe((status) => (document.body.dataset.state = status));

/** As a part of another page there is the picture alone. */
const isEmbedded = new URLSearchParams(location.search).has('embed');
document.body.classList.toggle('embedded', isEmbedded);

const { arePanelsOpen } = state.sections;
arePanelsOpen.subscribe((open) => document.body.classList.toggle('with-panels', open && !isEmbedded));

try {
  start();
} catch (error) {
  state.alert(asPageError(error), 'picture');
  state.status.value = 'error';
}

/** In code, since following the link would overwrite the settings in the URL. */
function skipToPanels(): void {
  element('skip').addEventListener('click', (event) => {
    event.preventDefault();
    arePanelsOpen.value = true;
    element('panels').focus();
  });
}

function start(): void {
  const engine = createEngine();
  let lost = 0;
  const canvas = element('canvas') as HTMLCanvasElement;
  const view = createView(canvas, {
    slice: (planes, untouched) => engine.slice(planes, untouched),
    onError: (error) => state.alert(error),
    onContext: (problem) => {
      if (problem) lost = state.alert(problem, 'picture');
      else state.dismiss(lost);
    },
  });
  const app = new App(engine, view, state);
  if (isEmbedded) {
    showEmbedded(app);
    void followLink(app);
    return;
  }
  showPanels(app);
  skipToPanels();
  app.checking.begin();
  void followLink(app).then(() => {
    void playOpening(app, engine);
    return loadAhead(engine, state, view, app.windTunnel);
  });
}

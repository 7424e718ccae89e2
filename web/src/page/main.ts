import { App, pageError } from './app';
import { loadAhead } from './ahead';
import { createEngine } from './engine';
import { followLink } from './link';
import { alerts } from './ui/alerts';
import { cellCard } from './ui/cell_card';
import { checksPanel } from './ui/checks_panel';
import { cutPanel } from './ui/cut_panel';
import { hoverLine } from './ui/hover_line';
import { legend } from './ui/legend';
import { acceptDrops, meshPanel } from './ui/mesh_panel';
import { progressLine } from './ui/progress_line';
import { savePanel } from './ui/save_panel';
import { schemeToggle } from './ui/scheme';
import { shortcuts } from './ui/shortcuts';
import { stageNote } from './ui/stage_note';
import { stepsPanel } from './ui/steps_panel';
import { viewPanel } from './ui/view_panel';
import { createView } from './view/view';

const element = (id: string) => document.getElementById(id) as HTMLElement;

const { alert, clear, notice } = alerts(element('alerts'));

try {
  start();
} catch (error) {
  alert(pageError(error));
  document.body.dataset.state = 'error';
}

/** In code, since following the link would overwrite the settings in the URL. */
function skipToPanels(): void {
  element('skip').addEventListener('click', (event) => {
    event.preventDefault();
    element('panels').focus();
  });
}

function start(): void {
  const engine = createEngine();
  const canvas = element('canvas') as HTMLCanvasElement;
  const view = createView(canvas, { slice: (planes, untouched) => engine.slice(planes, untouched), onError: alert });
  const app = new App(engine, view);
  app.events.on('alert', (error) => (error ? alert(error) : clear()));
  app.events.on('state', (state) => (document.body.dataset.state = state));
  element('tools').append(
    schemeToggle((dark) => view.setScheme(dark)),
    shortcuts(app),
  );
  element('stage').append(legend(app), hoverLine(app), stageNote(app), progressLine(app), cellCard(app));
  element('panels').append(meshPanel(app), cutPanel(app), viewPanel(app), stepsPanel(app), checksPanel(app), savePanel(app));
  acceptDrops(app, notice);
  skipToPanels();
  void followLink(app, notice).then(() => loadAhead(engine));
}

// The panels, in their places in index.html.
import { render, type ComponentChild } from 'preact';
import type { App } from '../app';
import type { State } from '../state';
import { Alerts } from './alerts';
import { Bar } from './bar';
import { CellCard } from './cell_card';
import { ChecksPanel } from './checks_panel';
import { ComparePanel } from './compare_panel';
import { CrossingsBanner } from './crossings_banner';
import { CutPanel } from './cut_panel';
import { Divider } from './divider';
import { Drops } from './drops';
import { HoverLine } from './hover_line';
import { Legend } from './legend';
import { MeshPanel } from './mesh_panel';
import { MotionPanel } from './motion_panel';
import { PanelsToggle } from './panels_toggle';
import { ProgressLine } from './progress_line';
import { SavePanel } from './save_panel';
import { SchemeToggle } from './scheme';
import { Shortcuts } from './shortcuts';
import { StageNote } from './stage_note';
import { StepsPanel } from './steps_panel';
import { ViewPanel } from './view_panel';
import { WindPanel } from './wind_panel';

/** Apart from the others, so that the page can say why there is no app. */
export function showAlerts(state: State): void {
  put('alerts', <Alerts state={state} />);
}

export function showPanels(app: App): void {
  put(
    'tools',
    <>
      <SchemeToggle app={app} />
      <Shortcuts app={app} />
      <PanelsToggle app={app} />
    </>,
  );
  put(
    'over-stage',
    <>
      <Divider app={app} />
      <Legend app={app} />
      <StageNote app={app} />
      <CrossingsBanner app={app} />
      <ProgressLine app={app} />
      <HoverLine app={app} />
      <Drops app={app} />
    </>,
  );
  put(
    'foot',
    <>
      <Bar app={app} />
      <CellCard app={app} />
    </>,
  );
  put(
    'panels',
    <>
      <MeshPanel app={app} />
      <CutPanel app={app} />
      <ViewPanel app={app} />
      <MotionPanel app={app} />
      <WindPanel app={app} />
      <ComparePanel app={app} />
      <StepsPanel app={app} />
      <ChecksPanel app={app} />
      <SavePanel app={app} />
    </>,
  );
}

function put(id: string, children: ComponentChild): void {
  render(children, document.getElementById(id) as HTMLElement);
}

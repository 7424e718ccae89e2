// The panels, in their places in index.html.
import { render, type ComponentChild } from 'preact';
import type { App } from '../app';
import type { State } from '../state';
import { Alerts } from './alerts';
import { Bar } from './bar';
import { CellCard } from './cell_card';
import { ChecksPanel } from './checks_panel';
import { CodePanel } from './code_panel';
import { ComparePanel } from './compare_panel';
import { CrossingsBanner } from './crossings_banner';
import { CutPanel } from './cut_panel';
import { Divider } from './divider';
import { Drops } from './drops';
import { HoverLine } from './hover_line';
import { Legend } from './legend';
import { MeasureLine } from './measure_line';
import { MeasurePanel } from './measure_panel';
import { MeshPanel } from './mesh_panel';
import { MotionPanel } from './motion_panel';
import { PanelsToggle } from './panels_toggle';
import { ProgressLine } from './progress_line';
import { SavePanel } from './save_panel';
import { SchemeToggle } from './scheme';
import { Shortcuts } from './shortcuts';
import { StageNote } from './stage_note';
import { StepsPanel } from './steps_panel';
import { ViewAxes } from './view_axes';
import { ViewPanel } from './view_panel';
import { VolumesPanel } from './volumes_panel';
import { WholePage } from './whole_page';
import { WindPanel } from './wind_panel';

/** Apart from the others, so that the page can say why there is no app. */
export function showAlerts(state: State): void {
  put('alerts', <Alerts state={state} />);
}

/** The picture alone, and the way to all the rest. */
export function showEmbedded(app: App): void {
  put(
    'over-stage',
    <>
      <Divider app={app} />
      <Legend app={app} />
      <StageNote app={app} />
      <ProgressLine app={app} />
      <WholePage app={app} />
    </>,
  );
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
      <ViewAxes app={app} />
      <StageNote app={app} />
      <CrossingsBanner app={app} />
      <MeasureLine app={app} />
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
      <VolumesPanel app={app} />
      <MeasurePanel app={app} />
      <MotionPanel app={app} />
      <WindPanel app={app} />
      <ComparePanel app={app} />
      <StepsPanel app={app} />
      <ChecksPanel app={app} />
      <SavePanel app={app} />
      <CodePanel app={app} />
    </>,
  );
}

function put(id: string, children: ComponentChild): void {
  render(children, document.getElementById(id) as HTMLElement);
}
